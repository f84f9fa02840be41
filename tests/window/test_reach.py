"""Every key, menu and part of the viewer's panels is used by a replay: what is new there needs a line here."""
import base64
import json
import os
import shutil
import struct
import unittest

from display import WindowTest, main

COMMAND = os.environ["LSF_COMMAND"]
SCENES = os.path.join(os.environ["LSF_SOURCE_ROOT"], "data/scenes")

KEYS = ["Enter", "F", "1", "Control 1", "3", "Control 3", "7", "Control 7", "C", "T", "=", "Shift =", "-", "Space",
        "Space", "Left", "Right", "PageDown", "PageUp", "F12", "Shift F12", "Control C", "Control S", "Tab", "Tab",
        "F11", "F11", "H", "H", "Escape"]
MOUSE = ["move 100 100", "button 0", "move 110 105", "button-up 0", "key Shift", "button 0", "move 100 110",
         "button-up 0", "key-up Shift", "button 2", "move 105 105", "button-up 2", "scroll 1", "button 1", "move 110 100",
         "key W", "key-up W", "button-up 1", "move 100 120", "button 0", "button-up 0", "step 1", "button 0", "button-up 0",
         "button 0", "button-up 0"]
SCENE = ["press Scene", "press tall block", "drag 9 0 handle X", "drag 0 -9 handle Y", "drag 5 5 handle Z",
         "drag 5 5 ring X", "drag 5 5 ring Y", "drag 5 5 ring Z", "drag 3 -3 handle scale", "set Position = 0,0.2,0",
         "press Nodes", "press Lamp", "set Kind = spot", "set Cone = 40", "set Intensity = 1", "set Colour = 1,0.5,0.5",
         "press New light", "press Click a surface", "press Lights", "press white", "set Base colour = 0.5,0.5,0.5", "set Metallic = 0.1",
         "set Roughness = 0.5", "set Emission = 0.1", "set Its colour = 1,1,0.5", "press Materials", "set Turn = 20",
         "set Strength = 0.5", "press Environment", "press Notes"]
PICTURE = ["press Picture", "set Technique = cone", "set Technique = direct", "set Iterations = 2", "set Bounces = 1",
           "press Raw", "press Raw", "set Layer = Albedo", "set Layer = Picture", "set Background = uniform",
           "set Its radiance = 0.5,0.5,0.5", "set Background = auto", "set Exposure = 1", "set Tone curve = aces",
           "press Expose for this picture", "settle", "press Copy command line", "press Save view"]
COMPARE = ["press Compare", "set Beside = direct", "settle", "press Difference", "set Gain = 2", "settle",
           "drag 40 0 split bar", "set Beside = nothing"]
PASSES = ["press Passes", "set Frame budget = 50", "set ##Time = 0.25", "press Play", "press Stop"]


def numbered(steps):
    return "\n".join(f"{2 + frame} {step}" for frame, step in enumerate(steps)) + "\n"


def pressed(keys):
    *modifiers, last = keys.split()
    return ([f"key {name}" for name in modifiers] + [f"key {last}", f"key-up {last}"] +
            [f"key-up {name}" for name in modifiers])


class Reach(WindowTest):
    def room(self):
        """Two cameras, an animation, a note."""
        with open(os.path.join(SCENES, "cornell_point.gltf"), encoding="utf-8") as file:
            room = json.load(file)
        shutil.copy(os.path.join(SCENES, "cornell_point.bin"), self.folder)
        data = struct.pack("<2f", 0, 1) + struct.pack("<6f", 0, 0, 0, 0.1, 0, 0)
        room["buffers"].append({"byteLength": len(data), "uri": "data:application/octet-stream;base64," +
                                base64.b64encode(data).decode()})
        views, accessors = room["bufferViews"], room["accessors"]
        for offset, length, kind, more in ((0, 8, "SCALAR", {"min": [0], "max": [1]}), (8, 24, "VEC3", {})):
            views.append({"buffer": len(room["buffers"]) - 1, "byteOffset": offset, "byteLength": length})
            accessors.append({"bufferView": len(views) - 1, "componentType": 5126, "count": 2, "type": kind, **more})
        target = {"node": next(i for i, node in enumerate(room["nodes"]) if node.get("name") == "short block"),
                  "path": "translation"}
        room["animations"] = [{"channels": [{"sampler": 0, "target": target}],
                               "samplers": [{"input": len(accessors) - 2, "output": len(accessors) - 1}]}]
        camera = next(node for node in room["nodes"] if "camera" in node)
        room["nodes"].append({**camera, "name": "Again"})
        room["scenes"][0]["nodes"].append(len(room["nodes"]) - 1)
        room["extensionsUsed"].append("EXT_of_nobody")
        return self.write("room.gltf", json.dumps(room))

    def replay(self, name, steps, *words, size="320,240"):
        """What the run has used, and what there was."""
        script = self.write(name, numbered(steps))
        self.run_program(COMMAND, "view", *words, "-r", size, "-t", "direct", "-b", "0", "-s", "1", "--budget", "5", "--replay", script,
                         "--coverage", "coverage")
        with open(self.path("coverage"), encoding="utf-8") as file:
            rows = [line.rstrip("\n").split("\t") for line in file]
        return {(kind, label) for used, kind, label in rows if used == "used"}, {(kind, label) for _, kind, label in rows}

    def options(self):
        """Each group opened, each of its options set."""
        groups, steps = {}, ["press Picture", "settle", "press Passes that do not run"]
        for line in self.run_program(COMMAND, "render", "--list-options").stdout.splitlines()[1:]:
            key, kind, span, value = line.split()[:4]
            group = key.split(".")[0]
            if group not in groups:
                groups[group] = [f"press {group}"]
            other = next((word for word in span.split("|") if word != value), value)
            groups[group].append(f"press {key}" if kind == "bool" else f"set {key} = {other if kind == 'enum' else value}")
        for lines in groups.values():
            steps += lines
        return steps + ["press Reset options"]

    def techniques(self):
        """The quickest one last."""
        lines = self.run_program(COMMAND, "render", "--list-techniques").stdout.splitlines()
        return sorted((line.split()[0] for line in lines), key="direct".__eq__)

    def menus(self, layers, files):
        items = {"File": ["Save picture", "Save view", "Copy command line", *files],
                 "Technique": self.techniques(), "Layer": layers,
                 "Window": ["Panels", "Full screen", "Full screen", "Keys"]}
        steps = []
        for menu, names in items.items():
            for name in names:
                steps += [f"press {menu}", f"press {name}"] + (pressed("Tab") if name == "Panels" else [])
        return steps + ["press Close", "press File", "press Quit"]

    def test_all_of_it(self):
        layers = ["Albedo", "Normal", "Depth", "Emission", "Direct light", "Indirect diffuse light",
                  "Indirect specular light", "Motion", "Voxels: albedo", "Voxels: normal", "Voxels: radiance", "Picture"]
        scenes = [self.room(), os.path.join(SCENES, "cornell_emissive.gltf"), "-e", "0.2,0.2,0.2"]
        runs = [
            self.replay("keys", [line for key in KEYS for line in pressed(key)] + MOUSE + pressed("Control Q"), *scenes),
            self.replay("panels", SCENE + PICTURE + COMPARE + PASSES, *scenes, size="560,320"),
            self.replay("options", self.options(), *scenes, size="420,240"),
            self.replay("menus", self.menus(layers, ["cornell_emissive.gltf", "room.gltf"]), *scenes, size="320,240")]
        for name in ("Interior", "Cornell box", "Cornell box, a glowing lamp", "Cornell box, glossy", "Cornell box, glass"):
            runs.append(self.replay("start", [f"press {name}"]))
        used = set.union(*(run[0] for run in runs))
        there = set.union(*(run[1] for run in runs))
        self.assertEqual(sorted(there - used), [])
        self.assertGreater(len(there), 150)


if __name__ == "__main__":
    main()

"""lightsheaf plan: the plan as a graph, and what each feature of a scene costs."""
import json
import os
import re
import shutil
import subprocess

from command import SOURCE_ROOT, CommandTest, main

TECHNIQUES = ("bidirectional", "voxel_path", "cone", "direct", "substitute_tree")
INTERIOR = os.path.join(SOURCE_ROOT, "data/scenes/interior.gltf")

QUOTED = r'"(?:[^"\\]|\\.)*"'
WORD = rf"(?:[A-Za-z_]\w*|-?\d+(?:\.\d+)?|{QUOTED})"
LIST = rf"\[{WORD}={WORD}(?:, {WORD}={WORD})*\]"
NODE = re.compile(rf"({QUOTED}) ({LIST})")
EDGE = re.compile(rf"({QUOTED}) -> ({QUOTED}) ({LIST})")
DEFAULTS = re.compile(rf"(?:graph|node|edge) {LIST}")


class Graph(CommandTest):
    def graph(self, *words):
        return self.run_command("plan", *words, "--dot").stdout.decode()

    def parse(self, text):
        """Nodes with what they say, and edges, by what of the language the graph uses."""
        first, *lines, last = text.splitlines()
        self.assertEqual((first, last), ("digraph plan {", "}"))
        nodes, edges = {}, []
        for line in lines:
            self.assertTrue(line.startswith("  ") and line.endswith(";"), line)
            statement = line[2:-1]
            edge, node = EDGE.fullmatch(statement), NODE.fullmatch(statement)
            if edge:
                edges.append((edge[1].strip('"'), edge[2].strip('"')))
            elif node:
                nodes[node[1].strip('"')] = node[2]
            else:
                self.assertTrue(DEFAULTS.fullmatch(statement), line)
        return nodes, edges

    def test_it_has_what_the_plan_has(self):
        for technique in TECHNIQUES:
            words = (INTERIOR, "--technique", technique, "--environment", "1,1,1")
            nodes, edges = self.parse(self.graph(*words))
            plan = json.loads(self.run_command("plan", *words, "--json", "-").stdout)
            passes = [p["name"] for p in plan["passes"]]
            stems = {r["name"].split(".")[0] for r in plan["resources"]}
            self.assertEqual(set(nodes), set(passes) | {"resources " + s for s in stems})
            expected = set(zip(passes, passes[1:]))
            for number, p in enumerate(plan["passes"], 1):
                self.assertIn(f'"{number}  {p["name"]}\\l', nodes[p["name"]])
                for switch in p["switches"]:
                    said = f'{switch["name"]} {switch["value"]}\\l'
                    self.assertEqual(said in nodes[p["name"]], switch["value"] != 0, said)
                expected |= {("resources " + s, p["name"]) for s in p["reads"]}
                expected |= {(p["name"], "resources " + s) for s in p["fills"]}
            self.assertEqual(set(edges), expected)
            self.assertEqual(len(edges), len(expected))

    def test_resources_that_are_read_were_written_or_belong_to_the_scene(self):
        for technique in TECHNIQUES:
            plan = json.loads(self.run_command("plan", INTERIOR, "--technique", technique,
                                               "--json", "-").stdout)
            filled = {s for p in plan["passes"] for s in p["fills"]} | {"scene", "view"}
            for p in plan["passes"]:
                self.assertLessEqual(set(p["reads"]), filled, p["name"])
            read = {s for p in plan["passes"] for s in p["reads"] + p["fills"]}
            for resource in plan["resources"]:
                self.assertIn(resource["name"].split(".")[0], read | {"bundle"})

    def test_graphviz_reads_it(self):
        dot = shutil.which("dot")
        if not dot:
            self.skipTest("Graphviz is not installed")
        for technique in TECHNIQUES:
            drawn = subprocess.run([dot, "-Tplain"], input=self.graph(INTERIOR, "--technique", technique),
                                   capture_output=True, text=True, timeout=60)
            self.assertEqual((drawn.returncode, drawn.stderr), (0, ""))
            self.assertEqual(drawn.stdout.split()[0], "graph")

    def test_names_are_quoted(self):
        self.scene('a"b\\.gltf')
        self.parse(self.graph('a"b\\.gltf'))


class Prices(CommandTest):
    def plan(self, *words):
        return json.loads(self.run_command("plan", *words, "--json", "-").stdout)

    def price(self, feature, *words):
        found = [p for p in self.plan(*words, "--prices")["prices"]["features"] if p["feature"] == feature]
        self.assertLessEqual(len(found), 1)
        return found[0] if found else None

    def test_a_feature_costs_what_the_plan_without_it_saves(self):
        """Against a file that never had the feature."""
        self.scene("with.gltf", emissive=True)
        self.scene("without.gltf")
        for technique in TECHNIQUES:
            words = ("--technique", technique)
            price = self.price("emission", "with.gltf", *words)
            with_it, without = self.plan("with.gltf", *words), self.plan("without.gltf", *words)
            self.assertEqual(price["bytes"], with_it["bytes"] - without["bytes"])
            names = lambda plan: {p["name"] for p in plan["passes"]}
            self.assertEqual(set(price["passes"]), names(with_it) - names(without))
            self.assertIn("gbuffer.emission", price["resources"])
            on = lambda plan: {f'{p["name"]} {s["name"]}' for p in plan["passes"] for s in p["switches"]
                               if s["value"]}
            gone = {s for s in on(with_it) - on(without) if s.split()[0] in names(without)}
            self.assertEqual(set(price["switches"]), gone)
            self.assertIsNone(price["milliseconds"])
            self.assertIsNone(self.price("emission", "without.gltf", *words))

    def test_the_interior(self):
        text = self.run_command("plan", INTERIOR, "--environment", "1,1,1", "--prices").stdout.decode()
        rows = [line[:18].strip() for line in text.splitlines()[1:]]
        self.assertEqual(rows, ["emission", "roughness/metallic", "normal maps", "textures", "vertex colours", "lights",
                                "environment"])
        price = self.price("textures", INTERIOR)
        self.assertIn("scene.texture x 6", price["resources"])
        price = self.price("lights", INTERIOR, "--technique", "direct")
        self.assertEqual(price["passes"], ["shadow_map", "direct_light"])


if __name__ == "__main__":
    main()

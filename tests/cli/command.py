"""What the tests of the command share: running it, tiny scenes, looking into pictures."""
import base64
import json
import os
import shutil
import struct
import subprocess
import tempfile
import unittest

COMMAND = os.environ["LSF_COMMAND"]
SOURCE_ROOT = os.environ["LSF_SOURCE_ROOT"]

DONE, RENDERING, USAGE, FILE, NO_GL, DIFFERS = range(6)


class CommandTest(unittest.TestCase):
    """Each test has an empty folder of its own, in which the command runs."""

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="lightsheaf-cli-")
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def path(self, name):
        return os.path.join(self.folder, name)

    def run_command(self, *words, status=DONE, timeout=120, **keywords):
        if "input" not in keywords:
            keywords.setdefault("stdin", subprocess.DEVNULL)
        keywords.setdefault("stdout", subprocess.PIPE)
        done = subprocess.run([COMMAND, *words], cwd=self.folder, timeout=timeout,
                              stderr=subprocess.PIPE, **keywords)
        done.text = done.stderr.decode(errors="replace")
        self.assertEqual(done.returncode, status,
                         f"lightsheaf {' '.join(words)}: status {done.returncode}\n{done.text}")
        return done

    def refuse(self, *words, status=USAGE, says=()):
        """The command fails with that status, and its one line names each of the parts."""
        done = self.run_command(*words, status=status)
        for part in says:
            self.assertIn(part, done.text)
        self.assertIn("error: ", done.text)
        return done

    def scene(self, name="scene.gltf", **keywords):
        return write_scene(self.path(name), **keywords)

    def read(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def pixels(self, name):
        """Equal for equal pictures, however they were asked for."""
        data = self.read(name)
        return exr_body(data) if data[:4] == b"\x76\x2f\x31\x01" else png_body(data)

    def read_json(self, name):
        return json.loads(self.read(name), parse_constant=lambda word: self.fail(word))

    def files(self):
        return sorted(os.listdir(self.folder))


def shown_by(terminal):
    """What a pseudoterminal shows, part by part, until nobody writes to it any more."""
    while True:
        try:
            part = os.read(terminal, 65536)
        except OSError:
            return
        if not part:
            return
        yield part


def write_scene(path, emissive=False, light=True, camera=True, animated=False, name="Front"):
    """A square metre facing +z, a point light half a metre before it, a camera two metres away."""
    positions = struct.pack("<12f", -.5, -.5, 0, .5, -.5, 0, .5, .5, 0, -.5, .5, 0)
    indices = struct.pack("<6H", 0, 1, 2, 0, 2, 3)
    times = struct.pack("<2f6f", 0, 1, 0, 0, 0, 0.25, 0, 0)
    normals = 4 * struct.pack("<3f", 0, 0, 1)
    data = positions + indices + times + normals
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    material = {"pbrMetallicRoughness": {"baseColorFactor": [.8, .6, .4, 1], "metallicFactor": 0,
                                         "roughnessFactor": 1}}
    if emissive:
        material["emissiveFactor"] = [1, .5, .25]
    scene = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 2}, "indices": 1,
                                    "material": 0}]}],
        "materials": [material],
        "buffers": [{"byteLength": len(data), "uri": uri}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48},
                        {"buffer": 0, "byteOffset": 48, "byteLength": 12},
                        {"buffer": 0, "byteOffset": 60, "byteLength": 32},
                        {"buffer": 0, "byteOffset": 92, "byteLength": 48}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
             "min": [-.5, -.5, 0], "max": [.5, .5, 0]},
            {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
            {"bufferView": 3, "componentType": 5126, "count": 4, "type": "VEC3"}],
    }

    def add_node(node):
        scene["scenes"][0]["nodes"].append(len(scene["nodes"]))
        scene["nodes"].append(node)

    if light:
        scene["extensionsUsed"] = ["KHR_lights_punctual"]
        scene["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": "point",
                                                                   "intensity": 1}]}}
        add_node({"translation": [0, 0, .5],
                  "extensions": {"KHR_lights_punctual": {"light": 0}}})
    if camera:
        scene["cameras"] = [{"type": "perspective", "name": name,
                             "perspective": {"yfov": .6, "znear": .01}}]
        add_node({"translation": [0, 0, 2], "camera": 0, "name": name})
    if animated:
        scene["accessors"] += [
            {"bufferView": 2, "componentType": 5126, "count": 2, "type": "SCALAR",
             "min": [0], "max": [1]},
            {"bufferView": 2, "byteOffset": 8, "componentType": 5126, "count": 2, "type": "VEC3"}]
        scene["animations"] = [{"samplers": [{"input": 3, "output": 4}],
                                "channels": [{"sampler": 0,
                                              "target": {"node": 0, "path": "translation"}}]}]
    with open(path, "w", encoding="utf-8") as file:
        json.dump(scene, file)
    return path


def exr_channels(data):
    """Names and pixel types (2: float32) of an EXR's channels, from its header."""
    assert data[:4] == b"\x76\x2f\x31\x01", "not an EXR"
    at = 8
    while data[at]:
        end = data.index(b"\0", at)
        name = data[at:end]
        type_end = data.index(b"\0", end + 1)
        size = struct.unpack_from("<i", data, type_end + 1)[0]
        at = type_end + 5
        if name == b"channels":
            channels, place = {}, at
            while data[place]:
                stop = data.index(b"\0", place)
                channels[data[place:stop].decode()] = struct.unpack_from("<i", data, stop + 1)[0]
                place = stop + 17
            return channels
        at += size
    raise AssertionError("an EXR without channels")


def exr_body(data):
    """The compressed pixels of an EXR, without the header, which tells how it was made, and without
    the table of places in the file."""
    at, rows = 8, 0
    while data[at]:
        end = data.index(b"\0", at)
        type_end = data.index(b"\0", end + 1)
        size = struct.unpack_from("<i", data, type_end + 1)[0]
        if data[at:end] == b"dataWindow":
            low, high = struct.unpack_from("<4i", data, type_end + 5)[1::2]
            rows = high - low + 1
        at = type_end + 5 + size
    return data[at + 1 + 8 * ((rows + 15) // 16):]  # 16 rows of a zip block


def png_body(data):
    """The compressed pixels of a PNG."""
    at, body = 8, b""
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        if kind in (b"IHDR", b"IDAT"):
            body += data[at + 8:at + 8 + size]
        at += size + 12
    return body


def png_size(data):
    assert data[:8] == b"\x89PNG\r\n\x1a\n", "not a PNG"
    return struct.unpack(">II", data[16:24])


def main():
    unittest.main(verbosity=2)

"""Several scenes in one run, and scenes from standard input."""
import base64
import json
import os
import pty
import struct
import unittest

from command import FILE, SOURCE_ROOT, USAGE, CommandTest, exr_channels, main, png_size

SMALL = ("--resolution", "8,8", "--samples", "1", "--technique", "direct")


class Several(CommandTest):
    def three(self):
        """Two good scenes around one that is none."""
        self.scene("a.gltf")
        with open(self.path("bad.gltf"), "wb") as file:
            file.write(b"{}")
        os.makedirs(self.path("folder"), exist_ok=True)
        self.scene("folder/b.v2.gltf", light=False)
        return ["a.gltf", "bad.gltf", "folder/b.v2.gltf"]

    def test_pictures_have_distinct_names(self):
        done = self.run_command("render", *self.three(), "-o", "folder/%s_%s.png", "--json", "all.json",
                                *SMALL, status=FILE)
        self.assertEqual(sorted(os.listdir(self.path("folder"))),
                         ["a_a.png", "b.v2.gltf", "b.v2_b.v2.png"])
        self.assertEqual(png_size(self.read("folder/a_a.png")), (8, 8))
        self.assertEqual(done.text.count("error: "), 1, done.text)
        self.assertIn("error: bad.gltf: ", done.text)
        self.assertIn("warning: folder/b.v2.gltf: the file has no light", done.text)
        good, bad, other = self.read_json("all.json")
        self.assertEqual((good["scene"], good["output"]), ("a.gltf", "folder/a_a.png"))
        self.assertEqual(bad["scene"], "bad.gltf")
        self.assertIn("bad.gltf: ", bad["error"])
        self.assertEqual(other["output"], "folder/b.v2_b.v2.png")

    def test_each_is_as_if_alone(self):
        self.three()
        self.run_command("render", "a.gltf", "folder/b.v2.gltf", "-o", "%s.exr", *SMALL)
        for name in ("a", "folder/b.v2"):
            self.run_command("render", f"{name}.gltf", "-o", "alone.exr", *SMALL)
            self.assertEqual(self.pixels("alone.exr"), self.pixels(f"{os.path.basename(name)}.exr"))

    def test_the_first_failure_decides_the_status(self):
        self.three()
        done = self.run_command("render", "a.gltf", "bad.gltf", "-o", "%s.png", "--camera", "Back", *SMALL,
                                status=USAGE)
        self.assertIn("error: a.gltf: camera 'Back'", done.text)
        self.assertIn("error: bad.gltf: ", done.text)
        self.run_command("render", "bad.gltf", "a.gltf", "-o", "%s.png", "--camera", "Back", *SMALL,
                         status=FILE)

    def test_output_without_distinct_names(self):
        self.three()
        self.scene("folder/a.gltf")
        for output in ("c.png", "-"):
            self.refuse("render", "a.gltf", "folder/b.v2.gltf", "-o", output, "--format", "png",
                        says=["a.gltf", "folder/b.v2.gltf", output, "-o '%s.png'"])
        self.refuse("render", "a.gltf", "folder/a.gltf", "-o", "%s.png", *SMALL,
                    says=["a.gltf and folder/a.gltf", "a.png", "separately"])
        self.scene("a_b.gltf")
        self.refuse("reference", "a.gltf", "a_b.gltf", "-o", "%s.exr", "--halves", says=["a_b.exr"])
        self.assertFalse([name for name in self.files() if name.endswith((".png", ".exr"))])

    def test_every_path_is_checked_first(self):
        self.three()
        os.mkdir(self.path("b.v2.png"))
        self.refuse("render", "a.gltf", "folder/b.v2.gltf", "-o", "%s.png", status=FILE, says=["b.v2.png"])
        self.assertNotIn("a.png", self.files())

    def test_one_scene_may_name_its_picture_too(self):
        self.scene("a.gltf")
        self.run_command("render", "a.gltf", "-o", "%s-100%.exr", *SMALL)
        self.assertIn("a-100%.exr", self.files())

    @unittest.skipUnless("reference" in os.environ.get("LSF_MODULES", ""), "no path tracer")
    def test_reference(self):
        self.run_command("reference", *self.three(), "-o", "%s.exr", "-r", "4,4", "-s", "2", "--halves",
                         status=FILE)
        for name in ("a", "a_a", "a_b", "b.v2", "b.v2_a", "b.v2_b"):
            exr_channels(self.read(f"{name}.exr"))

    def test_descriptions(self):
        for command in ("info", "plan"):
            scenes = self.three()
            done = self.run_command(command, *scenes, "--json", "-", status=FILE)
            good, bad, other = json.loads(done.stdout)
            self.assertIn("bad.gltf", bad["error"])
            alone = [self.run_command(command, scene).stdout for scene in (scenes[0], scenes[2])]
            done = self.run_command(command, *scenes, "--json", "all.json", status=FILE)
            self.assertEqual(done.stdout, b"\n".join(alone))
            self.assertEqual(self.read_json("all.json"), [good, bad, other])
            done = self.run_command(command, scenes[0], "--json", "-")
            self.assertEqual(json.loads(done.stdout), good)


class StandardInput(CommandTest):
    def glb(self):
        """scene() with its buffer in the binary chunk."""
        with open(self.scene(), encoding="utf-8") as file:
            scene = json.load(file)
        data = base64.b64decode(scene["buffers"][0].pop("uri").split(",")[1])
        text = json.dumps(scene).encode()
        text += b" " * (-len(text) % 4)
        data += b"\0" * (-len(data) % 4)
        chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
        return b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks

    def test_scene(self):
        embedded = self.read(os.path.basename(self.scene()))
        for content in (embedded, self.glb()):
            text = self.run_command("info", "-", input=content).stdout.decode()
            self.assertTrue(text.startswith("standard input\nnodes        3\n"), text)
        self.run_command("render", "-", "-o", "%s.exr", *SMALL, input=self.glb())
        self.run_command("render", "scene.gltf", "-o", "alone.exr", *SMALL)
        self.assertEqual(self.pixels("stdin.exr"), self.pixels("alone.exr"))
        done = self.run_command("render", "-o", "-", "--format", "png", "-", *SMALL, input=embedded)
        self.assertEqual(png_size(done.stdout), (8, 8))

    def test_beside_others(self):
        self.scene("a.gltf")
        self.run_command("render", "a.gltf", "-", "-o", "%s.png", *SMALL, input=self.glb())
        self.assertIn("stdin.png", self.files())
        done = self.run_command("info", "a.gltf", "-", input=b"no", status=FILE)
        self.assertIn("error: standard input: only", done.text)
        done = self.run_command("render", "-", "a.gltf", "-o", "%s.png", "-c", "Back", *SMALL, input=self.glb(),
                                status=USAGE)
        self.assertIn("error: standard input: camera 'Back'", done.text)
        self.run_command("render", "-", "-", "-o", "%s.png", *SMALL, input=self.glb(), status=USAGE)

    def test_bad_content(self):
        for content, says in ((b"", "an empty file"), (b"solid cube", "only .gltf and .glb are read"),
                              (self.glb()[:-1], "GLB_LENGTH_MISMATCH")):
            done = self.run_command("info", "-", input=content, status=FILE)
            self.assertIn("error: standard input: ", done.text)
            self.assertIn(says, done.text)

    def test_no_files_beside_it(self):
        with open(os.path.join(SOURCE_ROOT, "data/scenes/cornell_point.gltf"), "rb") as file:
            content = file.read()
        done = self.run_command("info", "-", input=content, status=FILE)
        for says in ("standard input: ", "/buffers/0/uri", "cornell_point.bin", "embed", "path of the file"):
            self.assertIn(says, done.text)

    def test_terminal(self):
        mine, theirs = pty.openpty()
        try:
            done = self.run_command("info", "-", stdin=theirs, status=USAGE)
            self.assertIn("terminal", done.text)
        finally:
            os.close(mine)
            os.close(theirs)


if __name__ == "__main__":
    main()

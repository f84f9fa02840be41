"""Sequences of frames: their pictures, times and views; going on with one; bad asks."""
import os
import unittest

from command import USAGE, CommandTest, main

SMALL = ("--resolution", "16,12", "--samples", "2")


class Sequence(CommandTest):
    def render(self, *words, **keywords):
        return self.run_command("render", "scene.gltf", *SMALL, *words, **keywords)

    def test_frames_are_at_their_times(self):
        self.scene(animated=True)
        self.render("--frames", "0-3", "--fps", "4", "-o", "f_%03d.exr", "--json", "all.json")
        self.assertEqual(self.files(), ["all.json", "f_000.exr", "f_001.exr", "f_002.exr",
                                        "f_003.exr", "scene.gltf"])
        self.assertEqual([frame["output"] for frame in self.read_json("all.json")],
                         [f"f_{i:03}.exr" for i in range(4)])
        pictures = [self.pixels(f"f_{i:03}.exr") for i in range(4)]
        self.assertEqual(len(set(pictures)), 4)
        # The first of them is that of no sequence, and each of them that of another sequence.
        self.render("-o", "one.exr")
        self.assertEqual(self.pixels("one.exr"), pictures[0])
        self.render("--frames", "2-2", "--fps", "4", "-o", "again%d.exr")
        self.assertEqual(self.pixels("again2.exr"), pictures[2])

    def test_turntable_orbits(self):
        """Half a turn shows the back, which is hidden; a whole turn is none."""
        self.scene()
        self.render("--turntable", "2", "--frames", "0-2", "-o", "%d.exr", "-t", "direct",
                    "--background", "0,0,0", "--samples", "1")
        front, back = self.pixels("0.exr"), self.pixels("1.exr")
        self.assertNotEqual(front, back)
        self.run_command("compare", "0.exr", "2.exr", "--threshold", "bias=0.02")

    def test_resume_leaves_what_is_there(self):
        self.scene(animated=True)
        with open(self.path("f1.exr"), "wb") as file:
            file.write(b"kept")
        done = self.render("--frames", "0-2", "-o", "f%d.exr", "--resume")
        self.assertEqual(self.files(), ["f0.exr", "f1.exr", "f2.exr", "scene.gltf"])
        self.assertEqual(self.read("f1.exr"), b"kept")
        self.assertIn("1 frame was there already", done.text)

    def test_frames_keep_light(self):
        self.scene(animated=True)
        self.render("--frames", "0-2", "-o", "kept%d.exr", "--temporal")
        self.render("--frames", "0-2", "-o", "own%d.exr")
        for frame in (1, 2):
            self.assertNotEqual(self.pixels(f"kept{frame}.exr"), self.pixels(f"own{frame}.exr"))

    def test_bad_asks(self):
        self.scene()
        for words, part in [
                (("--frames", "0-3", "-o", "f.png"), "%04d"),
                (("--frames", "0-3", "-o", "%d_%d.png"), "once"),
                (("-o", "f%d.png"), "--frames"),
                (("-o", "f.png", "--resume"), "--turntable"),
                (("-o", "f.png", "--temporal"), "--turntable"),
                (("--frames", "0-3", "-o", "f%d.png", "--temporal", "--resume"), "--resume and"),
                (("--frames", "0-3", "-o", "f%d.png", "--temporal", "--raw"), "raw and temporal"),
                (("--frames", "3-1", "-o", "f%d.png"), "0-47"),
                (("--frames", "3", "-o", "f%d.png"), "0-47"),
                (("--turntable", "0", "-o", "f%d.png"), "--turntable 0")]:
            self.refuse("render", "scene.gltf", *words, status=USAGE, says=[part])
        self.assertEqual(os.listdir(self.folder), ["scene.gltf"])


if __name__ == "__main__":
    main()

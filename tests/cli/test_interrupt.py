"""Signals: the first stops the iterations, the second the process; no file is ever torn."""
import os
import pty
import re
import signal
import subprocess
import unittest

from command import COMMAND, DONE, RENDERING, CommandTest, exr_channels, main, shown_by

ENDLESS = ("--resolution", "32,24", "--samples", "1000000000")


def hear_signals():
    """A job in the background, or under nohup, inherits that some are ignored."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)


class Interrupt(CommandTest):
    def start_and_interrupt(self, tool, *words, number=signal.SIGINT, again=False, output="a.exr",
                            when=rb"[1-9]\d*/\d+ samples"):
        """Starts at a terminal, waits until the bar shows a sample, or what `when` says, and sends the
        signal."""
        mine, theirs = pty.openpty()
        scene = self.scene()
        process = subprocess.Popen([COMMAND, tool, scene, "-o", output, *ENDLESS, *words],
                                   cwd=self.folder, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=theirs,
                                   preexec_fn=hear_signals)
        os.close(theirs)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.kill)
        seen, sent = b"", False
        try:
            for part in shown_by(mine):
                seen += part
                if not sent and re.search(when, seen):
                    process.send_signal(number)
                    if again:
                        process.send_signal(signal.SIGTERM)
                    sent = True
        finally:
            os.close(mine)
        process.wait(60)
        self.assertTrue(sent, seen)
        return process.returncode, seen.decode()

    def test_converged_picture_is_saved(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            status, seen = self.start_and_interrupt("render", "--json", "a.json", number=number)
            self.assertEqual(status, DONE, seen)
            self.assertIn("(interrupted)", seen)
            self.assertEqual(set(exr_channels(self.read("a.exr"))), {"R", "G", "B"})
            report = self.read_json("a.json")
            self.assertIs(report["interrupted"], True)
            self.assertGreater(report["samples"], 0)
            self.assertIn(f"{report['samples']} sample", seen)
            self.assertEqual(self.files(), ["a.exr", "a.json", "scene.gltf"])

    def test_partial_is_the_same_as_asking_for_it(self):
        """What was saved is a whole picture of that many samples; filters and patterns depend on
        how many are asked for."""
        self.start_and_interrupt("render", "--raw", "--json", "a.json")
        samples = self.read_json("a.json")["samples"]
        self.run_command("render", "scene.gltf", "-o", "b.exr", "-q", "--raw", "-r", "32,24",
                         "-s", str(samples))
        self.assertEqual(self.pixels("a.exr"), self.pixels("b.exr"))

    def test_second_signal_kills(self):
        """Both may arrive before the first is looked at, or the second while saving or after it."""
        status, seen = self.start_and_interrupt("render", again=True)
        self.assertIn(status, (DONE, -signal.SIGTERM, -signal.SIGINT), seen)
        self.assertIn(self.files(), (["scene.gltf"], ["a.exr", "scene.gltf"]))

    def test_scenes_behind_are_left_out(self):
        self.scene("b.gltf")
        self.scene("c.gltf")
        status, seen = self.start_and_interrupt("render", "b.gltf", "c.gltf", "--json", "a.json",
                                                output="%s.exr")
        self.assertEqual(status, RENDERING, seen)
        self.assertIn("error: b.gltf: interrupted before this scene and those behind it", seen)
        self.assertEqual(self.files(), ["a.json", "b.gltf", "c.gltf", "scene.exr", "scene.gltf"])
        first, second = self.read_json("a.json")
        self.assertIs(first["interrupted"], True)
        self.assertEqual(second["scene"], "b.gltf")

    def test_reference(self):
        status, seen = self.start_and_interrupt("reference")
        self.assertEqual(status, DONE, seen)
        self.assertEqual(self.files(), ["a.exr", "scene.gltf"])

    def test_reference_within_a_pass(self):
        status, seen = self.start_and_interrupt("reference", "--resolution", "2048,1536", when=b" 0/")
        self.assertEqual(status, RENDERING, seen)
        self.assertIn("before the first sample", seen)
        self.assertEqual(self.files(), ["scene.gltf"])

    def test_reference_time_limit(self):
        """Some pixels have more samples than others, and no pixel has fewer than are told."""
        self.run_command("reference", self.scene(), "-o", "a.exr", "-r", "512,384", "--time-limit", "1",
                         "--json", "a.json")
        report = self.read_json("a.json")
        self.assertGreater(report["samples"], 0)
        self.run_command("reference", "scene.gltf", "-o", "b.exr", "-r", "512,384", "-s", str(report["samples"]))
        self.run_command("compare", "a.exr", "b.exr", "--threshold", "bias=0.001", "--threshold", "rmse_relative=0.05")

    def test_reference_half(self):
        """Interrupted in the first half, there is one picture and no pair."""
        status, seen = self.start_and_interrupt("reference", "--halves")
        self.assertEqual(status, RENDERING, seen)
        self.assertIn("before the second half", seen)
        self.assertEqual(self.files(), ["a.exr", "scene.gltf"])


if __name__ == "__main__":
    if "reference" not in os.environ.get("LSF_MODULES", "reference"):
        for name in [name for name in dir(Interrupt) if name.startswith("test_reference")]:
            setattr(Interrupt, name,
                    unittest.skip("built without Embree")(getattr(Interrupt, name)))
    main()

"""`lightsheaf measure` as users run it, on pictures of a few pixels."""
import csv
import io
import json
import os
import pty
import re
import shlex
import signal
import subprocess
import sys

sys.path.insert(0, os.path.join(os.environ["LSF_SOURCE_ROOT"], "tests/cli"))
from command import COMMAND, DONE, FILE, SOURCE_ROOT, CommandTest, main, shown_by  # noqa: E402
from test_interrupt import hear_signals  # noqa: E402

CORNELL = os.path.join(SOURCE_ROOT, "data/scenes/cornell_point.gltf")
SMALL = ("-r", "16,12", "--reference-samples", "16", "--seeds", "3", "--cache", "cache", "-b", "1")


class Measure(CommandTest):
    def measure(self, *words, scene=CORNELL, **keywords):
        return self.run_command("measure", scene, *SMALL, *words, **keywords)

    def test_a_sweep(self):
        done = self.measure("-t", "direct,voxel_path", "--sweep", "voxel.resolution=8,16", "-s", "4",
                            "--json", "a.json", "--csv", "a.csv", "--pictures", "pictures")
        report = self.read_json("a.json")
        points = report["points"]
        self.assertEqual(len(report["configurations"]), 3)
        self.assertEqual([(p["configuration"], p["samples"]) for p in points],
                         [(c, s) for s in (1, 2, 4) for c in (0, 1, 2)])
        self.assertEqual(points[2]["options"], {"voxel.resolution": 16})
        self.assertEqual(report["reference"]["samples"], [16, 16])
        self.assertIs(report["interrupted"], False)
        for point in points:
            self.check_point(point)
        rows = list(csv.DictReader(io.StringIO(self.read("a.csv").decode())))
        self.assertEqual(len(rows), len(points))
        self.assertAlmostEqual(float(rows[4]["relmse"]) / points[4]["relmse"]["value"], 1, 6)
        self.assertEqual(report["clock"], "wall")
        self.assertEqual([line[0] for line in done.stdout.decode().splitlines()[1:10]].count("*"),
                         sum(point["front"] for point in points))
        self.check_pictures(report)

    def test_any_number_of_samples(self):
        """Such as an answer has: powers of two below it, and the number itself."""
        for most, counts in ((1, [1]), (5, [1, 2, 4, 5]), (6, [1, 2, 4, 6])):
            self.measure("-t", "direct", "-s", str(most), "--json", "a.json")
            self.assertEqual([p["samples"] for p in self.read_json("a.json")["points"]], counts)

    def test_processor_time(self):
        """Another clock makes other points."""
        words = ("-t", "direct", "-s", "1", "--json", "a.json")
        self.measure(*words, "--clock", "processor")
        report = self.read_json("a.json")
        self.assertEqual(report["clock"], "processor")
        self.assertGreater(report["points"][0]["milliseconds"]["median"], 0)
        self.refuse("measure", CORNELL, *SMALL, *words, "--resume", status=FILE,
                    says=["a.json: something else was measured"])

    def check_point(self, point):
        self.assertEqual(len(point["seeds"]), 3)
        error = point["relmse"]
        products = iter(error["products"])
        table = {(s, t): next(products) for s in range(3) for t in range(s, 3)}
        diagonal = sum(table[s, s] for s in range(3)) / 3
        other = sum(table[s, t] for s in range(3) for t in range(s + 1, 3)) / 3
        self.assertAlmostEqual(error["value"], diagonal, 7)
        self.assertAlmostEqual(error["squared_bias"]["value"], other, 7)
        self.assertAlmostEqual(error["variance"], diagonal - other, 7)
        self.assertLess(error["low"], error["high"])
        times = [seed["milliseconds"] for seed in point["seeds"]]
        self.assertAlmostEqual(point["milliseconds"]["median"], sorted(times)[1], 4)
        self.assertGreaterEqual(point["gl_bytes"]["peak"], point["gl_bytes"]["plan"])
        for name in ("ssim", "flip", "flip_hdr", "rmse"):
            self.assertTrue(0 <= point[name]["value"] <= 1, name)

    def check_pictures(self, report):
        """What is kept is what `render` makes, and `compare` finds the errors that were found."""
        for point in report["points"][3:6]:
            words = shlex.split(report["configurations"][point["configuration"]]["command"])[1:]
            self.run_command(*words, "-s", str(point["samples"]), "-o", "again.exr", "-q")
            self.assertEqual(self.pixels("again.exr"), self.pixels(point["picture"]))
            self.run_command("compare", "again.exr", *report["reference"]["halves"], "--flip",
                             "--json", "compare.json")
            compared = self.read_json("compare.json")
            self.assertAlmostEqual(compared["relmse"] / point["relmse"]["products"][0], 1, 5)
            self.assertAlmostEqual(compared["ssim"], point["seeds"][0]["ssim"], 6)
            self.assertAlmostEqual(compared["flip_hdr"], point["seeds"][0]["flip_hdr"], 6)
            self.assertTrue(os.path.getsize(self.path(point["preview"])) > 0)

    def reference(self, *words, **keywords):
        self.measure("-t", "direct", "-s", "1", "--json", "a.json", "-q", *words, **keywords)
        return self.read_json("a.json")["reference"]

    def test_the_reference_is_kept(self):
        first = self.reference()
        self.assertIs(first["cached"], False)
        self.assertEqual(os.listdir(self.path("cache")), [first["key"] + ".reference"])
        again = self.reference("--seed", "7")
        self.assertIs(again["cached"], True)
        self.assertEqual(again["mean"], first["mean"])
        more = self.reference("--reference-samples", "24")
        self.assertEqual((more["samples"], more["cached"]), ([24, 24], False))
        self.assertNotEqual(self.reference("--bounces", "0")["key"], first["key"])
        self.assertIs(self.reference("--cache", "none")["cached"], False)

    def test_damaged_reference_is_traced_again(self):
        key = self.reference()["key"]
        path = self.path(f"cache/{key}.reference")
        with open(path, "r+b") as file:
            file.seek(100)
            file.write(b"\0\1\2\3")
        done = self.measure("-t", "direct", "-s", "1")
        self.assertIn("the reference is traced again", done.text)
        self.assertNotIn("warning", self.measure("-t", "direct", "-s", "1").text)

    def test_another_scene_is_another_reference(self):
        keys = {self.reference(scene=self.scene("a.gltf"))["key"],
                self.reference(scene=self.scene("b.gltf"))["key"],
                self.reference(scene=self.scene("c.gltf", emissive=True))["key"]}
        self.assertEqual(len(keys), 2)

    def test_resume(self):
        words = ("-t", "direct", "--sweep", "shadow.filter=none,pcf", "--json", "a.json")
        self.measure(*words, "-s", "2")
        before = self.read_json("a.json")
        done = self.measure(*words, "-s", "4", "--resume")
        after = self.read_json("a.json")
        self.assertIn("a.json: 4 points from before", done.text)
        self.assertEqual(len(after["points"]), 6)
        for old, new in zip(before["points"], after["points"]):
            for name in ("seeds", "samples", "options", "gl_bytes"):
                self.assertEqual(old[name], new[name])
            self.assertEqual(old["relmse"]["products"], new["relmse"]["products"])
        for other in (("--seed", "3"), ("-D", "shadow.texels_per_pixel=8"), ("--raw",)):
            self.refuse("measure", CORNELL, *SMALL, *words, *other, "--resume", status=FILE,
                        says=["a.json: something else was measured"])
        with open(self.path("a.json"), "w", encoding="utf-8") as file:
            file.write('{"command": "render"}')
        self.refuse("measure", CORNELL, *SMALL, *words, "--resume", status=FILE,
                    says=["a.json: was not written by measure --json"])

    def test_an_answer(self):
        done = self.measure("-t", "direct,voxel_path", "--sweep", "voxel.resolution=8,16",
                            "--budget-ms", "1e6", "-s", "5", "--json", "a.json", "--pictures", "p",
                            "--save-preset", "best.txt")
        answer = self.read_json("a.json")["answer"]
        self.assertIn(answer["command"], done.stdout.decode())
        self.assertIs(answer["met"], True)
        self.assertIn(answer["samples"], (4, 5))
        self.assertLessEqual(answer["relmse"]["value"], min(
            point["relmse"]["value"] for point in self.read_json("a.json")["points"]
            if len(point["seeds"]) == 3) + 1e-12)
        self.run_command(*shlex.split(answer["command"])[1:], "-o", "a.exr", "-q")
        self.run_command("render", CORNELL, "-r", "16,12", "--preset", "best.txt", "-o", "b.exr", "-q")
        point = next(point for point in self.read_json("a.json")["points"]
                     if (point["configuration"], point["samples"]) ==
                     (answer["configuration"], answer["samples"]))
        self.assertEqual(self.pixels("a.exr"), self.pixels("b.exr"))
        self.assertEqual(self.pixels("a.exr"), self.pixels(point["picture"]))
        plan = self.run_command("plan", CORNELL, "-r", "16,12", "--preset", "best.txt").stdout
        self.assertIn(b"%d iterations, 1 bounce" % answer["samples"], plan)
        self.answer_measured_once_more(point)

    def answer_measured_once_more(self, point):
        """By its own preset, and nothing beside it; the search may have taken more seeds."""
        self.measure("--preset", "best.txt", "--json", "b.json")
        again = self.read_json("b.json")
        self.assertEqual(len(again["configurations"]), 1)
        last = again["points"][-1]
        self.assertEqual(last["samples"], point["samples"])
        for one, other in zip(last["seeds"], point["seeds"]):
            self.assertEqual([one[k] for k in ("seed", "ssim", "bias")],
                             [other[k] for k in ("seed", "ssim", "bias")])

    def test_shortest_time_to_an_error(self):
        words = ("-t", "direct,voxel_path", "--sweep", "voxel.resolution=8", "-s", "4")
        self.measure(*words, "--error", "0.9", "--json", "a.json")
        self.assertIs(self.read_json("a.json")["answer"]["met"], True)
        done = self.measure(*words, "--error", "1e-9", "--json", "a.json")
        self.assertIs(self.read_json("a.json")["answer"]["met"], False)
        self.assertIn("No measurement gives relMSE 1e-09", done.stdout.decode())

    def test_an_interrupt_keeps_what_is_measured(self):
        words = ["measure", CORNELL, *SMALL, "-t", "direct", "-s", "65536", "--json", "a.json"]
        mine, theirs = pty.openpty()
        process = subprocess.Popen([COMMAND, *words], cwd=self.folder, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=theirs, preexec_fn=hear_signals)
        os.close(theirs)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.kill)
        seen, sent = b"", False
        for part in shown_by(mine):
            seen += part
            if not sent and re.search(rb"measure \[.*[1-9]\d\d/\d+ samples, .* left", seen):
                process.send_signal(signal.SIGINT)
                sent = True
        os.close(mine)
        process.wait(60)
        self.assertEqual(process.returncode, DONE, seen)
        report = self.read_json("a.json")
        self.assertIs(report["interrupted"], True)
        self.assertGreater(len(report["points"]), 3)
        words[words.index("65536")] = "16"
        self.run_command(*words, "--resume")
        resumed = self.read_json("a.json")
        self.assertIs(resumed["interrupted"], False)
        self.assertEqual(resumed["points"][0]["seeds"], report["points"][0]["seeds"])

    def test_frames(self):
        """What is kept from frame to frame flickers less; a path that stands still changes nothing.

        With one point a pixel, so that both have the same noise at edges whatever the defaults
        are: it is most of the flicker of 192 pixels. Of seven changes between eight frames only
        the first is from a frame without history."""
        paths = {}
        words = ("-t", "voxel_path", "--sweep", "voxel.resolution=8", "-D", "gbuffer.side=1",
                 "-s", "1", "--frames", "0-7", "--json", "a.json")
        for name, more in (("still", []), ("turn", ["--turntable", "90"]),
                           ("temporal", ["--turntable", "90", "--temporal"])):
            self.measure(*words, *more)
            point = self.read_json("a.json")["points"][0]
            paths[name] = point["path"]
            self.assertEqual((paths[name]["frames"], paths[name]["temporal"]),
                             (8, name == "temporal"))
        self.assertEqual(paths["still"]["motion"], 0)
        self.assertGreater(paths["turn"]["motion"], 0.01)
        self.assertLess(paths["temporal"]["flicker"]["value"],
                        0.5 * paths["turn"]["flicker"]["value"])
        self.assertLess(paths["temporal"]["difference"]["value"],
                        paths["turn"]["difference"]["value"])
        self.measure(*words, "--turntable", "90", "--temporal", "--resume")
        self.assertEqual(self.read_json("a.json")["points"][0]["path"], paths["temporal"])

    def test_wrong_usage(self):
        for words, says in (
                (["--budget-ms", "1", "--error", "1"], "--budget-ms and --error"),
                (["--save-preset", "a"], "--save-preset a: needs a search"),
                (["--resume"], "--resume: needs the file"),
                (["--json", "-", "--csv", "-"], "only one of them"),
                (["--csv", "-", "--html", "-"], "--csv - and --html -: only one of them"),
                (["-t", "direct", "--sweep", "vpl.count=1,2"], "none of the techniques takes"),
                (["--sweep", "vpl.count=1,2", "--sweep", "vpl.count=4"], "vpl.count=4: that option is swept already"),
                (["--sweep", "vpl.cuont=1"], "did you mean vpl.count?"),
                (["--sweep", "vpl.count=1,many"], "vpl.count"),
                (["-t", "direct,cones"], "did you mean"),
                (["--temporal"], "--temporal: there are no frames"),
                (["--frames", "3-3"], "--frames: at least two frames"),
                (["--seeds", "1"], "--seeds 1")):
            self.refuse("measure", CORNELL, *SMALL, *words, says=[says])
        self.assertEqual(self.files(), [])

    def test_warnings_are_said_once(self):
        scene = os.path.join(SOURCE_ROOT, "data/scenes/cornell_emissive.gltf")
        done = self.measure("-t", "direct", "-s", "2", scene=scene)
        self.assertEqual(done.text.count("the direct technique leaves every surface black"), 1)

    def test_standard_output(self):
        words = ("-t", "direct", "-s", "1")
        report = json.loads(self.measure(*words, "--json", "-").stdout)
        self.assertEqual(report["command"], "measure")
        table = self.measure(*words, "--csv", "-").stdout.decode()
        self.assertEqual(len(table.splitlines()), 2)
        self.assertEqual(self.measure(*words, "-q").stdout, b"")
        page = self.measure(*words, "--html", "-").stdout
        self.assertTrue(page.startswith(b"<!DOCTYPE html>") and page.rstrip().endswith(b"</html>"))

    def test_a_full_disk_spoils_one_file_alone(self):
        with open("/dev/full", "wb") as full:
            done = self.run_command("measure", CORNELL, *SMALL, "-t", "direct", "-s", "1", "--html", "-",
                                    "--json", "a.json", "--csv", "a.csv", status=FILE, stdout=full)
        self.assertIn("standard output", done.text)
        self.assertEqual(len(self.read_json("a.json")["points"]), 1)
        self.assertEqual(len(self.read("a.csv").splitlines()), 2)
        self.refuse("measure", CORNELL, *SMALL, "--html", "none/a.html", status=FILE, says=["none/a.html"])


if __name__ == "__main__":
    if "reference" not in os.environ["LSF_MODULES"]:
        print("skipped: built without the reference")
        sys.exit(77)
    main()

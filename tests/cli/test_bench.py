"""lightsheaf bench: what it prints. How fast anything is depends on the machine and is not tested."""
import json
import os
import unittest

from command import SOURCE_ROOT, USAGE, CommandTest, main

CORNELL = os.path.join(SOURCE_ROOT, "data/scenes/cornell_point.gltf")
EMBREE = "reference" in os.environ["LSF_MODULES"]


@unittest.skipUnless(EMBREE, "built without Embree")
class Rays(CommandTest):
    def test_json(self):
        done = self.run_command("bench", "rays", CORNELL, "-r", "64,48", "-s", "2", "--json", "-")
        report = json.loads(done.stdout)
        self.assertEqual((report["command"], report["measurement"]), ("bench", "rays"))
        self.assertEqual(report["scene"], CORNELL)
        self.assertRegex(report["embree_function"], "^rtcIntersect")
        self.assertEqual([row["bundle"] for row in report["rows"]], [256, 512, 1024])
        for row in report["rows"]:
            self.assertEqual(set(row), {"screen", "bundle", "slices", "rays", "build_ms", "search_ms",
                                        "mrays_per_s", "embree_mrays_per_s", "agreement"})
            self.assertEqual(row["screen"], [64, 48])
            self.assertLessEqual(row["rays"], 64 * 48)
            milliseconds = row["build_ms"] + row["search_ms"]
            self.assertAlmostEqual(row["mrays_per_s"] * milliseconds, row["rays"] * 1e-3, places=4)
            self.assertGreater(row["embree_mrays_per_s"], 0)
            # Large surfaces without fine detail: both see the same but at edges.
            self.assertGreater(row["agreement"], 0.97)
            self.assertLessEqual(row["agreement"], 1)

    def test_table(self):
        text = self.run_command("bench", "rays", CORNELL, "-r", "32,32", "-s", "1").stdout.decode()
        self.assertRegex(text, r"(?m)^screen +bundle +build ms +search ms +M rays/s +Embree +agreement$")
        self.assertEqual(text.count("\n32x32 "), 3)
        quiet = self.run_command("bench", "rays", CORNELL, "-r", "32,32", "-s", "1", "-q")
        self.assertEqual(quiet.stdout, b"")

    def test_tessellated(self):
        """Bundles and Embree see the same surface: the options of passes count for both."""
        done = self.run_command("bench", "rays", self.glossy(), "-r", "64,48", "-s", "1", "--json", "-",
                                "-D", "tessellation.factor=3")
        self.assertGreater(json.loads(done.stdout)["rows"][0]["agreement"], 0.95)

    def glossy(self):
        return os.path.join(SOURCE_ROOT, "data/scenes/cornell_glossy.gltf")

    def test_nothing_to_see(self):
        self.refuse("bench", "rays", CORNELL, "-r", "8,8", "--camera-position", "0,0,90",
                    "--camera-target", "0,0,99", says=["no rays"])


class Bidirectional(CommandTest):
    # Small, so that it is fast; the rows are the same.
    SMALL = ("-r", "16,12", "-s", "1", "-D", "tessellation.factor=1", "-D", "vpl.count=4", "-D",
             "interleave.size=2", "-D", "bundle.count=4")

    def test_json(self):
        done = self.run_command("bench", "bidirectional", CORNELL, "--json", "-", *self.SMALL)
        report = json.loads(done.stdout)
        self.assertEqual(report["measurement"], "bidirectional")
        (report,) = report["measured"]
        self.assertEqual((report["screen"], report["supersampling"]), ([16, 12], 2))
        self.assertEqual((report["triangles"], report["tessellation_factor"]), (34, 1))
        self.assertEqual(report["frames"], 1)
        self.assertIn("bundle.count=21", report["options"])
        self.assertEqual(report["options"][-1], "bundle.count=4")
        rows = report["rows"]
        self.assertEqual(rows[0]["procedure"], "Create G-Buffer")
        self.assertEqual(rows[-1]["procedure"], "Others")
        self.assertEqual(len(rows), 12)
        self.assertAlmostEqual(sum(row["paper_ms"] for row in rows), report["paper_total_ms"])
        self.assertAlmostEqual(sum(row["ms"] or 0 for row in rows), report["total_ms"], places=3)
        for row in rows:
            self.assertGreater(row["ms"], 0, row)

    def test_table(self):
        text = self.run_command("bench", "bidirectional", CORNELL, *self.SMALL).stdout.decode()
        self.assertRegex(text, r"(?m)^procedure +ms +paper ms$")
        self.assertRegex(text, r"(?m)^Create VPL Shadow Map x21 +[\d.]+ +29\.9$")
        self.assertRegex(text, r"(?m)^Total +[\d.]+ +77\.8$")

    def test_triangles_of_the_paper(self):
        done = self.run_command("bench", "bidirectional", "--json", "-", "-r", "4,4", "-s", "1", "-D",
                                "vpl.count=1", "-D", "bundle.count=1", "-D", "interleave.size=1")
        triangles = json.loads(done.stdout)["measured"][0]["triangles"]
        self.assertGreater(triangles, 174e3 / 2)
        self.assertLess(triangles, 174e3 * 2)


class Cone(CommandTest):
    SMALL = ("-r", "24,16", "-s", "1", "-D", "voxel.resolution=16")

    def test_json(self):
        done = self.run_command("bench", "cone", CORNELL, "--json", "-", *self.SMALL)
        report = json.loads(done.stdout)
        self.assertEqual(report["measurement"], "cone")
        (report,) = report["measured"]
        self.assertEqual(report["screen"], [24, 16])
        self.assertEqual(report["options"][-1], "voxel.resolution=16")
        self.assertAlmostEqual(sum(row["ms"] or 0 for row in report["rows"]), report["total_ms"],
                               places=3)
        # Cones that march alone read a pyramid.
        for row in report["rows"][:-1]:
            if row["procedure"] == "Build pyramid":
                self.assertIsNone(row["ms"])
            else:
                self.assertGreater(row["ms"], 0, row["procedure"])
        done = self.run_command("bench", "cone", CORNELL, "--json", "-", *self.SMALL, "-D",
                                "cone.sealed=off")
        for row in json.loads(done.stdout)["measured"][0]["rows"][:-1]:
            self.assertGreater(row["ms"], 0, row["procedure"])

    def test_table(self):
        text = self.run_command("bench", "cone", CORNELL, *self.SMALL).stdout.decode()
        self.assertRegex(text, r"(?m)^Trace cones +[\d.]+ +-$")
        self.assertRegex(text, r"(?m)^Total +[\d.]+ +-$")


class VoxelPath(CommandTest):
    SMALL = ("-r", "24,16", "-s", "1", "-D", "voxel.resolution=16")

    def test_json(self):
        done = self.run_command("bench", "voxel_path", CORNELL, "--json", "-", *self.SMALL)
        report = json.loads(done.stdout)
        self.assertEqual(report["measurement"], "voxel_path")
        self.assertEqual(len(report["measured"]), 2)
        for frame in report["measured"]:
            self.assertEqual((frame["screen"], frame["frames"]), ([24, 16], 1))
            self.assertEqual(frame["options"][-1], "voxel.resolution=16")
            rows = {row["procedure"]: row for row in frame["rows"]}
            self.assertAlmostEqual(sum(row["ms"] or 0 for row in frame["rows"]),
                                   frame["total_ms"], places=3)
            for name in ("Gather", "Trace", "Blur", "Output"):
                self.assertGreater(rows[name]["ms"], 0, name)
        full, coarse = report["measured"]
        self.assertIsNone({row["procedure"]: row for row in full["rows"]}["Upsample"]["ms"])
        self.assertGreater({row["procedure"]: row for row in coarse["rows"]}["Upsample"]["ms"], 0)

    def test_table(self):
        text = self.run_command("bench", "voxel_path", CORNELL, *self.SMALL).stdout.decode()
        self.assertRegex(text, r"(?m)^Trace +[\d.]+ +-$")
        self.assertRegex(text, r"(?m)^Total +[\d.]+ +57\.1$")
        self.assertRegex(text, r"(?m)^Total +[\d.]+ +33\.3$")


class Usage(CommandTest):
    def test_measurements(self):
        self.refuse("bench", says=["rays|bidirectional|cone|voxel_path"])
        self.refuse("bench", "ray", says=["ray: no such measurement", "did you mean rays?"])
        self.refuse("bench", "rays", CORNELL, "more", says=["more", "one operand too many"])
        self.refuse("bench", "rays", "--output", "a.png", says=["an option of render"])
        self.refuse("bench", "rays", "--samples", "65", says=["1..64"])
        self.refuse("bench", "rays", "no-such.gltf", status=3, says=["no-such.gltf"])


if __name__ == "__main__":
    main()

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
        done = self.run_command("bench", "rays", CORNELL, "-r", "64,48", "-s", "2", "--json")
        report = json.loads(done.stdout)
        self.assertEqual((report["command"], report["measurement"]), ("bench", "rays"))
        self.assertEqual(report["scene"], CORNELL)
        self.assertRegex(report["embree_function"], "^rtcIntersect")
        self.assertEqual([row["bundle"] for row in report["rows"]], [256, 512, 1024])
        for row in report["rows"]:
            self.assertEqual(set(row), {"screen", "bundle", "rays", "build_ms", "search_ms",
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
        done = self.run_command("bench", "rays", self.glossy(), "-r", "64,48", "-s", "1", "--json",
                                "-D", "tessellation.factor=3")
        self.assertGreater(json.loads(done.stdout)["rows"][0]["agreement"], 0.95)

    def glossy(self):
        return os.path.join(SOURCE_ROOT, "data/scenes/cornell_glossy.gltf")

    def test_nothing_to_see(self):
        self.refuse("bench", "rays", CORNELL, "-r", "8,8", "--camera-position", "0,0,90",
                    "--camera-target", "0,0,99", says=["no rays"])


class Usage(CommandTest):
    def test_measurements(self):
        self.refuse("bench", says=["rays|bidirectional"])
        self.refuse("bench", "ray", says=["ray: no such measurement", "did you mean rays?"])
        self.refuse("bench", "rays", CORNELL, "more", says=["more", "one operand too many"])
        self.refuse("bench", "rays", "--output", "a.png", says=["an option of render"])
        self.refuse("bench", "rays", "--samples", "65", says=["1..64"])
        self.refuse("bench", "rays", "no-such.gltf", status=3, says=["no-such.gltf"])


if __name__ == "__main__":
    main()

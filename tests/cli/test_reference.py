"""lightsheaf reference and compare, as commands; what they compute is tested beside them."""
import json
import os
import struct
import sys

from command import DIFFERS, FILE, USAGE, CommandTest, exr_channels, main

SMALL = ("--resolution", "16,12", "--samples", "4", "--bounces", "1", "--quiet")


class Reference(CommandTest):
    def test_picture(self):
        scene = self.scene()
        self.run_command("reference", scene, "-o", "a.exr", "--aov", "albedo,depth,direct", *SMALL)
        self.assertLess({"R", "albedo.G", "depth.Z", "direct.B"}, set(exr_channels(self.read("a.exr"))))
        self.run_command("reference", scene, "-o", "b.png", "--aov", "albedo", *SMALL, status=USAGE)
        self.run_command("reference", scene, "-o", "b.png", *SMALL)
        self.assertEqual(self.run_command("reference", scene, "-o", "-", "--format", "png",
                                          *SMALL).stdout, self.read("b.png"))

    def test_default_scene(self):
        self.run_command("reference", "-o", "a.hdr", *SMALL)

    def test_json(self):
        done = self.run_command("reference", self.scene(), "-o", "a.exr", "--json", "-", *SMALL)
        report = json.loads(done.stdout)
        self.assertEqual(report["command"], "reference")
        self.assertEqual(report["samples"], 4)
        self.assertGreater(report["rays"], 16 * 12 * 4)
        self.assertEqual(set(report["seconds"]), {"load", "build", "render", "save", "total"})

    def test_halves(self):
        done = self.run_command("reference", self.scene(), "-o", "truth.v1.exr", "--halves", "--json",
                                "-", *SMALL)
        self.assertEqual(self.files(), ["scene.gltf", "truth.v1.exr", "truth.v1_a.exr",
                                        "truth.v1_b.exr"])
        report = json.loads(done.stdout)
        self.assertEqual(report["halves"], ["truth.v1_a.exr", "truth.v1_b.exr"])
        self.assertEqual(report["samples"], 8)
        self.assertNotEqual(self.pixels("truth.v1_a.exr"), self.pixels("truth.v1_b.exr"))
        done = self.run_command("compare", "truth.v1.exr", "truth.v1_a.exr", "truth.v1_b.exr",
                                "--json", "-")
        # The mean is as far from one half as from the other: x - a = -(x - b).
        json.loads(done.stdout)

    def test_options_without_effect_are_named(self):
        done = self.run_command("reference", self.scene(), "-o", "a.exr", "-r", "8,8", "-s", "1",
                                "--technique", "direct", "--backend", "osmesa", "-D",
                                "shadow.filter=pcf")
        for name in ("--technique", "--backend", "--define"):
            self.assertIn(f"warning: {name}: has no effect on the reference", done.text)


class Compare(CommandTest):
    def pictures(self):
        scene = self.scene()
        self.run_command("reference", scene, "-o", "a.exr", "--seed", "1", *SMALL)
        self.run_command("reference", scene, "-o", "b.exr", "--seed", "2", *SMALL)

    def test_text_and_json(self):
        self.pictures()
        self.assertIn("relmse", self.run_command("compare", "a.exr", "b.exr").stdout.decode().lower())
        report = json.loads(self.run_command("compare", "a.exr", "b.exr", "--json", "-").stdout)
        self.assertIsInstance(report, dict)
        self.run_command("compare", "--json", "-", "b.exr", "a.exr", "a.exr")

    def test_threshold(self):
        self.pictures()
        self.run_command("compare", "a.exr", "a.exr", "--threshold", "rmse=0")
        self.run_command("compare", "--threshold", "rmse=0", "a.exr", "b.exr", status=DIFFERS)
        self.run_command("compare", "a.exr", "b.exr", "--threshold", "nonsense=1", status=USAGE)

    def test_files(self):
        self.pictures()
        self.run_command("compare", "a.exr", "missing.exr", status=FILE)
        self.run_command("compare", "a.exr", "b.exr", "--difference", "d.png")
        self.assertTrue(self.read("d.png").startswith(b"\x89PNG"))
        self.run_command("compare", "a.exr", "b.exr", "--difference", "nowhere/d.png", status=FILE)

    def test_infinite_pixels_fail(self):
        self.pictures()
        data = bytearray(16 * 12 * 4)
        struct.pack_into("<f", data, 0, float("nan"))
        write_exr(self.path("nan.exr"), 16, 12, bytes(data))
        self.run_command("compare", "nan.exr", "b.exr", status=DIFFERS)


def write_exr(path, width, height, plane):
    """An uncompressed float32 EXR whose R, G and B are the same plane."""
    def attribute(name, kind, value):
        return name + b"\0" + kind + b"\0" + struct.pack("<i", len(value)) + value
    channels = b"".join(c + b"\0" + struct.pack("<iBBBBii", 2, 0, 0, 0, 0, 1, 1)
                        for c in (b"B", b"G", b"R")) + b"\0"
    box = struct.pack("<4i", 0, 0, width - 1, height - 1)
    header = b"\x76\x2f\x31\x01" + struct.pack("<i", 2)
    header += attribute(b"channels", b"chlist", channels)
    header += attribute(b"compression", b"compression", b"\0")
    header += attribute(b"dataWindow", b"box2i", box) + attribute(b"displayWindow", b"box2i", box)
    header += attribute(b"lineOrder", b"lineOrder", b"\0")
    header += attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1))
    header += attribute(b"screenWindowCenter", b"v2f", struct.pack("<2f", 0, 0))
    header += attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)) + b"\0"
    row_bytes = 3 * 4 * width
    start = len(header) + 8 * height
    offsets = b"".join(struct.pack("<Q", start + y * (8 + row_bytes)) for y in range(height))
    rows = b"".join(struct.pack("<ii", y, row_bytes) + 3 * plane[4 * width * y:4 * width * (y + 1)]
                    for y in range(height))
    with open(path, "wb") as file:
        file.write(header + offsets + rows)


if __name__ == "__main__":
    if "reference" not in os.environ.get("LSF_MODULES", "reference"):
        sys.exit(77)  # built without Embree
    main()

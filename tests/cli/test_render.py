"""lightsheaf render, info and plan on tiny scenes, through OpenGL in software."""
import json
import os
import pty
import subprocess
import unittest

from command import (COMMAND, NO_GL, SOURCE_ROOT, USAGE, CommandTest, exr_channels, main, png_size,
                     shown_by)

SMALL = ("--resolution", "16,12", "--samples", "2", "--quiet", "--gl-debug")


class Pictures(CommandTest):
    def test_formats(self):
        scene = self.scene()
        for name in ("a.exr", "a.hdr", "a.png", "A.PNG"):
            done = self.run_command("render", scene, "-o", name, *SMALL)
            self.assertEqual((done.text, done.stdout), ("", b""))
        self.assertEqual(exr_channels(self.read("a.exr")), {"R": 2, "G": 2, "B": 2})
        self.assertTrue(self.read("a.hdr").startswith(b"#?RADIANCE"))
        self.assertEqual(png_size(self.read("a.png")), (16, 12))
        self.assertEqual(self.pixels("a.png"), self.pixels("A.PNG"))
        self.assertEqual(self.files(), ["A.PNG", "a.exr", "a.hdr", "a.png", "scene.gltf"])

    def test_standard_output(self):
        scene = self.scene()
        self.run_command("render", scene, "-o", "a.exr", *SMALL)
        self.run_command("render", scene, "-o", "a.png", *SMALL)
        self.assertEqual(self.run_command("render", scene, "-o", "-", *SMALL).stdout,
                         self.read("a.exr"))
        self.assertEqual(
            self.run_command("render", scene, "-o", "-", "--format", "png", *SMALL).stdout,
            self.read("a.png"))

    def test_order_does_not_matter(self):
        scene = self.scene()
        self.run_command("render", scene, "-o", "a.exr", "--seed", "7", *SMALL)
        self.run_command("render", *SMALL, "--seed=7", "-o", "b.exr", scene)
        self.run_command("render", *SMALL, "-ob.exr", "--seed", "7", "--", scene)
        self.assertEqual(self.pixels("a.exr"), self.pixels("b.exr"))

    def test_seed(self):
        scene = self.scene()
        for name, seed in (("a.exr", 1), ("b.exr", 1), ("c.exr", 2)):
            self.run_command("render", scene, "-o", name, "--seed", str(seed), *SMALL)
        self.assertEqual(self.pixels("a.exr"), self.pixels("b.exr"))
        self.assertNotEqual(self.pixels("a.exr"), self.pixels("c.exr"))

    def test_layers(self):
        self.run_command("render", self.scene(), "-o", "a.exr", "--aov", "albedo,normal,depth,motion",
                         "--aov", "direct", *SMALL)
        names = set(exr_channels(self.read("a.exr")))
        self.assertEqual(names, {"R", "G", "B", "albedo.R", "albedo.G", "albedo.B", "normal.X",
                                 "normal.Y", "normal.Z", "depth.Z", "motion.X", "motion.Y",
                                 "direct.R", "direct.G", "direct.B"})
        self.run_command("render", self.scene(), "-o", "a.exr", "--aov", "all", *SMALL)
        names = set(exr_channels(self.read("a.exr")))
        self.assertLess({"emission.R", "indirect_diffuse.G", "indirect_specular.B"}, names)

    def test_exposure_is_for_eight_bits(self):
        scene = self.scene()
        for suffix in ("exr", "png"):
            self.run_command("render", scene, "-o", f"a.{suffix}", *SMALL)
            self.run_command("render", scene, "-o", f"b.{suffix}", "--exposure", "-3", *SMALL)
        self.assertEqual(self.pixels("a.exr"), self.pixels("b.exr"))
        self.assertNotEqual(self.pixels("a.png"), self.pixels("b.png"))

    def test_camera(self):
        scene = self.scene(animated=True)
        views = ([], ["--camera", "0", "--fov-y", "20"], ["--camera-position", "-1,0.5,2"],
                 ["--camera-position=-1,0.5,2", "--camera-target", "0,0,0"], ["--time", "1"])
        pictures = []
        for words in views:
            self.run_command("render", scene, "-o", "a.exr", *words, *SMALL)
            pictures.append(self.pixels("a.exr"))
        self.assertEqual(len(set(pictures)), len(views))
        self.run_command("render", scene, "-o", "b.exr", "--camera", "Front", *SMALL)
        self.assertEqual(self.pixels("b.exr"), pictures[0])

    def test_camera_that_frames_the_scene(self):
        """It is there whether or not the file has one, too."""
        for name, words in ("with", ["--camera", "default"]), ("without", []):
            scene = self.scene(f"{name}.gltf", camera=name == "with")
            self.run_command("render", scene, "-o", f"{name}.exr", *words, *SMALL)
        self.assertEqual(self.pixels("with.exr"), self.pixels("without.exr"))

    def test_default_light(self):
        """A dial that glows does not keep the rest of the picture dark."""
        scene = self.scene(emissive=True, light=False)
        words = ("-t", "direct", *SMALL)
        done = self.run_command("render", scene, "-o", "a.exr", *words[:6])
        self.assertIn("a default sky and key light are added", done.text)
        self.run_command("render", scene, "-o", "b.exr", "--default-light", "never", *words)
        done = self.run_command("compare", "a.exr", "b.exr", "--json", "-")
        measured = json.loads(done.stdout)
        self.assertGreater(min(a - b for a, b in zip(measured["mean_test"],
                                                     measured["mean_reference"])), 0.05)
        lit = self.scene("lit.gltf")
        self.run_command("render", lit, "-o", "c.exr", *words)
        self.run_command("render", lit, "-o", "d.exr", "--default-light", "never", *words)
        self.run_command("render", lit, "-o", "e.exr", "--default-light", "always", *words)
        self.assertEqual(self.pixels("c.exr"), self.pixels("d.exr"))
        self.assertNotEqual(self.pixels("c.exr"), self.pixels("e.exr"))

    def test_dark_picture_warns(self):
        scene = self.scene(light=False)
        words = ("render", scene, "-t", "direct", *SMALL[:4], "-o", "a.png")
        self.assertNotIn("nearly black", self.run_command(*words).text)
        self.assertIn("a.png: nearly black",
                      self.run_command(*words, "--default-light", "never").text)
        for name, further in (("a.exr", []), ("b.png", ["--background", "transparent"])):
            for when in ("always", "never"):
                text = self.run_command(*words, "-o", name, "--default-light", when, *further).text
                self.assertEqual(f"{name}: nearly black" in text, when == "never", text)

    def test_white_picture_warns(self):
        words = ("render", self.scene(), "-t", "direct", *SMALL[:4], "-o", "a.png")
        transparent = ("--background", "transparent")
        for further in ((), transparent):
            self.assertNotIn("overexposed", self.run_command(*words, *further).text)
            self.assertIn("a.png: overexposed",
                          self.run_command(*words, *further, "--exposure", "20").text)
            self.assertNotIn("overexposed",
                             self.run_command(*words, *further, "--exposure", "auto").text)
        self.assertNotIn("overexposed", self.run_command(*words, "-o", "a.exr").text)

    def test_tone_curves(self):
        scene = self.scene()
        words = ("render", scene, "-t", "direct", *SMALL)
        curves = ("neutral", "none", "aces", "agx")
        for curve in curves:
            self.run_command(*words, "-o", f"{curve}.png", "--tonemap", curve)
        self.run_command(*words, "-o", "default.png")
        self.assertEqual(self.pixels("default.png"), self.pixels("neutral.png"))
        self.assertEqual(len({self.pixels(f"{curve}.png") for curve in curves}), 4)
        self.refuse(*words, "-o", "a.png", "--tonemap", "filmic", says=["neutral|none|aces|agx"])

    def test_auto_exposure(self):
        """By what it says, the same picture comes out; other light gives the same picture."""
        scene = self.scene()
        words = ("render", scene, "-t", "direct", *SMALL[:4])
        done = self.run_command(*words, "-o", "a.png", "--exposure", "auto", "--json", "a.json")
        self.assertRegex(done.text, r"a\.png: exposure [+-]\d+\.\d\d EV")
        report = self.read_json("a.json")
        self.assertEqual(report["options"]["exposure"], "auto")
        self.run_command(*words, "-o", "b.png", "--exposure", repr(report["exposure"]), "--json",
                         "b.json")
        self.assertEqual(self.read_json("b.json")["exposure"], report["exposure"])
        difference = json.loads(self.run_command("compare", "a.png", "b.png", "--json", "-").stdout)
        self.assertGreater(difference["psnr"] or 99, 45)  # GPU and CPU round differently
        self.run_command(*words, "-o", "c.exr", "--exposure", "auto", "--json", "c.json")
        self.assertIsNone(self.read_json("c.json")["exposure"])
        self.refuse(*words, "-o", "a.png", "--exposure", "bright", says=["auto or a number"])

    def test_background(self):
        scene = self.scene()
        words = ("render", scene, "-t", "direct", *SMALL)
        self.run_command(*words, "-o", "a.exr", "--background", "transparent")
        self.assertEqual(exr_channels(self.read("a.exr")), {"R": 2, "G": 2, "B": 2, "A": 2})
        self.run_command(*words, "-o", "a.png", "--background", "transparent", "--json", "a.json")
        self.assertEqual(self.read("a.png")[25], 6)  # colour type: RGB with alpha
        self.assertEqual(self.read_json("a.json")["options"]["background"], "transparent")
        self.run_command(*words, "-o", "b.png", "--background", "0,.5,0", "--json", "b.json")
        self.assertEqual(self.read("b.png")[25], 2)
        self.assertEqual(self.read_json("b.json")["options"]["background"], [0, 0.5, 0])
        self.refuse(*words, "-o", "a.hdr", "--background", "transparent", says=["holds no alpha"])
        self.refuse(*words, "-o", "a.png", "--background", "red",
                    says=["--background red", "environment, transparent, or three numbers"])

    def test_default_scene(self):
        self.run_command("render", "-o", "a.png", *SMALL)
        self.run_command("render", os.path.join(SOURCE_ROOT, "data/scenes/interior.gltf"), "-o",
                         "b.png", *SMALL)
        self.assertEqual(self.pixels("a.png"), self.pixels("b.png"))

    def test_time_limit(self):
        done = self.run_command("render", self.scene(), "-o", "a.exr", "--resolution", "16,12",
                                "--time-limit", "0.3", "--json", "-")
        report = json.loads(done.stdout)
        self.assertGreater(report["samples"], 0)
        self.assertIsNone(report["options"]["samples"])
        self.assertLess(report["seconds"]["render"], 5)

    def test_backends_agree(self):
        scene = self.scene()
        for backend in ("egl", "osmesa"):
            self.run_command("render", scene, "-o", f"{backend}.exr", "--backend", backend, *SMALL,
                             env={**os.environ, "LIBGL_ALWAYS_SOFTWARE": "1"})
        self.assertEqual(self.pixels("egl.exr"), self.pixels("osmesa.exr"))

    def test_no_gl(self):
        """A loader that finds neither libEGL nor libOSMesa cannot be had everywhere; a driver that
        offers an old version can."""
        done = self.run_command("render", self.scene(), "-o", "a.exr", *SMALL, status=NO_GL,
                                env={**os.environ, "MESA_GL_VERSION_OVERRIDE": "3.3",
                                     "LIBGL_ALWAYS_SOFTWARE": "1"})
        self.assertIn("4.5", done.text)
        self.assertEqual(self.files(), ["scene.gltf"])


class Progress(CommandTest):
    def run_at_terminal(self, *words):
        """What a terminal sees on stderr."""
        mine, theirs = pty.openpty()
        try:
            with subprocess.Popen([COMMAND, *words], cwd=self.folder, stdin=subprocess.DEVNULL,
                                  stdout=subprocess.PIPE, stderr=theirs) as process:
                os.close(theirs)
                theirs = -1
                seen = b"".join(shown_by(mine))
                process.wait(60)
                self.assertEqual(process.returncode, 0, seen)
            return seen.decode()
        finally:
            os.close(mine)
            if theirs >= 0:
                os.close(theirs)

    def test_bar_is_drawn_and_removed(self):
        seen = self.run_at_terminal("render", self.scene(), "-o", "a.exr", "-r", "64,48",
                                    "--time-limit", "1")
        self.assertRegex(seen, r"\rrender \[[#.]{30}\] +\d+%  \d+ samples")
        self.assertIn("left", seen)
        bar_end = seen.rindex("samples\x1b[K") if "samples\x1b[K" in seen else seen.rindex("left\x1b[K")
        self.assertIn("\r\x1b[K", seen[bar_end:])
        self.assertRegex(seen.splitlines()[-1], r"lightsheaf: a\.exr: 64x48, \d+ samples of bidirectional")

    def test_quiet(self):
        self.assertEqual(self.run_at_terminal("render", self.scene(), "-o", "a.exr", *SMALL), "")

    def test_no_bar_without_a_terminal(self):
        done = self.run_command("render", self.scene(), "-o", "a.exr", "-r", "64,48", "-s", "8")
        self.assertEqual(done.text.count("\n"), 1)
        self.assertNotIn("\r", done.text)
        self.assertTrue(done.text.startswith("lightsheaf: a.exr: 64x48, 8 samples of bidirectional"))

    def test_verbose_says_more(self):
        done = self.run_command("render", self.scene(), "-o", "a.exr", "-r", "8,8", "-s", "1", "-v")
        self.assertGreater(done.text.count("\n"), 1)


class Json(CommandTest):
    def test_schema(self):
        self.run_command("render", self.scene(), "-o", "a.exr", "--json", "a.json", "--bounces", "2",
                         "--seed", "18446744073709551615", "--aov", "normal,albedo", "-e", "1,.5,0",
                         "-D", "shadow.filter=pcf", "--camera-position", "0,0,3", *SMALL)
        report = self.read_json("a.json")
        self.assertEqual(set(report), {
            "lightsheaf", "command", "scene", "output", "technique", "seed", "bounces", "resolution",
            "lost_share", "exposure", "denoiser_weights",
            "samples", "interrupted", "options", "device", "seconds", "passes", "gl_bytes", "notes"})
        self.assertEqual(report["command"], "render")
        self.assertEqual(report["technique"], "bidirectional")
        self.assertEqual(report["seed"], 18446744073709551615)
        self.assertEqual(report["resolution"], [16, 12])
        self.assertEqual(report["samples"], 2)
        self.assertIs(report["interrupted"], False)
        options = report["options"]
        self.assertEqual(set(options), {
            "samples", "time_limit", "camera", "camera_position", "camera_target", "fov_y", "time",
            "exposure", "tonemap", "aovs", "environment", "environment_rotation",
            "environment_strength", "background", "default_light", "diffuse_only",
            "show_back_faces", "lenient", "scene",
            "animations", "variant", "halves", "backend",
            "shader_dir", "gl_debug", "passes"})
        self.assertEqual(options["aovs"], ["albedo", "normal"])
        self.assertEqual(options["environment"], [1, 0.5, 0])
        self.assertEqual(options["camera_position"], [0, 0, 3])
        self.assertIsNone(options["camera_target"])
        self.assertEqual(options["passes"]["shadow.filter"], "pcf")
        self.assertEqual(set(report["seconds"]), {"load", "context", "compile", "upload", "render",
                                                  "save", "total"})
        self.assertGreater(report["seconds"]["total"], report["seconds"]["render"])
        self.assertEqual(set(report["device"]), {"backend", "vendor", "renderer", "version",
                                                 "software", "robust"})
        self.assertGreater(len(report["passes"]), 0)
        for each in report["passes"]:
            self.assertEqual(set(each), {"name", "runs", "milliseconds", "counts"})
        self.assertEqual(report["gl_bytes"]["plan"], report["gl_bytes"]["now"])
        self.assertGreaterEqual(report["gl_bytes"]["peak"], report["gl_bytes"]["now"])

    def test_to_standard_output(self):
        done = self.run_command("render", self.scene(), "-o", "a.exr", "--json", "-", *SMALL)
        self.assertEqual(json.loads(done.stdout)["output"], "a.exr")

    def test_notes_are_kept(self):
        done = self.run_command("render", self.scene(light=False), "-o", "a.exr", "--json", "-", "-r",
                                "8,8", "-s", "1")
        self.assertTrue(any("light" in note for note in json.loads(done.stdout)["notes"]))
        self.assertIn("lightsheaf: warning: ", done.text)


class WithoutGl(CommandTest):
    """info and plan open no context: a driver that is too old does not disturb them."""

    def run_without_gl(self, *words):
        return self.run_command(*words, env={**os.environ, "MESA_GL_VERSION_OVERRIDE": "1.1",
                                             "__EGL_VENDOR_LIBRARY_DIRS": "/nonexistent"})

    def test_info(self):
        scene = self.scene()
        self.assertIn("point", self.run_without_gl("info", scene).stdout.decode())
        self.assertIsInstance(json.loads(self.run_without_gl("info", "--json", "-", scene).stdout), dict)
        self.assertEqual(self.run_without_gl("info", self.scene("b.gltf", light=False)).text, "")

    def test_plan(self):
        scene = self.scene()
        words = ("plan", scene, "-r", "32,32", "-b", "0", "--aov", "albedo", "-D", "shadow.filter=pcf")
        self.assertIn("gbuffer", self.run_without_gl(*words).stdout.decode().lower())
        self.assertIsInstance(json.loads(self.run_without_gl(*words, "--json", "-").stdout), dict)

    def test_plan_for_a_time(self):
        words = ("plan", self.scene(), "--time-limit", "3")
        self.assertIn("as many iterations as the time limit allows",
                      self.run_without_gl(*words).stdout.decode())
        self.assertIsNone(json.loads(self.run_without_gl(*words, "--json", "-").stdout)["samples"])

    def test_bounces_that_materials_need(self):
        def planned(name, *words):
            scene = os.path.join(SOURCE_ROOT, "data/scenes", name)
            return json.loads(self.run_without_gl("plan", scene, "--json", "-", *words).stdout)["bounces"]

        self.assertEqual(planned("cornell_point.gltf"), 3)
        self.assertEqual(planned("cornell_glass.gltf"), 7)
        self.assertEqual(planned("cornell_glass.gltf", "--bounces", "2"), 2)
        self.assertEqual(planned("cornell_glass.gltf", "--diffuse-only"), 3)

    def test_plan_refuses_the_wrong(self):
        self.refuse("plan", self.scene(), "-o", "a.exr", status=USAGE, says=["-o"])


if __name__ == "__main__":
    unittest.util._MAX_LENGTH = 2000
    main()

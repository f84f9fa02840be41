"""What a picture's header tells: how it was made, and how to make it again."""
import json
import os
import shlex
import shutil
import struct
import subprocess
import unittest
import zlib

from command import COMMAND, FILE, SOURCE_ROOT, CommandTest, main

SMALL = ("--resolution", "8,8", "--technique", "direct", "--quiet")
KEYS = {f"lightsheaf.{name}" for name in ("version", "command", "scene", "technique", "bounces", "samples",
                                          "seed")}


class Headers(CommandTest):
    def texts(self, name):
        return json.loads(self.run_command("info", name, "--json", "-").stdout)["texts"]

    def test_what_is_told(self):
        self.scene()
        for words, name in (([], "a.exr"), ([], "a.png"), (["--exposure", "auto"], "b.png")):
            self.run_command("render", "scene.gltf", "-o", name, "--seed", "18446744073709551615", "-s", "3",
                             *SMALL, *words)
            texts = self.texts(name)
            self.assertLessEqual(KEYS, set(texts))
            version = self.run_command("--version").stdout.decode()
            self.assertEqual(f"lightsheaf {texts['lightsheaf.version']}\n", version)
            self.assertEqual(texts["lightsheaf.scene"], "scene.gltf")
            self.assertEqual(texts["lightsheaf.technique"], "direct")
            self.assertEqual(texts["lightsheaf.bounces"], "0")
            self.assertEqual(texts["lightsheaf.samples"], "3")
            self.assertEqual(texts["lightsheaf.seed"], "18446744073709551615")
            self.assertTrue(texts["lightsheaf.command"].startswith("lightsheaf render scene.gltf --seed 18446"))

    def test_command_makes_it_again(self):
        """Whatever the names are; where it went and what was said beside it is no part of it."""
        scene = os.path.basename(self.scene("it's a $scene;.gltf"))
        self.scene("other.gltf")
        self.run_command("render", "other.gltf", scene, "-o", "%s.exr", "-c", "Front", "-s2", "-D",
                         "shadow.filter=pcf", "--diffuse-only", "--json", "a.json", *SMALL)
        texts = self.texts("it's a $scene;.exr")
        self.assertEqual(texts["lightsheaf.scene"], scene)
        words = shlex.split(texts["lightsheaf.command"])
        self.assertEqual(words, ["lightsheaf", "render", scene, "--camera", "Front", "--samples", "2", "--define",
                                 "shadow.filter=pcf", "--diffuse-only", "--resolution", "8,8", "--technique",
                                 "direct"])
        again = texts["lightsheaf.command"].replace("lightsheaf", shlex.quote(COMMAND), 1)
        subprocess.run(["sh", "-c", f"{again} -o again.exr -q"], cwd=self.folder, check=True)
        self.assertEqual(self.read("again.exr"), self.read("it's a $scene;.exr"))

    def test_weights_of_the_denoiser(self):
        """Those of the environment are named where a network ran, and are part of the command."""
        name = "my weights.lsfd"
        shutil.copy(os.path.join(SOURCE_ROOT, "data/denoiser/weights.lsfd"), self.path(name))
        given = {**os.environ, "LIGHTSHEAF_DENOISER_WEIGHTS": name}
        own = {key: value for key, value in os.environ.items() if key != "LIGHTSHEAF_DENOISER_WEIGHTS"}
        scene = os.path.join(SOURCE_ROOT, "data/scenes/cornell_point.gltf")
        for env, kind, weights in ((given, "network", name), (own, "network", None), (given, "atrous", None)):
            self.run_command("render", scene, "-o", "a.exr", "-s", "1", "-t", "cone", "-r", "16,16", "--json", "a.json",
                             "-D", f"light_filter.kind={kind}", env=env)
            texts = self.texts("a.exr")
            self.assertEqual(self.read_json("a.json")["denoiser_weights"], weights)
            self.assertEqual(texts.get("lightsheaf.denoiser_weights"), weights)
            command = texts["lightsheaf.command"]
            self.assertEqual(command.startswith(f"env 'LIGHTSHEAF_DENOISER_WEIGHTS={name}' lightsheaf render "),
                             weights is not None)
            again = command.replace(" lightsheaf ", f" {shlex.quote(COMMAND)} ", 1)
            if weights:
                subprocess.run(["sh", "-c", f"{again} -o again.exr -q"], cwd=self.folder, env=own, check=True)
                self.assertEqual(self.read("again.exr"), self.read("a.exr"))

    @unittest.skipUnless("reference" in os.environ.get("LSF_MODULES", ""), "no path tracer")
    def test_reference(self):
        self.run_command("reference", self.scene(), "-o", "a.exr", "--halves", "-s", "2", "-b", "3", "-r", "4,4")
        for name, samples in (("a_a.exr", "2"), ("a_b.exr", "2"), ("a.exr", "4")):
            texts = self.texts(name)
            self.assertEqual(texts["lightsheaf.technique"], "path tracing")
            self.assertEqual(texts["lightsheaf.bounces"], "3")
            self.assertEqual(texts["lightsheaf.samples"], samples)

    def test_info_on_pictures(self):
        self.run_command("render", self.scene(), "-o", "a.exr", "-s", "1", "--aov", "normal", *SMALL)
        self.run_command("render", "scene.gltf", "-o", "a.hdr", "-s", "1", *SMALL)
        report = json.loads(self.run_command("info", "a.exr", "--json", "-").stdout)
        self.assertEqual([report[key] for key in ("picture", "format", "resolution", "type")],
                         ["a.exr", "exr", [8, 8], "f32"])
        self.assertEqual(sorted(report["channels"]), ["B", "G", "R", "normal.X", "normal.Y", "normal.Z"])
        done = self.run_command("info", "a.exr", "a.hdr", "scene.gltf")
        parts = done.stdout.decode().split("\n\n")
        self.assertIn("\nlightsheaf.samples       1\n", parts[0])
        self.assertEqual(parts[1].split("\n")[1:], ["picture                  hdr, 8 x 8, 32 bit",
                                                    "channels                 R G B"])
        self.assertTrue(parts[2].startswith("scene.gltf\nnodes "))

    def test_texts_of_others(self):
        """A header may hold anything: nothing of it steers a terminal, and what is damaged is refused."""
        def chunk(kind, data):
            body = kind + data
            return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))
        start = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 0, 0, 0, 0))
        end = chunk(b"IDAT", zlib.compress(b"\0\0")) + chunk(b"IEND", b"")
        texts = chunk(b"tEXt", b"no end") + chunk(b"tEXt", b"") + chunk(b"tEXt", b"Key\0\x1b[31m\"red\"") + \
            chunk(b"tEXt", b"Empty\0")
        with open(self.path("a.png"), "wb") as file:
            file.write(start + texts + end)
        self.assertEqual(self.texts("a.png"), {"Key": "\x1b[31m\"red\"", "Empty": ""})
        self.assertNotIn(b"\x1b", self.run_command("info", "a.png").stdout)
        for name, content in (("cut.png", (start + texts + end)[:-20]), ("cut.exr", b"\x76\x2f\x31\x01\x02\0\0\0ab")):
            with open(self.path(name), "wb") as file:
                file.write(content)
            self.refuse("info", name, status=FILE, says=[name])


if __name__ == "__main__":
    main()

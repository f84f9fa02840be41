"""Help, versions, lists, and what a wrong command line gets."""
import json
import os
import pty
import subprocess

from command import COMMAND, DONE, FILE, SOURCE_ROOT, USAGE, CommandTest, main

COMMANDS = ("render", "view", "reference", "compare", "info", "plan", "bench", "measure", "help")


class Help(CommandTest):
    def test_overview(self):
        for words in (["--help"], ["-h"], ["help"]):
            text = self.run_command(*words).stdout.decode()
            for command in COMMANDS:
                self.assertIn(f"\n  {command} ", text)

    def test_every_command_explains_itself(self):
        for command in COMMANDS:
            text = self.run_command(command, "--help").stdout.decode()
            self.assertTrue(text.startswith(f"Usage: lightsheaf {command} "), text)
            self.assertEqual(text, self.run_command("help", command).stdout.decode())
            self.assertLessEqual(max(map(len, text.splitlines())), 80, text)

    def test_help_wins_over_missing_operands(self):
        self.run_command("info", "-h")
        self.run_command("compare", "--help")
        self.run_command("render", "--samples", "3", "--help")

    def test_version(self):
        for words in (["--version"], ["-V"], ["render", "--version"]):
            self.assertRegex(self.run_command(*words).stdout.decode(),
                             r"^lightsheaf \d+\.\d+\.\d+\n$")

    def test_lists(self):
        techniques = self.run_command("render", "--list-techniques").stdout.decode()
        self.assertRegex(techniques, r"(?m)^direct +\S")
        options = self.run_command("plan", "--list-options").stdout.decode().splitlines()
        self.assertRegex(options[0], r"^option +type +range +default +effect$")
        self.assertTrue(any(line.startswith("shadow.filter ") for line in options), options)


class Words(CommandTest):
    def test_one_is_not_several(self):
        """A square is one primitive of one instance; two of anything are several."""
        text = self.run_command("info", self.scene()).stdout.decode()
        self.assertIn("meshes       1, 1 primitive, 1 instance\n", text)
        self.assertIn("from 0 images\n", text)
        text = self.run_command("info", self.scene(animated=True)).stdout.decode()
        self.assertIn("1 channel, 1 s\n", text)
        for words, says in ((["-s", "1", "-b", "1"], "1 iteration, 1 bounce\n"),
                            (["-s", "2", "-b", "2"], "2 iterations, 2 bounces\n"),
                            (["-s", "2", "-b", "0"], "2 iterations, no bounces\n")):
            text = self.run_command("plan", self.scene(), *words).stdout.decode()
            self.assertIn(says, text.splitlines(keepends=True)[0])
        for technique in ("direct", "bidirectional", "cone", "voxel_path", "substitute_tree"):
            text = self.run_command("plan", self.scene(), "-s", "1", "-t", technique).stdout.decode()
            self.assertNotRegex(text, r"(?<![\d.])1 [a-z]+s\b")

    def test_direct_has_no_bounces(self):
        glass = os.path.join(SOURCE_ROOT, "data/scenes/cornell_glass.gltf")
        for words, remarked in (([], False), (["-b", "3"], True)):
            text = self.run_command("plan", glass, "-t", "direct", *words).stdout.decode()
            self.assertIn("64 iterations, no bounces\n", text)
            self.assertEqual("has no bounces; 3 asked for" in text, remarked, text)
        done = self.run_command("render", self.scene(), "-t", "direct", "-r", "8,8", "-s", "1", "-o",
                                "a.exr", "--json", "-")
        self.assertEqual(json.loads(done.stdout)["bounces"], 0)
        self.assertIn("1 sample of direct, rendered in", done.text)

    def test_json_is_uniform_across_commands(self):
        """FILE beside the text, or - in its place."""
        self.run_command("render", self.scene(), "-r", "8,8", "-s", "1", "-o", "a.exr", "--json",
                         "render.json")
        for name, words in (("info", ["scene.gltf"]), ("plan", ["scene.gltf"]),
                            ("compare", ["a.exr", "a.exr"])):
            text = self.run_command(name, *words).stdout
            done = self.run_command(name, *words, "--json", f"{name}.json")
            self.assertEqual(done.stdout, text)
            self.assertIsInstance(self.read_json(f"{name}.json"), dict)
            self.assertEqual(self.run_command(name, *words, "--json", "-").stdout,
                             self.read(f"{name}.json"))


class Refusals(CommandTest):
    def test_nothing(self):
        done = self.run_command(status=USAGE)
        self.assertIn("Usage: lightsheaf COMMAND", done.text)
        self.assertEqual(done.stdout, b"")

    def test_unknown_command(self):
        self.refuse("rendr", says=["rendr", "did you mean render?"])
        self.refuse("help", "referense", says=["did you mean reference?"])
        self.refuse("xyzzy", says=["xyzzy", "lightsheaf help"])

    def test_unknown_option(self):
        self.refuse("render", "--smaples", "3", says=["--smaples", "did you mean --samples?"])
        self.refuse("render", "--halves", says=["--halves", "an option of reference, not of render"])

    def test_bad_values_name_option_value_and_range(self):
        self.refuse("render", "-o", "a.exr", "--samples", "none",
                    says=["--samples none", "1..1000000000"])
        self.refuse("plan", "--resolution", "0,0", says=["--resolution 0,0", "1..65535"])
        self.refuse("reference", "-o", "a.exr", "--fov-y", "180", says=["--fov-y 180", "0.01..179"])

    def test_bad_pass_options(self):
        self.refuse("render", "-o", "a.exr", "-D", "shadow.fliter=pcf",
                    says=["shadow.fliter=pcf", "did you mean shadow.filter?"])
        self.refuse("render", "-o", "a.exr", "-D", "shadow", says=["pass.key=value"])
        self.refuse("render", "-o", "a.exr", "-D", "cone.scale=0.5", says=["replaced by", "sparse.grid"])
        scene = self.scene()
        self.refuse("plan", scene, "-D", "shadow.filter=soft", says=["shadow.filter", "pcf"])
        self.refuse("render", scene, "-o", "a.exr", "-D", "shadow.filter=",
                    says=["shadow.filter", "pcf"])

    def test_missing_output(self):
        self.refuse("render", self.scene(), says=["--output", "-o picture.exr"])

    def test_unknown_ending(self):
        for name in ("a.jpg", "a", "exr", ".exr"):
            self.refuse("render", self.scene(), "-o", name, says=[name, ".exr, .hdr or .png"])

    def test_layers_need_exr(self):
        self.refuse("render", self.scene(), "-o", "a.png", "--aov", "normal", says=["--aov", "a.png"])
        self.refuse("render", self.scene(), "-o", "-", "--format", "hdr", "--aov", "normal",
                    says=["--aov"])

    def test_two_things_in_one_place(self):
        self.refuse("render", self.scene(), "-o", "-", "--json", "-", says=["--json -"])
        self.refuse("render", self.scene(), "-o", "a.exr", "--json", "a.exr", says=["--json a.exr"])
        self.refuse("reference", self.scene(), "-o", "a.exr", "--halves", "--json", "a_b.exr",
                    says=["--json a_b.exr"])
        self.refuse("render", self.scene(), "-o", "a.json", "--format", "exr", "--json", "a.json",
                    says=["--json a.json"])
        self.refuse("reference", self.scene(), "-o", "-", "--halves", says=["--halves"])
        self.assertEqual(self.files(), ["scene.gltf"])

    def test_json_never_replaces_what_it_is_about(self):
        """`--json` once took no value, and a name behind it is easily one of the operands."""
        for words in (["compare", "--json", "a.exr", "b.exr", "c.exr"], ["info", "--json", "a.glb", "b.glb"]):
            self.refuse(*words, says=[f"--json {words[2]}", "report.json", "standard output"])

    def test_no_picture_into_a_terminal(self):
        mine, theirs = pty.openpty()
        try:
            done = self.run_command("render", self.scene(), "-o", "-", status=USAGE, stdout=theirs)
            self.assertIn("terminal", done.text)
        finally:
            os.close(mine)
            os.close(theirs)

    def test_unknown_camera(self):
        self.refuse("render", self.scene(), "-o", "a.exr", "--camera", "Back", says=["Back", '0 "Front"'])
        self.refuse("plan", self.scene(), "--technique", "dirct", says=["did you mean direct?"])

    def test_what_others_call_it(self):
        for word, meant in (("--size", "--resolution"), ("--spp", "--samples"), ("--envmap", "--environment")):
            self.refuse("render", self.scene(), "-o", "a.exr", f"{word}=1", says=[f"did you mean {meant}?"])
        self.refuse("render", self.scene(), "-o", "a.exr", "-t", "path", says=["voxel_path", "direct"])
        self.refuse("render", self.scene(), "-o", "a.exr", "-e", "red", says=["three numbers"])

    def test_every_error_is_one_line(self):
        for words in (["rendr"], ["render", "-s", "x"], ["info", "missing.gltf"]):
            done = subprocess.run([COMMAND, *words], cwd=self.folder, capture_output=True,
                                  check=False)
            self.assertNotEqual(done.returncode, DONE)
            self.assertEqual(done.stderr.count(b"\n"), 1, done.stderr)
            self.assertTrue(done.stderr.startswith(b"lightsheaf: error: "), done.stderr)
            self.assertEqual(done.stdout, b"")

    def test_full_standard_output(self):
        with open("/dev/full", "wb") as full:
            done = self.run_command("--help", status=FILE, stdout=full)
            self.assertIn("standard output", done.text)
            self.run_command("info", self.scene(), status=FILE, stdout=full)


if __name__ == "__main__":
    main()

"""The viewer under a display without a screen: what it shows is what `lightsheaf render` makes."""
import csv
import json
import os
import shlex
import shutil
import sys

from display import Display, WindowTest, main, read_png

COMMAND = os.environ["LSF_COMMAND"]
SCENES = os.path.join(os.environ["LSF_SOURCE_ROOT"], "data/scenes")
SIZE = "96,72"
PAGE = os.path.join(os.environ["LSF_SOURCE_ROOT"], "docs/window.md")
BEGIN, END = "<!-- keys: begin -->\n", "<!-- keys: end -->"


class View(WindowTest):
    def view(self, *lines, scene="cornell_point.gltf", words=(), status=0):
        """Without panels, so that the picture fills the window."""
        script = self.write("script", "\n".join(lines) + "\n")
        scenes = [os.path.join(SCENES, scene)] if scene else []
        return self.run_program(COMMAND, "view", *scenes, "-r", SIZE, "-s", "2", "--replay", script,
                                *words, status=status)

    def shot(self, *lines, **keywords):
        """The last picture that is saved, and the command line that is copied for it."""
        keys = ["900 settle", "900 key F12", "901 key-up F12", "903 key Control", "904 key C",
                "905 key-up C", "905 key-up Control", "906 key Shift", "907 key F12",
                "908 key-up Shift", "910 close"]
        done = self.view("1 key Tab", "2 key-up Tab", *lines, *keys, **keywords)
        self.assertEqual(done.stderr, "")
        return done.stdout.splitlines()[-1]

    def check(self, *lines, **keywords):
        """What was copied makes what was saved, to the bit, and so does the window."""
        command = self.shot(*lines, **keywords)
        self.assertTrue(command.startswith("lightsheaf render "), command)
        self.run_program(COMMAND, *shlex.split(command)[1:], "-q", "-o", "rendered.png")
        rendered = read_png(self.path("rendered.png"))
        self.assertEqual(read_png(self.path("lightsheaf-0001.png")), rendered, command)
        self.assertEqual(read_png(self.path("lightsheaf-0001-window.png"))[:2], rendered[:2])
        self.assertEqual(read_png(self.path("lightsheaf-0001-window.png"))[2], rendered[2], command)
        return command, rendered

    def test_the_file_s_own_camera(self):
        command, (width, height, _) = self.check()
        self.assertEqual((width, height), (96, 72))
        self.assertNotIn("--camera", command)

    def test_moves_of_the_camera(self):
        command, _ = self.check("5 move 40 40", "6 button 0", "7 move 60 30", "8 button-up 0",
                                "9 button 2", "10 move 55 35", "11 button-up 2", "12 scroll 2",
                                "13 button 1", "14 key W", "15 move 50 30", "20 key-up W",
                                "21 button-up 1", words=["-t", "direct"])
        self.assertIn("--camera-position", command)
        self.assertIn("--camera-target", command)

    def test_what_is_edited(self):
        """A node that is clicked is moved by its arrow; a new light, dimmed; a material, recoloured."""
        command, _ = self.check("2 key-up Tab", "3 key Tab", "4 key-up Tab", "5 move 60 95", "6 button 0",
                                "7 button-up 0", "8 press Scene", "9 set Roughness = 0.25",
                                "10 set Base colour = 0.25,0.5,0.75", "11 press New light", "12 move 50 120",
                                "13 button 0", "14 button-up 0", "15 set Intensity = 0.5",
                                "16 set Position = 0.25,1.25,0.5", "20 key Tab", "21 key-up Tab",
                                words=["-t", "direct", "-r", "400,240"])
        for part in ("--light ", "--edit light/1/intensity=0.5,0.5,0.5", "/roughness=0.25",
                     "/base_color=0.25,0.5,0.75,1", "--edit node/9/matrix=1,0,0,0,0,1,0,0,0,0,1,0,0.25"):
            self.assertIn(part, command)

    def test_rotation_and_scale(self):
        """A node by its rings and the square; a light, made a spot, by what it stands on; and the environment."""
        self.run_program(COMMAND, "render", os.path.join(SCENES, "cornell_point.gltf"), "-q", "-t", "direct", "-r",
                         "16,8", "-s", "1", "-o", "sky.exr")
        command, _ = self.check("2 key-up Tab", "3 key Tab", "4 key-up Tab", "5 move 60 95", "6 button 0",
                                "7 button-up 0", "8 drag 10 4 ring X", "9 drag -20 3 ring Y", "9 drag 4 9 ring Z",
                                "9 drag -6 6 handle scale", "10 press Scene", "10 press Nodes", "11 press Lamp", "11 set Kind = spot",
                                "12 set Cone = 60", "13 set Turn = 80", "13 set Strength = 2", "14 settle",
                                "14 set Turn = 50", "20 key Tab", "21 key-up Tab",
                                words=["-t", "direct", "-r", "400,240", "-s", "1", "-e", self.path("sky.exr")])
        for part in ("/type=spot", "--edit environment/rotation=50", "--edit environment/strength=2"):
            self.assertIn(part, command)
        self.assertNotIn("--environment-", command)
        matrix = [float(number) for number in command.split("/matrix=")[1].split()[0].split(",")]
        lengths = [sum(value * value for value in matrix[i:i + 3]) ** 0.5 for i in (0, 4, 8)]
        for length in lengths:
            self.assertAlmostEqual(length, lengths[0], places=9)
        self.assertLess(lengths[0], 0.95, "smaller")
        for i, j in ((0, 1), (0, 2), (1, 2)):
            self.assertAlmostEqual(sum(matrix[4 * i + k] * matrix[4 * j + k] for k in range(3)), 0, places=9)
            self.assertGreater(abs(matrix[4 * i + j]), 0.01, "turned about each axis")

    def test_a_transparent_background(self):
        command = self.shot(words=["-t", "direct", "--background", "transparent"])
        self.assertIn("--background transparent", command)
        self.run_program(COMMAND, *shlex.split(command)[1:], "-q", "-o", "rendered.png")
        self.assertEqual(read_png(self.path("lightsheaf-0001.png"), alpha=True),
                         read_png(self.path("rendered.png"), alpha=True))
        self.assertEqual(len(read_png(self.path("rendered.png"), alpha=True)[2][0][0]), 4)

    def test_split_against_itself_and_the_path_tracer(self):
        """The same technique makes the same picture in the other half; the path tracer nearly so."""
        self.view("2 press Compare", "3 set Beside = direct", "4 settle", "5 key Tab", "6 key-up Tab", "7 settle",
                  "8 key F12", "9 key Shift", "9 key F12", "11 key-up Shift", "12 key Tab",
                  "13 key-up Tab", "14 set Beside = the path tracer", "15 settle", "16 key Tab",
                  "17 settle", "18 key Shift", "18 key F12", "22 close", words=["-t", "direct", "-b", "0", "-r", "300,200"])
        picture = read_png(self.path("lightsheaf-0001.png"))[2]
        same = read_png(self.path("lightsheaf-0001-window.png"))[2]
        traced = read_png(self.path("lightsheaf-0002-window.png"))[2]
        self.assertEqual(same[100][160:], picture[100][160:], "right of the bar")
        self.assertEqual(traced[100][:140], picture[100][:140], "left of the bar")
        self.assertNotEqual(traced[100][160:], picture[100][160:])
        means = [sum(sum(pixel) for row in rows[120:190] for pixel in row[160:]) for rows in (picture, traced)]
        self.assertLess(abs(means[0] / means[1] - 1), 0.1)

    def test_dropped_scene_and_changed_file(self):
        with open(os.path.join(SCENES, "cornell_point.gltf"), encoding="utf-8") as file:
            text = file.read()
        shutil.copy(os.path.join(SCENES, "cornell_point.bin"), self.folder)
        self.write("room.gltf", text)
        program = self.replay_shots(COMMAND, "view", "-r", SIZE, "-s", "1", "-t", "direct", shot=["key F12", "key-up F12"],
                                    first=["key Tab", "key-up Tab", f"drop {self.path('room.gltf')}", "settle"])
        bright = self.shown(program, "the room")[36][48]
        document = json.loads(text)
        document["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"] *= 0.5
        self.write("room.gltf", json.dumps(document))
        self.shown(program, "the room by half its light", lambda rows: sum(bright) > sum(rows[36][48]) + 30)
        program.terminate()
        self.assertEqual(program.communicate()[1], "")

    def test_frame_times_are_written(self):
        """A line for each frame; and what a moving picture is, beside the path tracer's from the same place."""
        moves = [f"{5 + k} move {40 + k} {40 + k / 4}" for k in range(12)]
        self.view("1 key Tab", "2 key-up Tab", "3 move 40 40", "4 button 0", *moves, "16 snapshot moved", "17 button-up 0",
                  "18 settle", "19 snapshot still", "22 close", words=["-t", "direct", "--frame-times", "times.csv"])
        with open(self.path("times.csv"), encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([int(row["frame"]) for row in rows], list(range(len(rows))))
        self.assertGreater(len(rows), 20)
        for row in rows:
            self.assertGreater(float(row["seconds"]), 0)
            self.assertLessEqual((int(row["width"]), int(row["height"])), (96, 72))
        self.assertEqual([row["picture"] for row in rows[6:17]], 11 * ["moving"])
        self.assertIn("still", [row["picture"] for row in rows[18:]])
        self.run_program(COMMAND, "reference", "--view", "moved.view", "-b", "0", "-s", "64", "-q", "-o", "traced.exr")
        for name, error in (("moved", 0.4), ("still", 0.05)):
            self.run_program(COMMAND, "compare", f"{name}.exr", "traced.exr", "--threshold", f"relmse={error}")

    def test_the_script_that_measures(self):
        script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "measure_motion.py")
        table = self.run_program(sys.executable, script, "--work", self.folder, "--lightsheaf", COMMAND, "--scenes", "cornell",
                                 "--techniques", "direct", "--sizes", "80x60", "--frames", "20", "--reference-samples", "8").stdout
        cells = table.splitlines()[-1].strip("| ").split(" | ")
        self.assertEqual(cells[:2], ["`cornell`, `direct`", "80×60"])
        self.assertGreater(float(cells[2]), 0.5, "frames a second")
        self.assertGreater(float(cells[-1]), 0.6, "SSIM")

    def test_shaders_that_change(self):
        """They are read anew; a mistake is told in the window, which goes on with what is right again."""
        folder = self.path("glsl")
        shutil.copytree(os.path.join(os.environ["LSF_SOURCE_ROOT"], "glsl"), folder)
        shader = os.path.join(folder, "passes/tonemap.frag.glsl")
        with open(shader, encoding="utf-8") as file:
            text = file.read()
        red = text.replace("display_out =", "display_out = vec4(1.0, 0.0, 0.0, 1.0); vec4 before =")

        environment = dict(self.environment())
        environment.pop("MESA_SHADER_DUMP_PATH", None)  # for tests/shaders: one is wrong on purpose
        program = self.replay_shots(COMMAND, "view", os.path.join(SCENES, "cornell_point.gltf"), "--shader-dir", folder,
                                    "-r", "300,200", "-s", "1", "-t", "direct", environment=environment,
                                    first=["settle"], shot=["key Shift", "key F12", "key-up F12", "key-up Shift"])

        def shown(what, good):
            return self.shown(program, what, good, ending="-window.png")[100][60]

        first = shown("the picture", lambda rows: True)
        self.write(shader, "wrong")
        shown("the red heading", lambda rows: any(r > 200 and 80 < g < 150 for r, g, b in sum(rows, [])))
        self.write(shader, red)
        shown("the red picture", lambda rows: rows[100][60] == (255, 0, 0))
        self.write(shader, text)
        shown("the picture again", lambda rows: rows[100][60] == first)
        program.terminate()
        self.assertEqual(program.communicate()[1], "")

    def test_a_dense_screen(self):
        """Panels are twice as large on a screen of twice the density; the picture fills what they leave."""
        sizes = {}
        for density in (96, 192):
            display = Display("1600x1000")
            self.addCleanup(display.close)
            display.set_density(density)
            script = self.write("script", "6 snapshot shown\n8 close\n")
            environment = {**self.environment(), "DISPLAY": display.name}
            self.run_program(COMMAND, "view", os.path.join(SCENES, "cornell_point.gltf"), "-r", "1600,1000", "-s", "1", "-t",
                             "direct", "--replay", script, environment=environment)
            with open(self.path("shown.view"), encoding="utf-8") as file:
                line = next(line for line in file if line.startswith("resolution="))
            sizes[density] = [int(side) for side in line[11:].split(",")]
        panels = {density: (1600 - width, 1000 - height) for density, (width, height) in sizes.items()}
        for one, two in zip(panels[96], panels[192]):
            self.assertAlmostEqual(two / one, 2, delta=0.1)

    def test_the_page_lists_the_keys(self):
        """LSF_UPDATE=1 in the environment brings docs/window.md up to date instead."""
        lines = self.run_program(COMMAND, "view", "--list-keys").stdout.splitlines()
        rows = "".join(f"| {line[:31].strip()} | {line[31:]} |\n" for line in lines)
        self.assertGreater(len(lines), 20)
        with open(PAGE, encoding="utf-8") as file:
            before, rest = file.read().split(BEGIN)
        table, after = rest.split(END)
        wanted = "| keys | what they do |\n| --- | --- |\n" + rows
        if os.environ.get("LSF_UPDATE"):
            with open(PAGE, "w", encoding="utf-8") as file:
                file.write(before + BEGIN + wanted + END + after)
        else:
            self.assertEqual(table, wanted)

    def test_no_display(self):
        done = self.run_program(COMMAND, "view", status=4, environment={"PATH": "/usr/bin"})
        self.assertEqual(len(done.stderr.splitlines()), 1)
        self.assertIn("xvfb-run", done.stderr)

    def test_loading_error_appears_in_the_window(self):
        self.write("bad.gltf", "{")
        self.view("20 key Shift", "20 key F12", "25 close", scene=None,
                  words=[self.path("bad.gltf"), "-r", "320,240"])
        colors = {pixel for row in read_png(self.path("lightsheaf-0001-window.png"))[2] for pixel in row}
        self.assertTrue(any(r > 200 and g < 150 and b < 140 for r, g, b in colors), "the red heading")

    def test_saved_view_is_rendered_and_shown(self):
        self.view("1 key Tab", "5 move 40 40", "6 button 0", "7 move 60 30", "8 button-up 0",
                  "9 key Control", "10 key S", "11 key-up S", "12 key-up Control", "13 settle",
                  "14 key F12", "15 settle", "16 close", words=["-t", "direct", "--exposure", "1.5"])
        self.run_program(COMMAND, "render", "--view", "lightsheaf-0001.view", "-q", "-o", "rendered.png")
        rendered = read_png(self.path("rendered.png"))
        self.assertEqual(read_png(self.path("lightsheaf-0001.png")), rendered)
        self.view("1 key Tab", "2 settle", "3 key F12", "4 settle", "5 close", scene=None,
                  words=["--view", "lightsheaf-0001.view"])
        self.assertEqual(read_png(self.path("lightsheaf-0002.png")), rendered)


if __name__ == "__main__":
    main()

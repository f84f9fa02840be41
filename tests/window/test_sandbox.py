"""The sandbox in a window, under a display without a screen."""
import os
import threading

from display import WindowTest, main, read_png

os.environ.pop("MESA_SHADER_DUMP_PATH", None)  # for tests/shaders: some are wrong on purpose

COMMAND = os.environ["LSF_COMMAND"]
SCENE = os.path.join(os.environ["LSF_SOURCE_ROOT"], "data/scenes/cornell_point.gltf")
SIZE = "96,64"
NO_GL = 4

MOVES = """uniform float gain = 1.0; // @slider 0 2
void mainImage(out vec4 c, in vec2 p)
{
    c = vec4(gain * p / iResolution.xy, fract(iTime), 1.0);
}
"""


class Sandbox(WindowTest):
    def show(self, shader, *lines, words=(), status=0):
        """Without panels, so that the picture fills the window."""
        self.write("my.frag", shader)
        script = self.write("script", "\n".join(["1 key Tab", "2 key-up Tab", *lines]) + "\n")
        return self.run_program(COMMAND, "sandbox", "my.frag", "-r", SIZE, *words, "--replay", script, status=status)

    def shot(self, number=1):
        return read_png(self.path(f"lightsheaf-{number:04}.png"))

    def test_the_picture_is_that_of_the_command(self):
        """Paused at its first frame; and with a slider set otherwise."""
        done = self.show(MOVES, "3 key F6", "4 key-up F6", "5 key F5", "6 key-up F5", "7 settle", "8 key F12",
                         "9 key-up F12", "10 key Tab", "11 key-up Tab", "12 settle", "13 set gain = 0.5", "14 settle",
                         "15 key Tab", "16 key-up Tab", "17 settle", "18 key F12", "19 key-up F12", "22 close")
        self.assertEqual(done.stderr, "")
        for number, gain in ((1, "1"), (2, "0.5")):
            self.run_program(COMMAND, "sandbox", "my.frag", "-q", "-r", SIZE, "-u", "gain=" + gain, "-o", "made.png")
            self.assertEqual(self.shot(number), read_png(self.path("made.png")))

    def test_a_scene_and_its_camera(self):
        turned = ["3 key F6", "4 key-up F6", "5 settle", "6 move 40 40", "7 button 1", "8 move 50 44", "9 button-up 1",
                  "10 settle", "11 key F12", "12 key-up F12", "15 close"]
        self.show("void mainImage(out vec4 c, in vec2 p) { c = vec4(lsf_albedo(p), 1.0); }", *turned, words=[SCENE])
        self.run_program(COMMAND, "sandbox", "my.frag", SCENE, "-q", "-r", SIZE, "-o", "made.png")
        shown, made = self.shot(), read_png(self.path("made.png"))
        self.assertEqual(shown[:2], made[:2])
        self.assertNotEqual(shown[2], made[2], "the camera has turned")

    def test_mouse_and_keys(self):
        """The button is held at (24, 16) from the lower left; A is held, B has been pressed once."""
        shader = """// @channel 0 keyboard
        float key(int code, int row) { return texelFetch(iChannel0, ivec2(code, row), 0).r; }
        void mainImage(out vec4 c, in vec2 p)
        {
            c = vec4(iMouse.xy == vec2(24.0, 16.0) && iMouse.z == 20.0 ? 1.0 : 0.0, key(65, 0), key(66, 2), 1.0);
        }
        """
        self.show(shader, "3 key F6", "4 key-up F6", "5 move 20 40", "6 button 0", "7 move 24 48", "8 key A", "9 key B",
                  "10 key-up B", "11 settle", "12 key F12", "13 key-up F12", "16 close")
        self.assertEqual(self.shot()[2][10][10], (255, 255, 255))

    def test_every_key_and_part_of_its_panel(self):
        steps = ["press Pause", "settle", "press Step", "press Restart", "set gain = 0.5", "set Size = 1/2",
                 "set Exposure = 1", "press Uniforms", "press Picture", "press Passes", "press Keys", "press Play",
                 *(f"{word} {key}" for key in ("F5", "F6", "F7", "F11", "F11", "F12", "Tab", "Tab")
                   for word in ("key", "key-up")), "settle"]
        lines = [f"{3 + k} {step}" for k, step in enumerate(steps)]
        self.show(MOVES, "2 key Tab", "2 key-up Tab", *lines, f"{len(lines) + 4} close",
                  words=["--coverage", "coverage", "-r", "320,400"])
        with open(self.path("coverage"), encoding="utf-8") as file:
            rows = [line.rstrip("\n").split("\t") for line in file]
        self.assertEqual([row for row in rows if row[0] == "unused"], [])
        self.assertGreater(len(rows), 15)

    def test_saving_the_shader(self):
        """A mistake is told, and the last good shader goes on; what comes after it is shown."""
        red = "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0, 0.0, 0.0, 1.0); }"
        self.write("my.frag", red)
        hide, pause = (("key Tab", "key-up Tab"), ("key F6", "key-up F6"))
        program = self.replay_shots(COMMAND, "sandbox", "my.frag", "-r", SIZE, first=[*hide, *pause, "settle"],
                                    shot=["key F12", "key-up F12"])
        told = []
        reader = threading.Thread(target=lambda: told.extend(program.stderr), daemon=True)
        reader.start()

        self.shown(program, "the first shader", lambda rows: rows[5][5] == (255, 0, 0))
        self.write("my.frag", red.replace("1.0, 0.0, 0.0", "wrong"))
        while not told:
            self.assertEqual(self.shown(program, "the mistake")[5][5], (255, 0, 0))
        self.assertIn("my.frag:1: error: `wrong' undeclared", told[0])
        self.assertEqual(self.shown(program, "the last good shader")[5][5], (255, 0, 0))
        self.write("my.frag", red.replace("1.0, 0.0, 0.0", "0.0, 1.0, 0.0"))
        self.shown(program, "what comes after it", lambda rows: rows[5][5] == (0, 255, 0))
        program.terminate()
        program.wait()
        reader.join()
        program.stderr.close()

    def test_mistakes_and_hangs(self):
        done = self.show("void mainImage(out vec4 c, in vec2 p) { c = x; }", "3 key F6", "4 key-up F6", "30 settle",
                         "40 close")
        self.assertIn("my.frag:1: error: `x' undeclared", done.stderr)
        loops = "".join(f"for (int {i} = 0; {i} < 65000 + iFrame; {i}++) " for i in "ijkl")
        done = self.show(f"void mainImage(out vec4 c, in vec2 p) {{ c = vec4(0.0); {loops} c.r = fract(sin(c.r + "
                         "float(i ^ j ^ k ^ l)));}", "3 key F6", "4 key-up F6", "30 settle", "40 close", words=["--watchdog", "0.5"])
        self.assertIn("my.frag: frame 0: no end after 0.5 s", done.stderr)

    def test_without_a_display(self):
        environment = {key: value for key, value in os.environ.items() if key not in ("DISPLAY", "WAYLAND_DISPLAY")}
        self.write("my.frag", MOVES)
        done = self.run_program(COMMAND, "sandbox", "my.frag", environment=environment, status=NO_GL)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1)


if __name__ == "__main__":
    main()

"""`lightsheaf sandbox` and `lightsheaf plan --sandbox` as users run them."""
import os
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(os.environ["LSF_SOURCE_ROOT"]) / "tests/cli"))
from command import FILE, RENDERING, CommandTest, main, png_size

os.environ.pop("MESA_SHADER_DUMP_PATH", None)  # for tests/shaders: some are wrong on purpose

COUNTER = """// @channel 0 previous
void mainImage(out vec4 c, in vec2 p)
{
    c = texelFetch(iChannel0, ivec2(0), 0) + 1.0 / 255.0;
}
"""


class Sandbox(CommandTest):
    def write(self, name, text):
        pathlib.Path(self.path(name)).write_text(text, encoding="utf-8")

    def test_pictures(self):
        self.write("count.frag", COUNTER)
        self.run_command("sandbox", "count.frag", "-o", "one.png", "-r", "16,8", "--frame", "5")
        self.assertEqual(png_size(self.read("one.png")), (16, 8))
        self.run_command("sandbox", "count.frag", "-o", "f_%02d.png", "-r", "16,8", "--frames", "4-6")
        self.assertEqual(self.files(), ["count.frag", "f_04.png", "f_05.png", "f_06.png", "one.png"])
        self.assertEqual(self.pixels("f_05.png"), self.pixels("one.png"))
        self.assertNotEqual(self.pixels("f_05.png"), self.pixels("f_06.png"))
        self.run_command("sandbox", "count.frag", "-o", "one.exr", "-r", "16,8", "--watchdog", "0")
        self.assertIn(b"count.frag", self.read("one.exr"))

    def test_new(self):
        for name in ("my.frag", "my.comp"):
            self.run_command("sandbox", "--new", name)
            self.run_command("sandbox", name, "-o", "my.png", "-r", "16,8", "-v")
            self.refuse("sandbox", "--new", name, status=FILE, says=["there already"])

    def test_plan(self):
        self.scene()
        self.write("seen.frag", "void mainImage(out vec4 c, in vec2 p) { c = vec4(lsf_depth(p)); }")
        self.run_command("plan", "--sandbox", "seen.frag", "scene.gltf", "--json", "plan.json")
        plan = self.read_json("plan.json")
        self.assertEqual([each["name"] for each in plan["passes"]], ["gbuffer", "sandbox"])
        self.assertIn("seen.frag:1: lsf_depth", plan["notes"])
        self.refuse("plan", "--sandbox", "seen.frag", says=["seen.frag:1: lsf_depth needs a scene"])

    def test_prices(self):
        """Of what the shader names; without lights there is no map of one, so that they have no price there."""
        self.scene(emissive=True)
        self.write("seen.frag", "void mainImage(out vec4 c, in vec2 p) { c = vec4(lsf_depth(p)); }")
        self.write("lit.frag", "void mainImage(out vec4 c, in vec2 p) { c = vec4(lsf_visibility(lsf_position(p), "
                                "lsf_normal(p))); }")
        saved = {}
        for name in ("seen", "lit"):
            self.run_command("plan", "--sandbox", name + ".frag", "scene.gltf", "--prices", "--json", "p.json")
            saved[name] = {each["feature"]: each["bytes"] for each in self.read_json("p.json")["prices"]["features"]}
        self.assertEqual((set(saved["seen"]), set(saved["lit"])), ({"emission", "lights"}, {"emission"}))
        self.assertGreater(saved["lit"]["emission"], 0)
        self.refuse("plan", "--sandbox", "seen.frag", "--prices", says=["--prices: needs a scene"])

    def test_mistakes(self):
        self.write("bad.frag", "void mainImage(out vec4 c, in vec2 p)\n{\n    c = vec4(q);\n}\n")
        self.refuse("sandbox", "bad.frag", "-o", "x.png", status=RENDERING,
                    says=["bad.frag:3: ", "`q'", "    c = vec4(q);"])
        self.refuse("sandbox", "none.frag", "-o", "x.png", status=FILE, says=["none.frag"])
        self.refuse("sandbox", "bad.frag", "none.gltf", "-o", "x.png", status=FILE, says=["none.gltf"])
        self.refuse("sandbox", says=["--new"])
        self.assertEqual(self.files(), ["bad.frag"])

    def test_hangs(self):
        """Software OpenGL ends each loop after 65536 turns; four in each other take longer than anybody waits."""
        loops = "".join(f"for (int {i} = 0; {i} < 65000 + iFrame; {i}++) " for i in "ijkl")
        self.write("hang.frag", "void mainImage(out vec4 c, in vec2 p)\n{\n    c = vec4(0.0);\n    " + loops +
                   "c.r = fract(sin(c.r + float(i ^ j ^ k ^ l)));\n}\n")
        self.refuse("sandbox", "hang.frag", "-o", "x.png", "--watchdog", "1", status=RENDERING,
                    says=["hang.frag: frame 0: no end after 1 s"])
        self.assertEqual(self.files(), ["hang.frag"])


if __name__ == "__main__":
    main()

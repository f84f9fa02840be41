"""Each public header compiles alone, without a warning, as C11 and as C++11; so does a program
that fills every parameter struct from its defaults."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(os.environ["LSF_SOURCE_ROOT"])
HEADERS = sorted((ROOT / "include/lightsheaf").glob("*.h"))
STRICT = ["-Wall", "-Wextra", "-Werror", "-pedantic", "-fsyntax-only", "-I", str(ROOT / "include")]
COMPILERS = {"c": [sys.argv.pop(1), "-std=c11", "-x", "c"],
             "c++": [sys.argv.pop(1), "-std=c++11", "-x", "c++"]}

DEFAULTS = """
#include <lightsheaf/lightsheaf.h>
int main(void)
{
    lsf_context_params context = {LSF_CONTEXT_PARAMS_DEFAULTS};
    lsf_scene_params scene = {LSF_SCENE_PARAMS_DEFAULTS};
    lsf_render_params render = {LSF_RENDER_PARAMS_DEFAULTS};
    lsf_image_save_params save = {LSF_IMAGE_SAVE_PARAMS_DEFAULTS};
    lsf_compare_params compare = {LSF_COMPARE_PARAMS_DEFAULTS};
    return context.debug || scene.diffuse_only || render.seed != 0 || save.exposure != 0.0f ||
           compare.exposure != 0.0f;
}
"""


class Headers(unittest.TestCase):
    def compile(self, language, text):
        with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
            file.write(text)
            file.flush()
            done = subprocess.run([*COMPILERS[language], *STRICT, file.name],
                                  capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, f"{language}:\n{text}\n{done.stderr}")

    def test_each_alone(self):
        self.assertTrue(HEADERS)
        for header in HEADERS:
            for language in COMPILERS:
                with self.subTest(header=header.name, language=language):
                    include = f"#include <lightsheaf/{header.name}>\n"
                    self.compile(language, include * 2 + "int main(void) { return 0; }\n")

    def test_defaults(self):
        self.compile("c", DEFAULTS)

    def test_the_umbrella_includes_all(self):
        umbrella = (ROOT / "include/lightsheaf/lightsheaf.h").read_text()
        for header in HEADERS:
            if header.name != "lightsheaf.h":
                self.assertIn(f"#include <lightsheaf/{header.name}>", umbrella)


if __name__ == "__main__":
    unittest.main()

"""What trains the denoiser is well formed, and its scenes keep the rules of glTF. Neither needs torch or numpy."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from validate_gltf import validate

SCRIPTS = pathlib.Path(os.environ["LSF_SOURCE_ROOT"]) / "scripts/denoiser"
sys.path.insert(0, str(SCRIPTS))
import scenes  # noqa: E402

PROGRAMS = ("make_data", "train", "export", "evaluate")


class Scripts(unittest.TestCase):
    def test_each_compiles(self):
        paths = sorted(SCRIPTS.glob("*.py"))
        self.assertGreater(len(paths), len(PROGRAMS))
        for path in paths:
            compile(path.read_text(), path, "exec")

    def test_programs_explain_themselves(self):
        running = [subprocess.Popen([sys.executable, "-B", SCRIPTS / f"{name}.py", "--help"], stdout=subprocess.PIPE,
                                    text=True) for name in PROGRAMS]
        for name, program in zip(PROGRAMS, running):
            text = program.communicate()[0]
            self.assertEqual(program.returncode, 0, name)
            self.assertIn("usage:", text)

    def test_random_scenes_are_valid_and_the_same_again(self):
        with tempfile.TemporaryDirectory() as first, tempfile.TemporaryDirectory() as second:
            for number in (0, 3, 9000):
                path, is_open = scenes.write(first, number)
                self.assertEqual(validate(path), [])
                again, again_open = scenes.write(second, number)
                self.assertEqual(path.read_bytes(), again.read_bytes())
                self.assertEqual(is_open, again_open)


if __name__ == "__main__":
    unittest.main()

"""Every C and C++ file is laid out as .clang-format says, by the version that Debian 12 has."""
import os
import pathlib
import shutil
import subprocess
import sys
import unittest

ROOT = pathlib.Path(os.environ["LSF_SOURCE_ROOT"])
SKIPPED = 77
VERSION = "14."


class Format(unittest.TestCase):
    def test_each_file(self):
        files = sorted(path for folder in ("src", "glsl", "include", "tests")
                       for path in (ROOT / folder).rglob("*")
                       if path.suffix in (".c", ".h", ".cpp", ".hpp"))
        self.assertGreater(len(files), 100)
        done = subprocess.run(["clang-format", "--dry-run", "-Werror", "--ferror-limit=1", *files],
                              cwd=ROOT, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, f"`make format` mends this:\n{done.stderr}")


if __name__ == "__main__":
    if not shutil.which("clang-format"):
        print("skipped: clang-format is not installed")
        sys.exit(SKIPPED)
    version = subprocess.run(["clang-format", "--version"], capture_output=True, text=True).stdout
    if f"version {VERSION}" not in version:
        print(f"skipped: not version {VERSION}x: {version}")
        sys.exit(SKIPPED)
    unittest.main(verbosity=2)

"""The command and the library start at once: none of the libraries that only some files need is
loaded before one does. Prints the times."""
import ctypes
import os
import pathlib
import re
import subprocess
import sys
import time
import unittest

COMMAND, LIBRARY, SANITIZED = sys.argv.pop(1), sys.argv.pop(1), sys.argv.pop(1) == "true"
SCENE = pathlib.Path(os.environ["LSF_SOURCE_ROOT"]) / "data/scenes/cornell_point.gltf"
LATE = re.compile(r"OpenImageIO|draco|meshopt|webp|OpenEXR|opencv|embree|tbb|libEGL|libGL|OSMesa|glfw|LLVM")
SECONDS = 0.05


class Startup(unittest.TestCase):
    def best_of(self, runs, *words):
        seconds = []
        for _ in range(runs):
            start = time.monotonic()
            subprocess.run(words, check=True, stdout=subprocess.DEVNULL, stdin=subprocess.DEVNULL)
            seconds.append(time.monotonic() - start)
        return min(seconds)

    def loaded(self, *words):
        """Every library that the dynamic loader initialised."""
        done = subprocess.run(words, env={**os.environ, "LD_DEBUG": "libs"}, text=True,
                              capture_output=True, stdin=subprocess.DEVNULL, check=True)
        return set(re.findall(r"calling init: (\S+)", done.stderr))

    def test_version(self):
        libraries = self.loaded(COMMAND, "--version")
        self.assertTrue(any("liblightsheaf" in name for name in libraries), libraries)
        self.assertEqual([name for name in libraries if LATE.search(name)], [])
        seconds = self.best_of(20, COMMAND, "--version")
        print(f"lightsheaf --version: {1000 * seconds:.1f} ms, {len(libraries)} libraries")
        if not SANITIZED:
            self.assertLess(seconds, SECONDS)

    def test_a_scene_without_images_needs_none_either(self):
        libraries = self.loaded(COMMAND, "info", str(SCENE))
        self.assertEqual([name for name in libraries if LATE.search(name)], [])

    @unittest.skipIf(SANITIZED, "the sanitizer has to come before the interpreter")
    def test_library(self):
        start = time.monotonic()
        library = ctypes.CDLL(LIBRARY)
        library.lsf_version.restype = ctypes.c_char_p
        version = library.lsf_version()
        seconds = time.monotonic() - start
        maps = pathlib.Path("/proc/self/maps").read_text()
        self.assertEqual(sorted(set(re.findall(r"\S*(?:OpenImageIO|OpenEXR|embree)\S*", maps))), [])
        print(f"library {version.decode()}: loaded in {1000 * seconds:.1f} ms")
        self.assertLess(seconds, SECONDS)


if __name__ == "__main__":
    unittest.main()

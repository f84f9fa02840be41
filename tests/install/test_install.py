"""Installs into an empty folder, looks for every file there, and builds a C and a C++ program
against the installed package alone."""
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

BUILD = os.environ["LSF_BUILD_ROOT"]
SOURCE = pathlib.Path(os.environ["LSF_SOURCE_ROOT"])
COMPILERS = {"program.c": sys.argv.pop(1), "program.cpp": sys.argv.pop(1)}
PREFIX, LIBDIR = sys.argv.pop(1), sys.argv.pop(1)
MODULES = sys.argv.pop(1).split(",")
VERSION = sys.argv.pop(1)


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="lightsheaf-install-")
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        subprocess.run(["meson", "install", "-C", BUILD, "--no-rebuild", "--quiet",
                        "--destdir", cls.folder], check=True, stdout=subprocess.DEVNULL)
        cls.prefix = pathlib.Path(cls.folder + PREFIX)
        cls.environment = {key: value for key, value in os.environ.items()
                           if key != "LIGHTSHEAF_MODULE_DIR"}
        cls.environment.update({
            "LD_LIBRARY_PATH": str(cls.prefix / LIBDIR),
            # No other package's file is there: the library's own has to do.
            "PKG_CONFIG_LIBDIR": str(cls.prefix / LIBDIR / "pkgconfig"),
            "PKG_CONFIG_SYSROOT_DIR": cls.folder,
        })

    def test_files(self):
        wanted = ["bin/lightsheaf", "share/man/man1/lightsheaf.1",
                  "share/bash-completion/completions/lightsheaf",
                  "share/fish/vendor_completions.d/lightsheaf.fish",
                  "share/zsh/site-functions/_lightsheaf",
                  "share/thumbnailers/lightsheaf.thumbnailer",
                  "share/lightsheaf/scenes/interior.gltf", "share/lightsheaf/scenes/interior.bin",
                  f"{LIBDIR}/liblightsheaf.so", f"{LIBDIR}/pkgconfig/lightsheaf.pc"]
        wanted += [f"include/lightsheaf/{header.name}"
                   for header in (SOURCE / "include/lightsheaf").glob("*.h")]
        wanted += [f"{LIBDIR}/lightsheaf/{module}.so" for module in MODULES]
        missing = [name for name in wanted if not (self.prefix / name).is_file()]
        self.assertEqual(missing, [])

    def run_installed(self, *words):
        return subprocess.run(words, env=self.environment, capture_output=True, text=True,
                              stdin=subprocess.DEVNULL, cwd=self.folder, timeout=120)

    def test_programs(self):
        scene = self.prefix / "share/lightsheaf/scenes/cornell_point.gltf"
        for source, compiler in COMPILERS.items():
            with self.subTest(source=source):
                flags = self.run_installed("pkg-config", "--cflags", "--libs", "lightsheaf")
                self.assertEqual(flags.returncode, 0, flags.stderr)
                program = os.path.join(self.folder, source.replace(".", "-"))
                built = self.run_installed(
                    compiler, "-Wall", "-Wextra", "-Werror",
                    str(pathlib.Path(__file__).parent / source), "-o", program,
                    *shlex.split(flags.stdout))
                self.assertEqual(built.returncode, 0, built.stderr)
                done = self.run_installed(program, str(scene))
                self.assertEqual((done.returncode, done.stdout, done.stderr),
                                 (0, f"{VERSION} 34 triangles\n", ""))
                refused = self.run_installed(program, "no-such-file.gltf")
                self.assertEqual(refused.returncode, 3)
                self.assertIn("no-such-file.gltf", refused.stderr)

    def test_a_scene_built_in_code(self):
        flags = shlex.split(self.run_installed("pkg-config", "--cflags", "--libs", "lightsheaf").stdout)
        program, out = os.path.join(self.folder, "build"), os.path.join(self.folder, "built.exr")
        built = self.run_installed(COMPILERS["program.c"], "-Wall", "-Wextra", "-Werror",
                                   str(pathlib.Path(__file__).parent / "build.c"), "-o", program, *flags)
        self.assertEqual(built.returncode, 0, built.stderr)
        done = self.run_installed(program, out)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        described = self.run_installed(str(self.prefix / "bin/lightsheaf"), "info", out)
        self.assertIn("32 x 32", described.stdout)

    def test_a_window_with_a_context_of_its_own(self):
        """In C and in C++, under a display without a screen."""
        if not shutil.which("Xvfb"):
            self.skipTest("Xvfb is not installed")
        read_end, write_end = os.pipe()
        display = subprocess.Popen(["Xvfb", "-displayfd", str(write_end), "-screen", "0", "320x240x24"],
                                   pass_fds=[write_end], stderr=subprocess.DEVNULL)
        os.close(write_end)
        self.addCleanup(display.wait)
        self.addCleanup(display.terminate)
        with os.fdopen(read_end) as file:
            environment = {**self.environment, "DISPLAY": ":" + file.readline().strip()}
        flags = shlex.split(self.run_installed("pkg-config", "--cflags", "--libs", "lightsheaf").stdout)
        source = pathlib.Path(__file__).parent / "window.c"
        self.assertLessEqual(len(source.read_text().splitlines()), 80)
        for words in (["-x", "c"], ["-x", "c++"]):
            with self.subTest(words=words):
                program = os.path.join(self.folder, "window")
                compiler = COMPILERS["program.c" if words[1] == "c" else "program.cpp"]
                built = self.run_installed(compiler, "-Wall", "-Wextra", "-Werror", *words, str(source),
                                           "-o", program, *flags, "-lglfw", "-lm")
                self.assertEqual(built.returncode, 0, built.stderr)
                scene = self.prefix / "share/lightsheaf/scenes/cornell_point.gltf"
                done = subprocess.run([program, str(scene)], env=environment, capture_output=True,
                                      text=True, cwd=self.folder, timeout=120)
                if done.returncode == 77:
                    self.skipTest("Xvfb gives no OpenGL 4.5")
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                sums = [int(line) for line in done.stdout.split()]
                self.assertEqual(len(set(sums)), 4, "each frame shows another picture")
                # Brighter than black in every channel but alpha, which is 255.
                self.assertGreater(min(sums), 96 * 72 * (255 + 30))

    def test_only_the_public_api_is_exported(self):
        names = self.run_installed("nm", "-D", "--defined-only", "--format=posix",
                                   str(self.prefix / LIBDIR / "liblightsheaf.so")).stdout
        exported = {line.split()[0] for line in names.splitlines()}
        declared = set()
        for header in (SOURCE / "include/lightsheaf").glob("*.h"):
            declared |= set(re.findall(r"\b(lsf_\w+)\(", header.read_text()))
        ours = {name for name in exported if name.startswith("lsf_")}
        self.assertEqual(ours - declared, set(), "exported, not declared in a public header")
        self.assertEqual(declared - ours, set(), "declared in a public header, not exported")
        self.assertEqual(exported - ours, set(), "neither the library's nor declared")

    def test_the_soname_is_that_of_the_abi(self):
        """Below 1.0 each minor version has one of its own."""
        dynamic = self.run_installed("readelf", "-d",
                                     str(self.prefix / LIBDIR / "liblightsheaf.so")).stdout
        major, minor, _ = VERSION.split(".")
        self.assertIn(f"[liblightsheaf.so.{major}.{minor}]", dynamic)

    def test_the_command_renders_without_its_source_tree(self):
        out = os.path.join(self.folder, "out.png")
        done = self.run_installed(str(self.prefix / "bin/lightsheaf"), "render",
                                  str(self.prefix / "share/lightsheaf/scenes/cornell_point.gltf"),
                                  "-o", out, "--resolution", "32,32", "--samples", "1")
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(out, "rb") as file:
            self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")


if __name__ == "__main__":
    unittest.main()

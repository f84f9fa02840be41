"""Reads #include lines and objects' symbols: every layer may use those to its left, never one to its
right.

src/ARCHITECTURE.md says why; ALLOWED below is the whole rule.
"""
import os
import pathlib
import re
import subprocess
import unittest

ROOT = pathlib.Path(os.environ["LSF_SOURCE_ROOT"])

# Layer -> layers it may use besides itself and shared/ (what C and GLSL have in common).
ALLOWED = {
    "base": {"base"},
    "math": {"base"},
    "gl": {"base", "math"},
    "scene": {"base", "math"},
    "io": {"base", "math", "scene"},
    "plan": {"base", "math", "gl", "scene"},
    "frame": {"base", "math", "gl", "scene", "plan"},
    "denoiser": {"base", "math"},
    "passes": {"base", "math", "gl", "scene", "plan", "frame", "denoiser"},
    "techniques": {"base", "math", "gl", "scene", "plan", "frame", "denoiser", "passes"},
    "sandbox": {"base", "math", "gl", "scene", "io", "plan", "frame", "passes", "techniques"},
    "reference": {"base", "math", "scene"},
    "measure": {"base", "io"},
    "bench": {"base", "math", "gl", "scene", "plan", "frame", "passes", "techniques", "reference"},
    "window": {"base"},
    "view": {"base", "window"},
    "easel": {"base", "window", "view"},
    "sweep": {"base"},
    "report": {"base"},
    "tools": {"base", "math", "gl", "scene", "io", "plan", "frame", "passes", "techniques", "measure", "sweep",
              "report", "sandbox", "view", "easel"},
}
# Headers that a layer offers to one that may not see the rest of it.
EXCEPTIONS = {
    ("measure", "io"): {"io/io.h", "io/image.h"},
    ("tools", "gl"): {"gl/gl.h"},
    ("tools", "view"): {"view/view.h"},
    ("tools", "easel"): {"easel/easel.h"},
}
# Layers whose functions another one calls by public headers alone.
PUBLIC = {
    "window": {"gl", "io"},
    "view": {"gl", "io", "measure", "plan", "reference", "scene", "techniques"},
    "easel": {"gl", "io", "sandbox", "scene", "techniques"},
    "report": {"io"},
    "sweep": {"gl", "io", "measure", "plan", "reference", "techniques"},
    "tools": {"bench", "reference"},
}
SOURCES = (".c", ".h", ".cpp", ".hpp")
LONGEST = 600  # lines: a file is one idea
# Work left for later, and paths of one machine; split so that this line is not found itself.
FORBIDDEN = re.compile(r"\b(TO" r"DO|FIX" r"ME|XX" r"X)\b|(?<![\w.$)}])/(ho" r"me|ro" r"ot|wo" r"rk)/")
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)
ANY_INCLUDE = re.compile(r'^\s*#\s*include\s+[<"]([^>"]+)[>"]', re.MULTILINE)


def files(*folders, endings=SOURCES):
    return sorted(path for folder in folders for path in (ROOT / folder).rglob("*")
                  if path.is_file() and path.suffix in endings)


def pass_of(name):
    """The pass a file belongs to: its page's stem, alone or before _part."""
    stem = name.split(".")[0]
    pages = [path.stem for path in (ROOT / "src/passes").glob("*.md")]
    return max((page for page in pages if stem == page or stem.startswith(page + "_")), key=len,
               default=stem)


class Layers(unittest.TestCase):
    def test_every_folder_is_a_layer(self):
        folders = {path.name for path in (ROOT / "src").iterdir() if path.is_dir()}
        self.assertEqual(folders, set(ALLOWED))

    def test_includes_follow_the_layers(self):
        wrong = []
        for path in files("src"):
            layer = path.relative_to(ROOT / "src").parts[0]
            for name in INCLUDE.findall(path.read_text()):
                target = name.split("/")[0]
                if target in (layer, "shared", "glad"):
                    continue
                allowed = target in ALLOWED[layer]
                only = EXCEPTIONS.get((layer, target))
                if not allowed or (only and name not in only):
                    wrong.append(f"{path.relative_to(ROOT)} includes {name}")
        self.assertEqual(wrong, [])

    def test_includes_name_their_layer(self):
        bare = [f"{path.relative_to(ROOT)} includes {name}" for path in files("src")
                for name in INCLUDE.findall(path.read_text()) if "/" not in name]
        self.assertEqual(bare, [])

    def test_passes_do_not_know_each_other(self):
        wrong = []
        for path in files("src/passes") + files("glsl/passes", endings=(".glsl",)):
            for name in INCLUDE.findall(path.read_text()):
                if name.startswith("passes/") and pass_of(name.split("/")[1]) != pass_of(path.name):
                    wrong.append(f"{path.relative_to(ROOT)} includes {name}")
        self.assertEqual(wrong, [])

    def test_shader_parts_stand_alone(self):
        wrong = []
        for folder, allowed in (("glsl/shared", {"shared"}), ("glsl/lib", {"shared", "lib"}),
                                ("glsl/passes", {"shared", "lib", "passes"}),
                                ("glsl/sandbox", {"shared", "lib", "sandbox"})):
            for path in files(folder, endings=(".glsl", ".h")):
                wrong += [f"{path.relative_to(ROOT)} includes {name}"
                          for name in INCLUDE.findall(path.read_text())
                          if name.split("/")[0] not in allowed]
        self.assertEqual(wrong, [])

    def test_textures_are_bound_with_their_samplers(self):
        """A unit keeps its sampler, whatever texture is bound next."""
        allowed = {"src/gl/draw.c", "src/gl/state.c", "src/frame/scene_gpu.c"}
        calls = re.compile(r"\bglBind(TextureUnit|Textures?|Samplers?)\(")
        for path in files("src", endings=(".c",)):
            name = str(path.relative_to(ROOT))
            if name not in allowed and "/glad/" not in name:
                self.assertIsNone(calls.search(path.read_text()), f"{name}: use lsf_bind_texture")

    def test_the_plan_is_made_without_gl(self):
        calls = re.compile(r"\bgl[A-Z]\w*\(")
        for path in files("src/plan"):
            self.assertIsNone(calls.search(path.read_text()), path)

    def test_public_headers_include_public_headers_only(self):
        wrong = []
        for path in files("include"):
            for name in ANY_INCLUDE.findall(path.read_text()):
                if not name.startswith("lightsheaf/") and name not in (
                        "stdbool.h", "stddef.h", "stdint.h"):
                    wrong.append(f"{path.relative_to(ROOT)} includes {name}")
        self.assertEqual(wrong, [])

    def test_embree_and_openimageio_stay_in_their_modules(self):
        for path in files("src"):
            for name in ANY_INCLUDE.findall(path.read_text()):
                if name.startswith("embree3/"):
                    self.assertEqual(path.parent.name, "reference", path)
                if name.startswith("OpenImageIO/"):
                    self.assertEqual(path.name, "openimageio.cpp", path)


class Symbols(unittest.TestCase):
    """What public headers declare, #include lines do not tell apart."""

    def layer_of(self, path):
        """Meson names an object by the way to its source: io_image_load.c.o, src_tools_main.c.o."""
        match = re.match(r"(?:src_|\.\._)?([a-z]+)_", path.name)
        return match[1] if match and match[1] in ALLOWED else path.parent.parent.name

    def objects(self):
        """Layer and symbols of each object: those that it defines, and those that it lacks."""
        build = pathlib.Path(os.environ["LSF_BUILD_ROOT"])
        found = {path: (self.layer_of(path), path.name, set(), set())
                 for pattern in ("src/**/*.o", "lightsheaf.p/*.o") for path in build.glob(pattern)
                 if self.layer_of(path) in ALLOWED}
        symbols = subprocess.run(["nm", "--print-file-name", "--format=posix", *found],
                                 capture_output=True, text=True, check=True).stdout
        for line in symbols.splitlines():
            path, name, kind = re.match(r"(.*): (\S+) (\w)", line).groups()
            if kind in "TDBRU":
                found[pathlib.Path(path)][3 if kind == "U" else 2].add(name)
        return list(found.values())

    def test_calls_follow_the_layers(self):
        objects = self.objects()
        home = {name: layer for layer, _, defined, _ in objects for name in defined}
        self.assertEqual({layer for layer, *_ in objects}, set(ALLOWED))
        self.assertGreater(len(home), 500)
        wrong = [f"{path} ({layer}) uses {name} of {home[name]}"
                 for layer, path, _, lacking in objects for name in sorted(lacking)
                 if name in home and home[name] != layer
                 and home[name] not in ALLOWED[layer] | PUBLIC.get(layer, set())]
        self.assertEqual(wrong, [])


class Files(unittest.TestCase):
    def test_no_file_is_longer_than_one_idea(self):
        long = [f"{path.relative_to(ROOT)}: {count} lines"
                for path in files("src", "include", "glsl", "tests", "data", "scripts",
                                  endings=SOURCES + (".glsl", ".py"))
                for count in [len(path.read_text().splitlines())] if count > LONGEST]
        self.assertEqual(long, [])

    def test_nothing_is_left_for_later_or_bound_to_one_machine(self):
        found = []
        for path in files("src", "include", "glsl", "tests", "data", "docs", "scripts",
                          endings=SOURCES + (".glsl", ".py", ".md", ".build")):
            for number, line in enumerate(path.read_text().splitlines(), 1):
                if FORBIDDEN.search(line):
                    found.append(f"{path.relative_to(ROOT)}:{number}: {line.strip()}")
        self.assertEqual(found, [])

    def test_every_pass_has_all_its_files(self):
        """One stem a pass: host code, header, page; its shaders begin with the stem."""
        stems = {pass_of(path.name) for path in files("src/passes", endings=(".c",))}
        for stem in stems:
            for ending in (".h", ".md"):
                self.assertTrue((ROOT / "src/passes" / (stem + ending)).is_file(), stem + ending)
        for shader in files("glsl/passes", endings=(".glsl",)):
            self.assertIn(pass_of(shader.name), stems, f"{shader.name} belongs to no pass")


if __name__ == "__main__":
    unittest.main()

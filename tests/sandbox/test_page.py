"""docs/sandbox.md against the command's own names, and the shaders that it shows."""
import os
import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(os.environ["LSF_SOURCE_ROOT"])
sys.path.insert(0, str(ROOT / "tests/cli"))
from command import CommandTest

SCENE = str(ROOT / "data/scenes/cornell_point.gltf")
PAGE = ROOT / "docs/sandbox.md"
BEGIN, END = "<!-- names: begin -->\n", "<!-- names: end -->"
TITLES = {"uniforms": "Uniforms", "engines": "Of the engine", "olders": "Older names", "annotations": "In comments", "sources": "Sources of channels"}


class Page(CommandTest):
    def tables(self):
        page = ""
        for line in self.run_command("sandbox", "--list-names").stdout.decode().splitlines():
            if line in TITLES:
                page += f"\n### {TITLES[line]}\n\n| | |\n| --- | --- |"
            elif line.startswith("      "):
                page += " " + line.strip().replace("|", "\\|")
            elif line.startswith("  "):
                page += f"{' |' if page[-3:] != '--|' and page[-5:] != '--- |' else ''}\n| `{line.strip()}` |"
            else:
                page += " |\n"
        return page + " |\n\n"

    def test_names(self):
        """LSF_UPDATE=1 in the environment brings docs/sandbox.md up to date instead."""
        text = PAGE.read_text(encoding="utf-8")
        before, rest = text.split(BEGIN)
        names, after = rest.split(END)
        if os.environ.get("LSF_UPDATE"):
            PAGE.write_text(before + BEGIN + self.tables() + END + after, encoding="utf-8")
        else:
            self.assertEqual(names, self.tables())

    def test_tutorial(self):
        """Each step of the page runs."""
        steps = re.findall(r"```glsl\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
        self.assertEqual(len(steps), 3)
        for i, step in enumerate(steps):
            pathlib.Path(self.path("step.frag")).write_text(step, encoding="utf-8")
            self.run_command("sandbox", "step.frag", SCENE, "-o", f"{i}.png", "-r", "32,32", "-D",
                             "voxel.resolution=32")
        self.assertEqual(len({self.pixels(f"{i}.png") for i in range(3)}), 3)

    def test_examples(self):
        """Each has its row; test_shadertoy.c runs them."""
        rows = re.findall(r"^\| `(\w+\.frag)` \|", PAGE.read_text(encoding="utf-8"), re.MULTILINE)
        self.assertEqual(sorted(rows), sorted(path.name for path in (ROOT / "data/sandbox").glob("*.frag")))


if __name__ == "__main__":
    unittest.main(verbosity=2)

#!/usr/bin/env python3
"""Writes the default scenes beside this file, or into the folder given; the same bytes each time.

usage: data/scenes/generate.py [FOLDER]
"""
import pathlib
import sys

from cornell import cornell
from interior import interior


def main(folder):
    folder.mkdir(parents=True, exist_ok=True)
    for name, gltf in (
            ("cornell_point", cornell(folder, "cornell_point")),
            ("cornell_emissive", cornell(folder, "cornell_emissive", light="lamp")),
            ("cornell_glass", cornell(folder, "cornell_glass", light="ceiling",
                                      content="glass")),
            ("cornell_glossy", cornell(folder, "cornell_glossy", content="glossy")),
            ("interior", interior(folder))):
        print(f"{name}.gltf: {gltf.triangles()} triangles")


if __name__ == "__main__":
    here = pathlib.Path(__file__).resolve().parent
    main(pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else here)

#!/usr/bin/env python3
"""Generates the OpenGL loader with glad and lays its files out flat, as meson's outputs must lie.

usage: generate_glad.py GLAD OUTPUT_FOLDER

Without extensions: the core of 4.5 has all functions that are called, and the search for extensions that glad
2.0.2 generates reads through a null pointer where memory is short.
"""
import pathlib
import subprocess
import sys
import tempfile


def main():
    glad, output = sys.argv[1], pathlib.Path(sys.argv[2])
    with tempfile.TemporaryDirectory() as folder:
        result = subprocess.run(
            [glad, "--api", "gl:core=4.5", "--extensions", "", "--reproducible",
             "--out-path", folder, "c"],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if result.returncode != 0:
            sys.exit(f"glad failed; install Debian's python3-glad\n{result.stdout}")
        folder = pathlib.Path(folder)
        header = (folder / "include/glad/gl.h").read_text()
        platform = (folder / "include/KHR/khrplatform.h").read_text()
        source = (folder / "src/gl.c").read_text()
    (output / "gl.h").write_text(header.replace("<KHR/khrplatform.h>", "<glad/khrplatform.h>"))
    (output / "khrplatform.h").write_text(platform)
    (output / "gl.c").write_text(source)


main()

#!/usr/bin/env python3
"""Generates the OpenGL loader with glad and lays its files out flat, as meson's outputs must lie.

Functions belong to a context: glad's table of them (GladGLContext) is filled for each, and glViewport stands
for a member of the one that is current on the thread (glad_current).

usage: generate_glad.py GLAD OUTPUT_FOLDER

Without extensions: the core of 4.5 has all functions that are called, and the search for extensions that glad
2.0.2 generates reads through a null pointer where memory is short.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

CURRENT = """
/* The functions of the context that is current on this thread. */
extern _Thread_local GladGLContext *glad_current;
"""


def name_functions(header):
    """The header with glViewport for the current context's Viewport, and so on."""
    names = re.findall(r"^ +PFNGL\w+PROC (\w+);$", header, re.MULTILINE)
    macros = "".join(f"#define gl{name} (glad_current->{name})\n" for name in names)
    end = header.rindex("#ifdef __cplusplus")
    return header[:end] + CURRENT + macros + "\n" + header[end:]


def main():
    glad, output = sys.argv[1], pathlib.Path(sys.argv[2])
    with tempfile.TemporaryDirectory() as folder:
        result = subprocess.run(
            [glad, "--api", "gl:core=4.5", "--extensions", "", "--reproducible",
             "--out-path", folder, "c", "--mx"],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if result.returncode != 0:
            sys.exit(f"glad failed; install Debian's python3-glad\n{result.stdout}")
        folder = pathlib.Path(folder)
        header = (folder / "include/glad/gl.h").read_text()
        platform = (folder / "include/KHR/khrplatform.h").read_text()
        source = (folder / "src/gl.c").read_text()
    header = header.replace("<KHR/khrplatform.h>", "<glad/khrplatform.h>")
    (output / "gl.h").write_text(name_functions(header))
    (output / "khrplatform.h").write_text(platform)
    (output / "gl.c").write_text(source + "\n_Thread_local GladGLContext *glad_current;\n")


main()

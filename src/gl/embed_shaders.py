#!/usr/bin/env python3
"""Embeds every .glsl and .h file below a folder into a C file, and writes a depfile.

The depfile names the folders too: their times change when a file is added or removed.

usage: embed_shaders.py GLSL_FOLDER OUTPUT_C DEPFILE
"""
import os
import pathlib
import sys


def main():
    root, output, depfile = pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3]
    folders, files = [], []
    for folder, names, entries in os.walk(root):
        names.sort()
        folders.append(folder)
        files += [pathlib.Path(folder) / entry for entry in sorted(entries)
                  if entry.endswith((".glsl", ".h"))]

    text = ['#include "gl/context.h"\n']
    table = []
    for i, path in enumerate(files):
        content = path.read_bytes()
        if b"\0" in content:
            sys.exit(f"{path}: holds a zero byte, so it is no shader text")
        rows = [",".join(map(str, content[at:at + 32])) for at in range(0, len(content), 32)]
        text.append(f"static const unsigned char file_{i}[] = {{\n" + ",\n".join(rows + ["0"]) + "};\n")
        table.append(f'    {{"{path.relative_to(root).as_posix()}", file_{i}, {len(content)}}},\n')
    text.append("const lsf_embedded_file lsf_embedded_files[] = {\n" + "".join(table) +
                "    {0},\n};\n")

    pathlib.Path(output).write_text("".join(text))
    inputs = " ".join(str(name).replace(" ", "\\ ") for name in folders + files)
    pathlib.Path(depfile).write_text(f"{output}: {inputs}\n")


main()

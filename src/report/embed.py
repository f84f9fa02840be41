"""Makes C of the report's page: embed.py PAGE OUTPUT DEPFILE.

@@NAME@@ in the page stands for the file of that name beside it. What stands before @@data@@ and what
follows it become two strings.
"""
import pathlib
import re
import sys


def main():
    page, output, depfile = (pathlib.Path(word) for word in sys.argv[1:])
    used = [page]

    def insert(found):
        if found[1] == "data":
            return found[0]
        used.append(page.parent / found[1])
        return used[-1].read_text(encoding="utf-8").rstrip("\n")

    text = re.sub(r"@@([\w./]+)@@", insert, page.read_text(encoding="utf-8"))
    head, tail = text.split("@@data@@")
    with open(output, "w", encoding="ascii") as out:
        out.write('/* Made by embed.py. */\n#include "report/page.h"\n')
        for name, part in (("head", head), ("tail", tail)):
            data = part.encode("utf-8")
            lines = ("".join(f"{byte}," for byte in data[at:at + 32]) for at in range(0, len(data), 32))
            out.write(f"const unsigned char lsf_report_{name}[] = {{\n" + "\n".join(lines) + "\n};\n")
            out.write(f"const size_t lsf_report_{name}_length = sizeof lsf_report_{name};\n")
    depfile.write_text(f"{output}: {' '.join(map(str, used))}\n", encoding="utf-8")


main()

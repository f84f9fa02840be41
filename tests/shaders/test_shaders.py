"""Khronos' reference compiler accepts every shader that other tests have compiled since shaders or tests changed.
Mesa writes their sources (MESA_SHADER_DUMP_PATH), each once, named by its stage and a hash."""
import os
import pathlib
import shutil
import subprocess
import sys

SKIPPED = 77
COMPILER = "glslangValidator"
STAGES = {"VS": "vert", "TCS": "tesc", "TES": "tese", "GS": "geom", "FS": "frag", "CS": "comp"}


def skip(why):
    print(why)
    sys.exit(SKIPPED)


def drop_outdated(folder, root):
    changed = max(path.stat().st_mtime for part in ("glsl", "tests") for path in (root / part).rglob("*.*")
                  if path.suffix in (".c", ".h", ".glsl"))
    for path in folder.glob("*.glsl"):
        if path.stat().st_mtime < changed:
            path.unlink()


def refused(folder, prefix, stage):
    """Number of shaders of a stage, and what the compiler has against them."""
    names = sorted(path.name for path in folder.glob(prefix + "_*.glsl"))
    if not names:
        return 0, []
    done = subprocess.run([COMPILER, "-S", stage, *names], cwd=folder, capture_output=True, text=True, check=False)
    complaints, name = [], ""
    for line in done.stdout.splitlines():
        if line in names: # what follows is about this one
            name = line
        elif line:
            complaints.append(f"{folder / name}: {line}")
    if done.returncode and not complaints:
        complaints = [f"{COMPILER} ended with status {done.returncode}: {done.stderr}"]
    return len(names), complaints


def main():
    folder = pathlib.Path(os.environ["MESA_SHADER_DUMP_PATH"])
    drop_outdated(folder, pathlib.Path(os.environ["LSF_SOURCE_ROOT"]))
    if not shutil.which(COMPILER):
        skip(f"{COMPILER} is not installed (Debian: glslang-tools)")
    total, complaints = 0, []
    for prefix, stage in STAGES.items():
        count, lines = refused(folder, prefix, stage)
        total += count
        complaints += lines
    if not total:
        skip(f"{folder} holds no shaders: run the tests of the suites gl and cli before, on Mesa")
    print(f"{COMPILER} has read {total} shaders")
    print("\n".join(complaints))
    sys.exit(1 if complaints else 0)


main()

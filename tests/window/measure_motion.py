#!/usr/bin/env python3
"""Measures the moving picture of `lightsheaf view`: frames a second, and how far it is from the path tracer.

    tests/window/measure_motion.py --work out           # the table of docs/window.md; goes on where it stopped
    tests/window/measure_motion.py --work out --scenes cornell --techniques direct --sizes 640x360

A drag that goes to and fro is replayed under Xvfb, as many pixels a frame however long a frame takes, and the picture
is kept in some of its frames as it is shown: enlarged to the window, as radiance. The path tracer renders the views
that are saved with them. A scene of one's own is NAME=FILE, with options of `lightsheaf view` behind the file.
"""
import argparse
import csv
import hashlib
import json
import math
import os
import pathlib
import shlex
import shutil
import statistics
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from display import Display  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENES = {"cornell": f"{ROOT}/data/scenes/cornell_point.gltf",
          "interior": f"{ROOT}/data/scenes/interior.gltf -e 0.9,1.1,1.4"}
if "LSF_SHARED" in os.environ:
    SCENES["atrium"] = f"{os.environ['LSF_SHARED']}/scenes/atrium/atrium_sun.gltf"
PERIOD = 120  # frames, to and fro
SWING = 1 / 12  # of the picture's height, to either side: 15 degrees of the camera's way around
STEADY = 100  # last frames, of which the rate is
SNAPSHOTS = (0.55, 0.8)  # of all frames


def drag(size, frames):
    """Lines of a replay, and the names of its snapshots."""
    width, height = size
    lines, names = ["1 key Tab", "2 key-up Tab", "2 settle", f"3 move {width / 2} {height / 2}", "4 button 0"], []
    for k in range(frames):
        swing = SWING * height * math.sin(2 * math.pi * k / PERIOD)
        lines.append(f"{5 + k} move {width / 2 + swing:.3f} {height / 2 + 0.25 * swing:.3f}")
        if k in [int(part * frames) for part in SNAPSHOTS]:
            names.append(f"frame-{k}")
            lines.append(f"{5 + k} snapshot {names[-1]}")
    return lines + [f"{6 + frames} button-up 0", f"{7 + frames} close"], names


def run(words, folder, environment=None):
    done = subprocess.run(words, cwd=folder, env=environment, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{shlex.join(words)}\n{done.stderr}")
    return done.stdout


def show(options, folder, scene, technique, size, names, script):
    """Replays the drag; the rows of --frame-times while the picture moves."""
    display = Display(f"{max(size[0], 640)}x{max(size[1], 480)}")
    environment = {key: value for key, value in os.environ.items() if key != "WAYLAND_DISPLAY"}
    environment.update(DISPLAY=display.name)
    try:
        run([options.lightsheaf, "view", *scene, "-t", technique, "-r", f"{size[0]},{size[1]}", "-s", "1", "--budget",
             str(options.budget), "--replay", script, "--frame-times", "times.csv"], folder, environment)
    finally:
        display.close()
    with open(folder / "times.csv", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["picture"] == "moving"]
    missing = [name for name in names if not (folder / f"{name}.exr").exists()]
    if missing:
        sys.exit(f"{folder}: no {missing[0]}.exr")
    return rows


def reference(options, cache, view, bounces):
    """The path tracer's picture of a view, which techniques and budgets share."""
    kept = [line for line in view.read_text(encoding="utf-8").splitlines()
            if line and not line.startswith(("#", "technique=", "samples=", "define=", "bounces="))]
    key = hashlib.sha256("\n".join([*kept, *bounces, str(options.reference_samples)]).encode()).hexdigest()[:16]
    picture = cache / f"{key}.exr"
    if not picture.exists():
        aside = cache / f"{key}.part.exr"
        run([options.lightsheaf, "reference", "--view", str(view), *bounces, "-s", str(options.reference_samples), "-q",
             "-o", str(aside)], cache)
        os.replace(aside, picture)
    return picture


def settled_after(rows):
    """Seconds until the frame budget let the picture's size and maps be for good."""
    last, sum_of_all, after = None, 0.0, 0.0
    for row in rows:
        kind = row["width"], row["coarse"]
        if last not in (None, kind):
            after = sum_of_all
        last = kind
        sum_of_all += float(row["seconds"])
    return after


def measure(options, name, technique, size):
    settings = f"{options.budget:g}-{options.frames}-{options.reference_samples}"
    folder = options.work / f"{name}-{technique}-{size[0]}x{size[1]}-{settings}"
    kept = folder / "result.json"
    if kept.exists():
        return json.loads(kept.read_text())
    folder.mkdir(parents=True, exist_ok=True)
    scene = shlex.split(options.all_scenes[name])
    lines, names = drag(size, options.frames)
    if options.interaction:
        lines = pathlib.Path(options.interaction).read_text(encoding="utf-8").splitlines()
        names = [line.split(" ", 2)[2] for line in lines if line.split(" ")[1:2] == ["snapshot"]]
    (folder / "script").write_text("\n".join(lines) + "\n", encoding="utf-8")
    rows = show(options, folder, scene, technique, size, names, "script")
    last = [float(row["seconds"]) for row in rows[-STEADY:]]
    bounces = ["-b", "0"] if technique == "direct" else []
    errors = []
    for snapshot in names:
        wanted = reference(options, options.work, folder / f"{snapshot}.view", bounces)
        errors.append(json.loads(run([options.lightsheaf, "compare", f"{snapshot}.exr", str(wanted), "--json", "-"],
                                     folder)))
    result = {"frames_per_second": len(last) / sum(last),
              "slowest_of_20": statistics.quantiles(last, n=20)[-1] if len(last) > 1 else last[0],
              "settled_after": settled_after(rows), "frames": len(rows),
              "picture": [int(rows[-1]["width"]), int(rows[-1]["height"])], "coarse": int(rows[-1]["coarse"]),
              "relmse": statistics.mean(error["relmse"] for error in errors) if errors else None,
              "ssim": statistics.mean(error["ssim"] for error in errors) if errors else None}
    kept.write_text(json.dumps(result, indent=1))
    return result


def print_table(options, results):
    print("| scene, technique | window | frames/s | 95 % within | at rest after | picture | coarser | relMSE | SSIM |")
    print("| --- " * 9 + "|")
    for (name, technique, size), r in results.items():
        error = (f"{r['relmse']:.3g} | {r['ssim']:.3f}" if r["relmse"] is not None else " | ")
        print(f"| `{name}`, `{technique}` | {size[0]}×{size[1]} | {r['frames_per_second']:.1f} "
              f"| {1e3 * r['slowest_of_20']:.0f} ms | {r['settled_after']:.1f} s "
              f"| {r['picture'][0]}×{r['picture'][1]} | {r['coarse']} | {error} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--work", required=True, type=pathlib.Path, help="folder for pictures and results")
    parser.add_argument("--lightsheaf", default=f"{ROOT}/build/lightsheaf")
    parser.add_argument("--scenes", default=",".join(SCENES), help="names, separated by commas")
    parser.add_argument("--add", action="append", default=[], metavar="NAME=FILE OPTIONS", help="another scene; repeatable")
    parser.add_argument("--techniques", help="names, separated by commas; all without it")
    parser.add_argument("--sizes", default="640x360,1280x720")
    parser.add_argument("--budget", default=100.0, type=float, help="milliseconds of a frame")
    parser.add_argument("--frames", default=240, type=int, help="of the drag")
    parser.add_argument("--interaction", help="a file of `lightsheaf view --record`, with snapshots, in place of the drag")
    parser.add_argument("--reference-samples", default=64, type=int)
    options = parser.parse_args()
    options.work = options.work.resolve()
    options.lightsheaf = shutil.which(options.lightsheaf) or options.lightsheaf
    added = dict(item.split("=", 1) for item in options.add)
    options.all_scenes = {**SCENES, **added}
    build = pathlib.Path(options.lightsheaf).resolve().parent
    os.environ.setdefault("LIGHTSHEAF_MODULE_DIR",
                          ":".join(f"{build}/src{part}" for part in ("", "/io", "/reference", "/window")))
    if not options.techniques:
        listed = run([options.lightsheaf, "render", "--list-techniques"], ".").splitlines()
        options.techniques = ",".join(line.split()[0] for line in listed)
    results = {}
    for name in [*options.scenes.split(","), *added]:
        for technique in options.techniques.split(","):
            for size in (tuple(int(side) for side in text.split("x")) for text in options.sizes.split(",")):
                results[name, technique, size] = measure(options, name, technique, size)
                print(f"{name} {technique} {size[0]}x{size[1]}", file=sys.stderr, flush=True)
    print_table(options, results)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Measures each technique against the path tracer on a folder of glTF models under an environment.

    tests/models/measure.py MODELS --environment studio.hdr --work out   # takes hours; goes on where it stopped
    tests/models/measure.py MODELS --work out --table                    # the table of docs/models.md

MODELS holds a folder for each model, as Khronos' sample assets do; the first of its files that loads is taken.
docs/models.md says what is measured and how.
"""

import argparse
import json
import os
import pathlib
import subprocess
import sys

# Iterations, seconds a run, directions of the environment an iteration, and the bound of the bias.
TECHNIQUES = {
    "direct": (64, 5, 8, 0.02),
    "bidirectional": (32, 7, 8, 0.02),
    "voxel_path": (8, 8, 16, 0.05),
    "cone": (6, 9, 16, 0.05),
    "substitute_tree": (16, 9, 8, 0.05),
}
REFERENCE_SAMPLES = 64
REFERENCE_SECONDS = 8
SEEDS = 3
# A picture of four times the pixels has shadow maps and levels of textures as these.
FINE = ["-D", "shadow.texels_per_pixel=64", "-D", "gbuffer.texture_lod_bias=-16"]


class Failure(Exception):
    pass


def run(options, arguments, seconds=300):
    try:
        done = subprocess.run(
            [options.lightsheaf, *arguments], capture_output=True, text=True, timeout=seconds
        )
    except subprocess.TimeoutExpired:
        raise Failure(f"{arguments[0]}: nothing after {seconds} s")
    if done.returncode != 0:
        raise Failure(f"status {done.returncode}: {done.stderr.strip()}")
    return done.stdout


def choose(options, folder):
    """The first file of a model that loads; .glb before .gltf."""
    files = sorted(folder.glob("*/*.glb")) + sorted(folder.glob("*/*.gltf"))
    why = "no .glb or .gltf file"
    for path in files:
        try:
            run(options, ["info", str(path), "--lenient", "-q"])
            return str(path)
        except Failure as failure:
            why = str(failure)
    raise Failure(why)


def picture(options, command, path, name, arguments):
    """Writes name.exr; what the command says of it."""
    log = f"{name}.json"
    run(
        options,
        [command, path, "-q", "--lenient", "-o", f"{name}.exr", "--json", log]
        + ["-e", options.environment, "--background", "0,0,0"]
        + ["-r", f"{options.size},{options.size}"] + arguments,
    )
    return json.loads(pathlib.Path(log).read_text())


def compare(options, test, *references):
    return json.loads(run(options, ["compare", test, *references, "--json", "-"]))


def measure_reference(options, path, folder, name, arguments):
    """The mean of two halves, and how far they are apart."""
    target = str(folder / name)
    said = picture(
        options, "reference", path, target,
        ["--halves", "-s", str(REFERENCE_SAMPLES), "--time-limit", str(REFERENCE_SECONDS)] + arguments,
    )
    halves = compare(options, f"{target}_a.exr", f"{target}_b.exr")
    mean = [(a + b) / 2 for a, b in zip(halves["mean_test"], halves["mean_reference"])]
    apart = [a - b for a, b in zip(halves["mean_test"], halves["mean_reference"])]
    return {"samples": said["samples"], "bounces": said["bounces"], "mean": mean, "apart": apart}


def measure_once(options, path, folder, technique, result, seed):
    samples, seconds, directions, _ = TECHNIQUES[technique]
    more = 1 if seed <= 2 else 2
    reference = reference_of(technique)
    target = str(folder / f"{technique}_{seed}")
    said = picture(
        options, "render", path, target,
        ["-t", technique, "-b", str(result[reference]["bounces"]), "--seed", str(seed)]
        + ["-s", str(more * samples), "--time-limit", str(more * seconds)]
        + ["-D", f"environment.directions={directions}"] + FINE,
    )
    measured = compare(options, f"{target}.exr", str(folder / f"{reference}.exr"))
    return {"samples": said["samples"], "mean": measured["mean_test"],
            "not_finite": measured["non_finite_test"]}


def mean_of(runs, value):
    """Mean of value(run), weighted by samples, and the square of its standard error."""
    weights = [run["samples"] for run in runs]
    values = [value(run) for run in runs]
    mean = sum(w * v for w, v in zip(weights, values)) / sum(weights)
    spread = sum(w * (v - mean) ** 2 for w, v in zip(weights, values)) / sum(weights)
    return mean, spread / max(1, len(runs) - 1)


def reference_of(technique):
    """Which of a model's references holds the light that the technique renders."""
    return "direct" if technique == "direct" else "all"


def bias(result, technique):
    """Of the worst channel, relative to the mean of the brightest, and its standard error."""
    reference = result[reference_of(technique)]
    whole = max(reference["mean"])
    worst = (0.0, 0.0)
    if not whole > 0.0:
        return worst
    for c in range(3):
        variance = (reference["apart"][c] / 2) ** 2
        mean, square = mean_of(result["runs"][technique], lambda run: run["mean"][c])
        one = ((mean - reference["mean"][c]) / whole, (variance + square) ** 0.5 / whole)
        if abs(one[0]) >= abs(worst[0]):
            worst = one
    return worst


def enough(result, technique):
    if len(result["runs"][technique]) < 2:
        return False
    value, error = bias(result, technique)
    bound = TECHNIQUES[technique][3]
    return abs(value) < bound or error < abs(value) / 3 or len(result["runs"][technique]) >= SEEDS


def measure(options, model):
    folder = pathlib.Path(options.work) / model.name
    folder.mkdir(parents=True, exist_ok=True)
    kept = folder / "result.json"
    result = json.loads(kept.read_text()) if kept.exists() else {"runs": {}}

    def keep():
        aside = kept.with_suffix(".part")
        aside.write_text(json.dumps(result, indent=1))
        os.replace(aside, kept)

    try:
        path = result.get("file") or choose(options, model)
        result["file"] = path
        for name, arguments in (("direct", ["-b", "0"]), ("all", [])):
            if name not in result:
                result[name] = measure_reference(options, path, folder, name, arguments)
                keep()
        for technique in TECHNIQUES:
            runs = result["runs"].setdefault(technique, [])
            while not enough(result, technique):
                runs.append(measure_once(options, path, folder, technique, result, len(runs) + 1))
                keep()
            value, error = bias(result, technique)
            print(f"{model.name} {technique} {100 * value:+.2f} % (+- {100 * error:.2f} %)", flush=True)
    except Failure as failure:
        result["failure"] = str(failure)
        keep()
        print(f"{model.name}: {failure}", flush=True)


def table(options, models):
    print("| model | " + " | ".join(f"`{name}`" for name in TECHNIQUES) + " |")
    print("| --- " * (1 + len(TECHNIQUES)) + "|")
    for model in models:
        kept = pathlib.Path(options.work) / model.name / "result.json"
        result = json.loads(kept.read_text()) if kept.exists() else {"runs": {}}
        cells = []
        for name, (_, _, _, bound) in TECHNIQUES.items():
            if len(result["runs"].get(name, [])) < 2 or "apart" not in result.get(reference_of(name), {}):
                cells.append("")
                continue
            value, error = bias(result, name)
            cell = f"{100 * value:+.1f} ± {100 * error:.1f}"
            beyond = abs(value) > bound + 2 * error
            cells.append(f"**{cell}**" if beyond else cell)
        if any(cells):
            print(f"| {model.name} | " + " | ".join(cells) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("models", type=pathlib.Path)
    parser.add_argument("--work", required=True, help="folder for pictures and results")
    parser.add_argument("--environment", help="latitude-longitude .hdr or .exr")
    parser.add_argument("--lightsheaf", default="build/lightsheaf")
    parser.add_argument("--size", type=int, default=96, help="side of the pictures in pixels")
    parser.add_argument("--only", help="names of models, separated by commas")
    parser.add_argument("--table", action="store_true", help="print what was measured")
    options = parser.parse_args()
    names = options.only.split(",") if options.only else None
    models = [m for m in sorted(options.models.iterdir()) if m.is_dir() and (not names or m.name in names)]
    if options.table:
        table(options, models)
        return
    if not options.environment:
        sys.exit("--environment is needed, but for --table")
    for model in models:
        measure(options, model)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Measures the denoiser on scenes and views that training never saw, against the path tracer, by the command alone."""
import argparse
import json
import pathlib
import shlex
import subprocess
import sys

TECHNIQUES = ("bidirectional", "cone", "voxel_path", "substitute_tree")
NETWORK = ("-D", "light_filter.kind=network")
LAST = 720  # of a turn's frames, half a degree apart: where it began
MOVING = ("--turntable", LAST, "--frames", f"{LAST - 8}-{LAST}", "--temporal")
# Name of a column and its options of render, by one iteration a frame. All show the camera's own view.
VARIANTS = (("raw", ("--raw",)), ("filter", ()), ("network", NETWORK), ("temporal", MOVING),
            ("temporal-network", (*NETWORK, *MOVING)))
METRICS = ("ssim", "flip", "relmse", "bias")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("out", type=pathlib.Path, help="folder of pictures and results.json; what is there is kept")
    parser.add_argument("--scene", action="append", required=True, metavar="WORDS", type=shlex.split,
                        help="in quotes a name, a scene and options of it; repeatable")
    parser.add_argument("--command", default="build/lightsheaf")
    parser.add_argument("--size", default="256,160", help="width,height in pixels")
    parser.add_argument("--reference-samples", default="128", help="of each half of the reference")
    parser.add_argument("--techniques", nargs="*", default=TECHNIQUES)
    parser.add_argument("--variants", nargs="*", default=[name for name, _ in VARIANTS])
    return parser.parse_args()


def run(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(f"{' '.join(str(word) for word in command)}: {done.stderr.strip()}")


def reference(args, folder, scene):
    """Two halves of the path-traced picture."""
    if not (folder / "reference_b.exr").exists():
        run(args.command, "reference", *scene, "-o", folder / "reference.exr", "--halves", "-r", args.size,
            "-s", args.reference_samples)
    return folder / "reference_a.exr", folder / "reference_b.exr"


def measure(args, folder, scene, technique, variant):
    """Renders a variant and compares its last frame with the reference: SSIM, FLIP, relMSE, and the error of the mean as a share of it."""
    name, options = variant
    path = folder / f"{technique}_{name}.exr"
    if not path.exists():
        frames = folder / f"{technique}_{name}_%d.exr" if "--frames" in options else path
        run(args.command, "render", *scene, "-o", frames, "-t", technique, "-r", args.size, "-s", "1", *options)
        if frames != path:
            pathlib.Path(str(frames).replace("%d", str(LAST))).rename(path)
    run(args.command, "compare", path, *reference(args, folder, scene), "--flip", "--json", path.with_suffix(".json"))
    found = json.loads(path.with_suffix(".json").read_text())
    return {metric: found[metric] for metric in METRICS}


def table(results, metric):
    """As Markdown: a row for each scene and technique, the best of single frames and of sequences in bold."""
    lines = [f"| {metric} | | " + " | ".join(name for name, _ in VARIANTS) + " |", "|" + " --- |" * (2 + len(VARIANTS))]
    for scene, techniques in results.items():
        for technique, found in techniques.items():
            values = [found[name][metric] if name in found else None for name, _ in VARIANTS]
            if metric == "bias":
                values = [None if v is None else sum(v) / 3 for v in values]
            lines.append(f"| {scene} | {technique} | "
                         + " | ".join("" if v is None else f"{v:.3g}" for v in values) + " |")
    return "\n".join(lines) + "\n"


def main():
    args = arguments()
    path = args.out / "results.json"
    results = json.loads(path.read_text()) if path.exists() else {}
    for name, *scene in args.scene:
        folder = args.out / name
        folder.mkdir(parents=True, exist_ok=True)
        reference(args, folder, scene)
        for technique in args.techniques:
            for variant in (v for v in VARIANTS if v[0] in args.variants):
                found = measure(args, folder, scene, technique, variant)
                results.setdefault(name, {}).setdefault(technique, {})[variant[0]] = found
                path.write_text(json.dumps(results, indent=1) + "\n")
                print(name, technique, variant[0], found, flush=True)
    (args.out / "tables.md").write_text("\n".join(table(results, metric) for metric in METRICS))


if __name__ == "__main__":
    sys.exit(main())

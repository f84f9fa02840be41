#!/usr/bin/env python3
"""The path tracer against an independent renderer, in full: takes tens of minutes.

For every picture of the manifest that is diffuse-only, renders the same view in two independent
halves and prints, for each channel, the relative difference of the means (bias), and for the
picture:

  rmse      against the other renderer's picture
  own       our noise, rms(a - b) / 2
  other     the other renderer's noise, from the manifest
  corrected sqrt(mean((x - a)(x - b))): the other picture's error without our noise, which should
            be its own noise and nothing else
  ratio     rmse^2 / (own^2 + other^2): 1 where noise explains everything
"""
import argparse
import json
import math
import pathlib
import subprocess
import tempfile


def run(*command):
    result = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if result.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, command))}\n{result.stderr}")
    return result.stdout


def compare(lightsheaf, *images):
    return json.loads(run(lightsheaf, "compare", *images, "--json", "-", "-q"))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("lightsheaf", help="the command")
    parser.add_argument("scenes", type=pathlib.Path, help="folder with reference/manifest.json")
    parser.add_argument("--samples", type=int, default=512, help="per pixel and half")
    parser.add_argument("--only", default="", help="images whose name contains this")
    parser.add_argument("--keep", type=pathlib.Path, help="folder for the pictures")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    manifest = json.loads((options.scenes / "reference/manifest.json").read_text())
    print(f"{'image':24} {'bias R':>8} {'G':>8} {'B':>8} {'rmse':>9} {'own':>9} {'other':>9} "
          f"{'corrected':>9} {'ratio':>6} {'Mrays/s':>8}")
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.keep or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        for entry in manifest["images"]:
            if not entry["diffuse_only"] or options.only not in entry["image"]:
                continue
            stem = entry["image"].removesuffix(".exr")
            picture = folder / f"{stem}.exr"
            report = json.loads(run(
                options.lightsheaf, "reference", options.scenes / entry["gltf"], "-o", picture,
                "--resolution", f"{entry['width']},{entry['height']}",
                "--samples", options.samples, "--bounces", entry["bounces"],
                "--seed", options.seed, "--diffuse-only", "--halves", "--json", "-", "-q"))
            theirs = options.scenes / "reference" / entry["image"]
            first, second = folder / f"{stem}_a.exr", folder / f"{stem}_b.exr"
            whole = compare(options.lightsheaf, picture, theirs)
            own = compare(options.lightsheaf, first, second)["rmse"] / 2
            corrected = compare(options.lightsheaf, theirs, first, second)["rmse"]
            other = entry["noise_rmse"]
            ratio = whole["rmse"] ** 2 / (own ** 2 + other ** 2)
            bias = " ".join(f"{100 * b:+7.3f}%" for b in whole["bias"])
            speed = report["rays"] / report["seconds"]["render"] * 1e-6
            print(f"{stem:24} {bias} {whole['rmse']:9.6f} {own:9.6f} {other:9.6f} "
                  f"{corrected if corrected is not None else math.nan:9.6f} {ratio:6.3f} "
                  f"{speed:8.2f}", flush=True)


if __name__ == "__main__":
    main()

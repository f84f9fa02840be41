#!/usr/bin/env python3
"""Makes what train.py learns from: sequences of noisy and clean light, by lightsheaf-light-data."""
import argparse
import os
import pathlib
import random
import subprocess
import sys
import time

TECHNIQUES = ("bidirectional", "cone", "voxel_path", "substitute_tree")
# Never trained on: data/scenes/interior, the atrium, FlightHelmet, dancing_hall_1k.hdr and what evaluate.py names.
VALIDATION_FROM = 9000  # numbers of random scenes


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("out", type=pathlib.Path, help="folder of sequences; what is there already is kept")
    parser.add_argument("--program", default="build/scripts/denoiser/lightsheaf-light-data")
    parser.add_argument("--random", default="0-99", help="numbers of random scenes, first-last")
    parser.add_argument("--scenes", nargs="*", default=[], type=pathlib.Path, help="other scenes, seen from a turntable")
    parser.add_argument("--environments", nargs="*", default=[], type=pathlib.Path,
                        help="environments for scenes that are open to the sky")
    parser.add_argument("--techniques", nargs="*", default=TECHNIQUES)
    parser.add_argument("--size", default="160,128", help="width,height in pixels")
    parser.add_argument("--frames", type=int, default=4)
    parser.add_argument("--clean", type=int, default=24, help="iterations of the clean light of a frame")
    parser.add_argument("--clean-technique", default="bidirectional")
    return parser.parse_args()


def prepare(raw, techniques, out, name):
    """Turns files of light into a .npy for each technique."""
    import numpy as np
    from light import Frames, agree, example
    clean, sequences = Frames(f"{raw}_clean.light"), {}
    for technique in techniques:
        noisy = Frames(f"{raw}_{technique}.light")
        frames = [example(*frame) for frame in zip(noisy.textures, noisy.views, clean.textures)]
        if all(frame is not None for frame in frames):
            sequences[technique] = np.stack(frames)
    agree(sequences)
    folder = out / ("validation" if is_validation(name) else "train")
    folder.mkdir(parents=True, exist_ok=True)
    for technique, sequence in sequences.items():
        np.save(folder / f"{name}_{technique}.tmp.npy", sequence)
        (folder / f"{name}_{technique}.tmp.npy").rename(folder / f"{name}_{technique}.npy")


def is_validation(name):
    return name.startswith("random_") and int(name[7:11]) >= VALIDATION_FROM


def make(args, name, scene, options):
    """Sequences of one scene; a scene that fails is reported and left out."""
    from light import remove
    raw = args.out / "raw" / name
    raw.parent.mkdir(parents=True, exist_ok=True)
    start = time.time()
    command = [args.program, str(raw), ",".join(args.techniques), str(args.clean), str(scene), "-o", "none.exr",
               "-t", args.clean_technique, "-r", args.size, "--frames", f"0-{args.frames - 1}", *options]
    try:
        subprocess.run(command, check=True, timeout=900)
        prepare(raw, args.techniques, args.out, name)
        print(f"{name}: {time.time() - start:.0f} s", flush=True)
    except (subprocess.SubprocessError, ValueError) as error:
        print(f"{name}: {error}", flush=True)
    remove(raw)


def main():
    args = arguments()
    import scenes
    os.environ.setdefault("LIGHTSHEAF_MODULE_DIR", str(pathlib.Path(args.program).resolve().parents[2] / "src/io"))
    (args.out / "scenes").mkdir(parents=True, exist_ok=True)
    first, last = (int(n) for n in args.random.split("-"))
    for scene in args.scenes:
        r = random.Random(scene.stem)
        environment = r.choice(args.environments) if args.environments and r.random() < 0.5 else None
        options = ["--turntable", str(r.choice((60, 120, 240))), "-s", "1", "--seed", str(r.randrange(1000))]
        options += ["-e", str(environment)] if environment else []
        make(args, scene.stem, scene, options)
    for number in range(first, last + 1):
        r = random.Random(1000 + number)
        path, is_open = scenes.write(args.out / "scenes", number)
        samples = r.choice((1, 1, 1, 1, 2, 4))
        options = ["-s", str(samples), "--fps", str(r.choice((6, 12, 24))), "-b", str(r.choice((1, 2, 3))),
                   "--seed", str(number)]
        if is_open and args.environments:
            options += ["-e", str(r.choice(args.environments)), "--environment-rotation", str(r.randrange(360)),
                        "--environment-strength", str(round(r.uniform(0.3, 1.5), 2))]
        make(args, f"random_{number:04d}", path, options)


if __name__ == "__main__":
    sys.exit(main())

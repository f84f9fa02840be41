#!/usr/bin/env python3
"""Trains the denoiser's net on sequences that make_data.py has prepared.

Losses after Chaitanya et al. 2017: L1 of values, of their gradients and of their change from frame to frame, here of
u (light.py), and beside them L1 of means over 8 x 8 pixels of the light itself, which holds its energy.
"""
import argparse
import json
import pathlib
import sys
import time

VALUE, GRADIENT, TEMPORAL, ENERGY = 0.7, 0.1, 0.1, 0.1  # weights of the losses
TYPICAL = 0.1  # error that the filter leaves; where it leaves more, which nothing can tell, pixels count for less
BLOCK = 8  # pixels; the energy is compared in blocks of that side


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("data", type=pathlib.Path, help="folder of sequences, as make_data.py leaves them")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("checkpoint.pt"), help="checkpoint to write")
    parser.add_argument("--resume", type=pathlib.Path, help="checkpoint to go on from")
    parser.add_argument("--start", type=pathlib.Path, help="weights file (.lsfd) to begin with, instead of random ones")
    parser.add_argument("--steps", type=int, default=3000, help="steps in all, over which the learning rate falls to 0")
    parser.add_argument("--rate", type=float, default=1e-3, help="learning rate at the beginning")
    parser.add_argument("--batch", type=int, default=4, help="crops in a step")
    parser.add_argument("--crop", type=int, default=64, help="side of a crop in pixels, a multiple of 32")
    parser.add_argument("--frames", type=int, default=2, help="frames of a sequence that every second step takes; the others take two, at least 2")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--bfloat16", action="store_true", help="convolutions in bfloat16, which some processors do faster")
    parser.add_argument("--log", type=pathlib.Path, default=pathlib.Path("curves.json"), help="losses, as JSON")
    parser.add_argument("--every", type=int, default=100, help="steps between checkpoints")
    return parser.parse_args()


def load(folder):
    """Prepared sequences by their part of the data, as memory maps of half floats."""
    import numpy as np
    return [np.load(path, mmap_mode="r") for path in sorted(folder.glob("*.npy"))]


def augment(crop, rng):
    """Flips and turns the picture and its normals, permutes colours and shifts the scale."""
    import numpy as np
    if rng.random() < 0.5:
        crop = crop[..., ::-1].copy()
        crop[:, 12] *= -1
    if rng.random() < 0.5:
        crop = crop[..., ::-1, :].copy()
        crop[:, 13] *= -1
    if rng.random() < 0.5:
        crop = np.swapaxes(crop, -1, -2).copy()
        crop[:, [12, 13]] = crop[:, [13, 12]]
    colors = rng.permutation(3)
    for first in (0, 3, 6, 9, 20, 23):
        crop[:, first:first + 3] = crop[:, first + colors]
    light = [*range(0, 12), *range(18, 26)]
    crop[:, light] = np.log1p(np.exp(rng.uniform(-0.7, 0.7)) * np.expm1(crop[:, light]))
    return crop


def walk(length, frames, rng):
    """Numbers of so many frames of a sequence, one after the other; where it has too few, there and back again."""
    first = rng.integers(max(length - frames, 0) + 1)
    return [first + min(k % (2 * length - 2), -k % (2 * length - 2)) for k in range(frames)]


def draw(sequences, args, rng):
    """A batch of crops: (frames, batch, channels, side, side). Half of them are long, for the state, of sequences in
    which more than two frames differ; half have two frames, and as many crops more."""
    import numpy as np
    long = args.frames > 2 and rng.random() < 0.5
    frames, crops = (args.frames, args.batch) if long else (2, args.batch * args.frames // 2)
    batch = []
    while len(batch) < crops:
        sequence = sequences[rng.integers(len(sequences))]
        if len(sequence) < 2 + long:
            continue
        y = rng.integers(sequence.shape[2] - args.crop + 1)
        x = rng.integers(sequence.shape[3] - args.crop + 1)
        crop = sequence[:, :, y:y + args.crop, x:x + args.crop]
        crop = np.array(crop[walk(len(sequence), frames, rng)], np.float32)
        if crop[:, 26:28].mean() > 0.1:  # most of it is not background
            batch.append(augment(crop, rng))
    import torch
    return torch.from_numpy(np.stack(batch, 1))


def losses(net, frames, bfloat16=False):
    """The weighted sum, and each by itself, over a sequence."""
    import torch
    from torch.nn import functional
    from net import corrected
    state, before, sums = None, None, torch.zeros(4)
    for x in frames:
        target, told, share = x[:, 20:26], x[:, 26:28], x[:, 28:29]
        weight = torch.cat((told[:, :1] * (0.1 + 0.9 * (1 - share)), told[:, 1:] * (0.1 + 0.9 * share)), 1)
        weight = weight.repeat_interleave(3, 1)
        left = (weight * (x[:, 6:12] - target).abs()).sum((1, 2, 3)) / (weight.sum((1, 2, 3)) + 1.0)
        weight = weight * (TYPICAL / (TYPICAL + left))[:, None, None, None]
        with torch.autocast("cpu", torch.bfloat16, enabled=bfloat16):
            change, state = net(x[:, :20], state)
        u = corrected(x, change.float())
        off = (u - target) * (weight > 0)
        norm = weight.sum() + 1.0
        value = (weight * off.abs()).sum() / norm
        gradient = ((weight[..., 1:] * (off[..., 1:] - off[..., :-1]).abs()).sum()
                    + (weight[..., 1:, :] * (off[..., 1:, :] - off[..., :-1, :]).abs()).sum()) / norm
        temporal = torch.zeros(())
        if before is not None:
            temporal = (weight * (off - before).abs()).sum() / norm
        before = off
        light = [functional.avg_pool2d(weight * torch.expm1(torch.clamp(v, max=8.0)), BLOCK) for v in (u, target)]
        energy = (light[0] - light[1]).abs().sum() / (light[1].sum() + 1.0)
        sums = sums + torch.stack((value, gradient, temporal, energy))
    sums = sums / len(frames)
    return (sums * torch.tensor((VALUE, GRADIENT, TEMPORAL, ENERGY))).sum(), sums


def validate(net, sequences, count=16):
    """Mean losses over the first frames of sequences kept apart."""
    import numpy as np
    import torch
    from net import MULTIPLE
    sums = np.zeros(4)
    with torch.no_grad():
        for sequence in sequences[:count]:
            h, w = (n // MULTIPLE * MULTIPLE for n in sequence.shape[2:])
            sums += losses(net, torch.from_numpy(np.array(sequence[:2, None, :, :h, :w], np.float32)))[1].numpy()
    return (sums / max(len(sequences[:count]), 1)).round(5).tolist()


def main():
    args = arguments()
    import numpy as np
    import torch
    from net import Net
    torch.manual_seed(args.seed)
    torch.set_num_threads(args.threads)
    net, rng = Net().to(memory_format=torch.channels_last), np.random.default_rng(args.seed)
    if args.start:
        from export import read
        read(net, args.start)
    optimizer = torch.optim.Adam(net.parameters(), lr=args.rate)
    first, log = 0, []
    if args.resume:
        kept = torch.load(args.resume)
        net.load_state_dict(kept["net"])
        optimizer.load_state_dict(kept["optimizer"])
        first, log = kept["step"], kept["log"]
        rng = np.random.default_rng(args.seed + first)
    training, validation = (load(args.data / name) for name in ("train", "validation"))
    print(f"{len(training)} sequences, {len(validation)} for validation", flush=True)
    start, recent, compared = time.time(), [], 0
    for step in range(first, args.steps):
        for group in optimizer.param_groups:
            warm = min(1.0, (step + 1) / 100)
            group["lr"] = args.rate * warm * 0.5 * (1 + np.cos(np.pi * step / args.steps))
        loss, each = losses(net, draw(training, args, rng), args.bfloat16)
        optimizer.zero_grad()
        loss.backward()
        torch.nn.utils.clip_grad_norm_(net.parameters(), 1.0)
        optimizer.step()
        recent.append(each.detach().numpy())
        if (step + 1) % args.every == 0 or step + 1 == args.steps:
            entry = {"step": step + 1, "train": np.mean(recent, 0, np.float64).round(5).tolist()}
            if (step + 1) % (5 * args.every) == 0 or step + 1 == args.steps:
                training, validation = (load(args.data / name) for name in ("train", "validation"))  # grows meanwhile
                entry["sequences"], entry["validation"] = len(training), validate(net, validation)
                if compared != len(validation):
                    compared = len(validation)
                    entry["validation_filter"] = validate(Net(), validation)
            recent = []
            log.append(entry)
            print(json.dumps(entry), f"{(time.time() - start) / (step + 1 - first):.2f} s a step", flush=True)
            torch.save({"net": net.state_dict(), "optimizer": optimizer.state_dict(), "step": step + 1, "log": log},
                       args.out)
            lines = ",\n".join(json.dumps(each) for each in log)
            args.log.write_text('{"losses": ["value", "gradient", "temporal", "energy"], "curve": [\n' + lines
                                + "\n]}\n")


if __name__ == "__main__":
    sys.exit(main())

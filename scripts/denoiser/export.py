#!/usr/bin/env python3
"""Writes a checkpoint's weights as data/denoiser/weights.lsfd."""
import argparse
import pathlib
import struct
import sys

MAGIC, VERSION = b"LSFD", 1


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("checkpoint", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path, help="weights file to write")
    parser.add_argument("--without-state", action="store_true",
                        help="weights of the state of the frame before are 0: for a network that learnt from few frames")
    parser.add_argument("--diffuse-only", action="store_true", help="specular light stays as the filter leaves it")
    return parser.parse_args()


def write(net, path):
    """Magic, version, number of layers, slope of the leaky ReLU; of each layer its name, sizes, half weights, biases."""
    import numpy as np
    from net import SLOPE
    data = MAGIC + struct.pack("<IIf", VERSION, len(net.layers), SLOPE)
    for name, layer in net.layers.items():
        weight = layer.weight.detach().numpy()
        out, into = layer.out_channels, layer.in_channels
        data += struct.pack("<B", len(name)) + name.encode()
        data += struct.pack("<4I", out, into, *weight.shape[2:])
        half = weight.astype("<f2")
        if not np.isfinite(half).all():
            raise ValueError(f"{name}: weights beyond half floats")
        data += half.tobytes() + layer.bias.detach().numpy().astype("<f4").tobytes()
    path.write_bytes(data)


def forget(net):
    """Has the net take nothing from the frame before."""
    import torch
    from net import ENCODER
    with torch.no_grad():
        for i, width in enumerate(ENCODER, 1):
            net.layers[f"enc{i}b"].weight[:, width:] = 0.0


def leave_specular(net):
    """Has the net change diffuse light alone."""
    import torch
    with torch.no_grad():
        net.layers["out"].weight[3:] = 0.0
        net.layers["out"].bias[3:] = 0.0


def read(net, path):
    """The other way round, into a net of the same layers."""
    import numpy as np
    import torch
    data = path.read_bytes()
    if data[:4] != MAGIC or struct.unpack_from("<II", data, 4) != (VERSION, len(net.layers)):
        raise ValueError(f"{path}: not weights of this net")
    at = 16
    for name, layer in net.layers.items():
        length = data[at]
        if data[at + 1:at + 1 + length].decode() != name:
            raise ValueError(f"{path}: layer {data[at + 1:at + 1 + length]!r} where {name} is expected")
        at += 1 + length + 16
        count = layer.weight.numel()
        weight = np.frombuffer(data, "<f2", count, at).astype(np.float32)
        bias = np.frombuffer(data, "<f4", layer.out_channels, at + 2 * count)
        with torch.no_grad():
            layer.weight.copy_(torch.from_numpy(weight.reshape(layer.weight.shape)))
            layer.bias.copy_(torch.from_numpy(bias.copy()))
        at += 2 * count + 4 * layer.out_channels


def main():
    args = arguments()
    import torch
    from net import Net
    net = Net()
    net.load_state_dict(torch.load(args.checkpoint)["net"])
    if args.without_state:
        forget(net)
    if args.diffuse_only:
        leave_specular(net)
    write(net, args.out)


if __name__ == "__main__":
    sys.exit(main())

"""Reads what lightsheaf-light-data writes, and turns it into what the net takes and what it learns."""
import struct

import numpy as np

PI = np.float32(np.pi)
NOISY, CLEAN, VIEW = 9, 4, 16
LUMINANCE = np.array((0.2126, 0.7152, 0.0722), np.float32)
CHANNELS = 20 + 6 + 2 + 1  # input, clean u, whether the parts tell anything, the specular part's share


class Frames:
    """textures[frame][texture]: (height, width, 4), bottom row first; of noisy light views[frame], too."""

    def __init__(self, path):
        with open(path, "rb") as file:
            if file.read(4) != b"LSFT":
                raise ValueError(f"{path}: not written by lightsheaf-light-data")
            version, textures, width, height, self.iterations, frames = struct.unpack("<6I", file.read(24))
            if version != 2 or textures not in (NOISY, CLEAN):
                raise ValueError(f"{path}: version {version} with {textures} textures")
            self.views, self.textures = [], []
            for _ in range(frames):
                self.views.append(np.fromfile(file, "<f4", VIEW if textures == NOISY else 0))
                values = np.fromfile(file, "<f4", textures * height * width * 4)
                self.textures.append(values.reshape(textures, height, width, 4))


def remove(raw):
    """The files of light whose names begin with that path."""
    for path in raw.parent.glob(f"{raw.name}_*.light"):
        path.unlink()


def luminance(rgb):
    return rgb @ LUMINANCE


def parts(light):
    """Diffuse and specular light as radiances, 0 where it tells nothing; and where it tells something."""
    told = [light[part][..., 3] >= 0.0 for part in (0, 1)]
    diffuse = np.where(told[0][..., None], light[0][..., :3], 0.0) / PI
    specular = np.where(told[1][..., None], light[1][..., :3], 0.0)
    return diffuse, specular, told


def scale_of(diffuse, specular, told):
    """The picture's s: its mean of square roots of luminance, squared."""
    counted = told[0] | told[1]
    if not counted.any():
        return np.float32(0.0)
    y = np.maximum(luminance(diffuse) + luminance(specular), 0.0)[counted]
    return np.float32(np.sqrt(y.astype(np.float64)).mean() ** 2)


def u_of(x, scale):
    return np.log1p(10.0 * np.maximum(x, 0.0) / scale)


def x_of(u, scale):
    return scale / 10.0 * np.expm1(u)


def view_depth(depth, view):
    """Of reverse-Z depths that are not 0, in normalised units; as glsl/lib/view.glsl."""
    a, b, start, flat = view[9:13]
    return start + ((depth - b) / a if flat else (b - depth * start) / (depth - a))


def net_input(noisy, view):
    """(INPUTS, height, width), and the scale; None for a black picture."""
    diffuse, specular, told = parts(noisy[0:2])
    filtered = [np.where(t[..., None], light, 0.0) for t, light in zip(told, parts(noisy[2:4])[:2])]
    scale = scale_of(*filtered, told)
    if not scale > 0.0 or not np.isfinite(scale):
        return None, scale
    guide, factor = noisy[6], noisy[5]
    seen = guide[..., 3] != 0.0
    depth = np.zeros_like(guide[..., 3])
    depth[seen] = 1.0 / (1.0 + np.maximum(view_depth(guide[..., 3][seen], view), 0.0))
    normal = guide[..., :3] @ view[:9].reshape(3, 3).T
    lobes = factor[..., 3] >= 0.0
    noise = [np.where(t, np.sqrt(np.maximum(light[..., 3], 0.0)) / unit, 0.0)
             for t, light, unit in zip(told, noisy[0:2], (PI, 1.0))]
    planes = [u_of(diffuse, scale), u_of(specular, scale), u_of(filtered[0], scale), u_of(filtered[1], scale),
              np.where(seen[..., None], normal, 0.0), depth[..., None],
              np.where(lobes, factor[..., 3], 0.0)[..., None],
              np.where(lobes, luminance(factor[..., :3]), 0.0)[..., None],
              u_of(noise[0], scale)[..., None], u_of(noise[1], scale)[..., None]]
    return np.moveaxis(np.concatenate(planes, -1), -1, 0).astype(np.float32), scale


def example(noisy, view, clean):
    """(CHANNELS, height, width) in half floats: what a frame teaches. None for one that teaches nothing."""
    x, scale = net_input(noisy, view)
    if x is None or not np.isfinite(x).all():
        return None
    noisy_told, clean_told = parts(noisy[0:2])[2], parts(clean[0:2])[2]
    told = [a & b for a, b in zip(noisy_told, clean_told)]
    light = [np.where(t[..., None], part, 0.0) for t, part in zip(told, parts(clean[2:4])[:2])]
    reflected = [luminance(part * factor[..., :3]) * unit
                 for part, factor, unit in zip(light, noisy[4:6], (PI, np.float32(1.0)))]
    share = reflected[1] / np.maximum(reflected[0] + reflected[1], 1e-20)
    planes = [x] + [np.moveaxis(u_of(part, scale), -1, 0) for part in light]
    planes += [told[0][None], told[1][None], share[None]]
    return np.concatenate(planes, 0).astype(np.float16)


def _soft(values, weight, radius=6, times=2):
    """Weighted means over squares, as often; (..., height, width)."""
    def box(x):
        for axis in (-2, -1):
            pad = [(0, 0)] * x.ndim
            pad[axis] = (radius + 1, radius)
            sums = np.cumsum(np.pad(x, pad, mode="edge"), axis, dtype=np.float64)
            size, low, high = x.shape[axis], [slice(None)] * x.ndim, [slice(None)] * x.ndim
            low[axis], high[axis] = slice(0, size), slice(2 * radius + 1, 2 * radius + 1 + size)
            x = sums[tuple(high)] - sums[tuple(low)]
        return x
    for _ in range(times):
        values = box(values * weight) / np.maximum(box(weight), 1e-6)
    return values


# Whose filtered light tells how bright the diffuse part is.
TELLS = ("bidirectional", "cone", "voxel_path", "substitute_tree")


def agree(frames):
    """Takes soft errors out of clean diffuse light: of few VPLs it has about as much as one filtered iteration of another
    technique, of independent random numbers. So where it is soft, clean light becomes the median of itself and of
    what the other techniques' iterations say; its edges and shadows stay. Of specular light means over neighbours
    would carry what is bright in a reflection into what is dark. `frames`: technique -> (frames, CHANNELS, height,
    width), changed in place."""
    # Clean light is the same for all, but for the scale.
    sums = {name: np.expm1(array[:, 20:26].astype(np.float32)).sum((1, 2, 3), dtype=np.float64)
            for name, array in frames.items()}
    clean = {name: array[:, 20:23].astype(np.float32) for name, array in frames.items()}
    for name, array in frames.items():
        own, told = clean[name], array[:, 26].astype(np.float32)
        said = [own]
        for other in TELLS:
            if other in frames and other != name:
                ratio = (sums[name] / np.maximum(sums[other], 1e-20))[:, None, None, None]
                light = np.expm1(frames[other][:, 6:9].astype(np.float32))
                said.append(np.log1p(light * ratio))
        off = np.median(np.stack(said), 0) - own
        weight = np.broadcast_to(told[:, None], off.shape)
        array[:, 20:23] = np.maximum(own + _soft(off, weight) * weight, 0.0)

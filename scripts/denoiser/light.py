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
            if version != 1 or textures not in (NOISY, CLEAN):
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
    filtered = [np.where(t[..., None], light, 0.0) for t, light in zip(told, parts(noisy[3:5])[:2])]
    scale = scale_of(*filtered, told)
    if not scale > 0.0 or not np.isfinite(scale):
        return None, scale
    guide, factor = noisy[5], noisy[7]
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


def cleared(light, factor):
    """Light without its tint, as glsl/lib/light_clear.glsl has it; and where that tells something."""
    tint = luminance(factor)[..., None]
    told = tint > 0.0
    grey = luminance(light)[..., None] / np.where(told, tint, 1.0)
    clear = np.where(factor > 0.0, light / np.where(factor > 0.0, factor, 1.0), grey)
    return np.where(told, clear, 0.0), told[..., 0] & np.isfinite(clear).all(-1)


def example(noisy, view, clean):
    """(CHANNELS, height, width) in half floats: what a frame teaches. None for one that teaches nothing."""
    x, scale = net_input(noisy, view)
    if x is None or not np.isfinite(x).all():
        return None
    told, light, reflected = parts(noisy[0:2])[2], [], []
    for part, unit in ((0, PI), (1, np.float32(1.0))):
        clear, known = cleared(clean[part][..., :3], clean[2 + part][..., :3])
        told[part] = told[part] & known
        light.append(np.where(told[part][..., None], clear / unit, 0.0))
        reflected.append(luminance(light[part] * clean[2 + part][..., :3]) * unit)
    share = reflected[1] / np.maximum(reflected[0] + reflected[1], 1e-20)
    planes = [x] + [np.moveaxis(u_of(part, scale), -1, 0) for part in light]
    planes += [told[0][None], told[1][None], share[None]]
    return np.concatenate(planes, 0).astype(np.float16)

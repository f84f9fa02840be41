"""Furniture of the interior. Each function returns parts: material name -> Mesh, standing on y = 0
around the origin, front towards +z; metres."""
import colorsys
import math
import random

from shapes import Mesh, Placement


def _parts(*names):
    return {name: Mesh() for name in names}


def sofa():
    parts = _parts("linen", "cushion rust", "cushion teal", "dark wood")
    linen = parts["linen"]
    linen.cushion((2.1, 0.24, 0.86), 0.05, Placement(0, 0.27, 0))
    linen.cushion((2.1, 0.52, 0.22), 0.07, Placement(0, 0.56, -0.36, tilt_x=-7), 0.01)
    for side in (-1, 1):
        linen.cushion((0.2, 0.46, 0.88), 0.07, Placement(side * 1.0, 0.40, 0.0), 0.01)
        linen.cushion((0.89, 0.17, 0.66), 0.06, Placement(side * 0.45, 0.44, 0.1), 0.025)
        linen.cushion((0.87, 0.40, 0.18), 0.07, Placement(side * 0.45, 0.69, -0.24, tilt_x=-14),
                      0.05)
        for front in (-1, 1):
            parts["dark wood"].cylinder(0.018, 0.15, 16, Placement(side * 0.95, 0, front * 0.36),
                                        top_radius=0.028)
    parts["cushion rust"].cushion((0.44, 0.44, 0.10), 0.045,
                                  Placement(-0.68, 0.72, -0.04, 18, -22, 8), 0.05)
    parts["cushion teal"].cushion((0.40, 0.40, 0.10), 0.045,
                                  Placement(0.66, 0.70, -0.03, -16, -24, -7), 0.05)
    return parts


def chair():
    parts = _parts("oak", "cushion teal")
    oak = parts["oak"]
    oak.cushion((0.44, 0.035, 0.42), 0.015, Placement(0, 0.45, 0), texel=1.0)
    parts["cushion teal"].cushion((0.40, 0.045, 0.38), 0.02, Placement(0, 0.485, 0), 0.012)
    for x in (-0.18, 0.18):
        oak.cylinder(0.013, 0.435, 16, Placement(x * 1.1, 0, 0.18, tilt_z=x * 9), top_radius=0.02)
        oak.tube([(x * 1.1, 0, -0.20), (x, 0.45, -0.18), (x, 0.68, -0.20), (x * 0.98, 0.9, -0.26)],
                 0.016)
    for height, z in ((0.86, -0.246), (0.74, -0.216)):
        back = [(0.19 * s, height, z - 0.035 * (1 - s * s)) for s in (-1, -.5, 0, .5, 1)]
        oak.tube(back, 0.016)
    for i in range(-2, 3):
        x = i * 0.06
        oak.tube([(x, 0.46, -0.19), (x, 0.74, -0.216 - 0.03)], 0.008, 8)
    return parts


def _rim(radius, thickness, height):
    """A table top's rounded edge, for a lathe."""
    return [(radius - thickness / 2 + thickness / 2 * math.cos(a),
             height + thickness / 2 * math.sin(a))
            for a in [math.radians(-90 + 180 * i / 8) for i in range(9)]]


def dining_table():
    parts = _parts("oak", "oak top")
    parts["oak top"].lathe([(0, 0.72), *_rim(0.55, 0.035, 0.7375), (0, 0.755)], 96)
    oak = parts["oak"]
    oak.lathe([(0, 0), (0.27, 0), (0.27, 0.02), (0.20, 0.05), (0.07, 0.10), (0.045, 0.2),
               (0.04, 0.4), (0.05, 0.6), (0.12, 0.70), (0.16, 0.72), (0, 0.72)], 48)
    _planar_uv(parts["oak top"])
    return parts


def _planar_uv(mesh):
    """Texture coordinates in metres from above, for boards that are cut, not bent."""
    mesh.uvs = [(p[0], p[2]) for p in mesh.positions]


def coffee_table():
    parts = _parts("dark wood top", "brass")
    parts["dark wood top"].lathe([(0, 0.39), *_rim(0.46, 0.03, 0.405), (0, 0.42)], 96)
    _planar_uv(parts["dark wood top"])
    for i in range(3):
        angle = 2 * math.pi * i / 3 + 0.5
        c, s = math.cos(angle), math.sin(angle)
        parts["brass"].tube([(0.34 * c, 0, 0.34 * s), (0.22 * c, 0.2, 0.22 * s),
                             (0.34 * c, 0.39, 0.34 * s)], 0.011, 12)
    return parts


def bowl_of_oranges():
    parts = _parts("ceramic", "orange")
    parts["ceramic"].lathe(
        [(0, 0), (0.06, 0), (0.062, 0.012), (0.11, 0.035), (0.15, 0.075), (0.17, 0.12),
         (0.172, 0.126), (0.166, 0.127), (0.145, 0.08), (0.105, 0.043), (0.05, 0.022), (0, 0.02)],
        64)
    for x, y, z in ((-0.06, 0.075, 0.0), (0.035, 0.072, 0.055), (0.035, 0.074, -0.055),
                    (0.0, 0.132, 0.005)):
        parts["orange"].sphere(0.042, 24, Placement(x, y, z))
    return parts


def vase():
    """With five dry stems."""
    parts = _parts("glaze", "stem", "blossom")
    parts["glaze"].lathe(
        [(0, 0), (0.05, 0), (0.055, 0.005), (0.085, 0.06), (0.092, 0.11), (0.08, 0.16),
         (0.05, 0.205), (0.034, 0.24), (0.034, 0.265), (0.044, 0.285), (0.040, 0.286),
         (0.029, 0.263), (0.029, 0.24), (0.04, 0.2), (0, 0.1)], 64)
    generator = random.Random(7)
    for i in range(6):
        angle = 2 * math.pi * i / 6 + 0.4
        lean = 0.06 + 0.10 * generator.random()
        c, s = math.cos(angle) * lean, math.sin(angle) * lean
        top = 0.52 + 0.16 * generator.random()
        path = [(c * t * t, 0.15 + (top - 0.15) * t, s * t * t) for t in (0, .25, .5, .75, 1)]
        parts["stem"].tube(path, 0.0025, 6)
        for k in range(5):
            t = 1 - 0.07 * k
            parts["blossom"].sphere(
                0.013 - 0.0012 * k, 8,
                Placement(c * t * t + 0.008 * (generator.random() - .5),
                          0.15 + (top - 0.15) * t, s * t * t + 0.008 * (generator.random() - .5)))
    return parts


def teapot():
    parts = _parts("brass")
    brass = parts["brass"]
    brass.lathe([(0, 0), (0.05, 0), (0.052, 0.006), (0.078, 0.03), (0.09, 0.065), (0.084, 0.1),
                 (0.055, 0.128), (0.05, 0.134), (0.03, 0.146), (0.01, 0.15), (0.012, 0.158),
                 (0.017, 0.168), (0.012, 0.178), (0, 0.181)], 64, crease=70)
    brass.tube([(0.075, 0.05, 0), (0.11, 0.065, 0), (0.125, 0.10, 0), (0.145, 0.125, 0)], 0.011, 16)
    handle = [(-0.075 - 0.055 * math.sin(math.pi * i / 12), 0.11 - 0.075 * i / 12, 0)
              for i in range(13)]
    brass.tube(handle, 0.006, 12)
    return parts


def bookshelf():
    parts = _parts("oak", "books", "ceramic", "brass")
    oak, width, height, depth = parts["oak"], 1.2, 2.1, 0.30
    for side in (-1, 1):
        oak.box((0.03, height, depth), Placement(side * (width / 2 - 0.015), height / 2, 0),
                grain=1)
    oak.box((width - 0.06, height, 0.012), Placement(0, height / 2, -depth / 2 + 0.006), grain=1)
    shelves = [0.06, 0.45, 0.82, 1.17, 1.50, 1.81, height - 0.015]
    for y in shelves:
        oak.box((width - 0.06, 0.028, depth - 0.012), Placement(0, y, 0.006))
    generator = random.Random(19)
    for level in range(6):
        bottom, top = shelves[level] + 0.014, shelves[level + 1] - 0.014
        x, end = -width / 2 + 0.04, width / 2 - 0.05
        pause = -0.35 + 0.75 * generator.random()
        while True:
            thick = 0.016 + 0.034 * generator.random()
            if x + thick > end:
                break
            tall = min(0.19 + 0.1 * generator.random(), top - bottom - 0.02)
            deep = 0.15 + 0.06 * generator.random()
            color = colorsys.hsv_to_rgb(
                generator.choice((0.01, 0.06, 0.10, 0.13, 0.36, 0.52, 0.58, 0.95))
                + 0.02 * generator.random(), 0.15 + 0.5 * generator.random(),
                (0.10 + 0.45 * generator.random()) ** 1.2)
            _book(parts["books"], (thick, tall, deep),
                  Placement(x + thick / 2, bottom + tall / 2, 0.12 - deep / 2), color)
            x += thick + 0.0015
            if x > pause:
                if level % 3 == 1:
                    parts["ceramic"].lathe(
                        [(0, 0), (0.05, 0), (0.07, 0.05), (0.06, 0.12), (0.025, 0.16),
                         (0.03, 0.18), (0.025, 0.181), (0, 0.15)], 40,
                        Placement(x + 0.11, bottom, 0.02))
                elif level % 3 == 2:
                    parts["brass"].sphere(0.07, 32, Placement(x + 0.11, bottom + 0.07, 0.02))
                x += 0.22
                pause = 9
    return parts


def _book(mesh, size, at, color):
    """Upright, its rounded back towards +z; paper shows on top."""
    thick, tall, deep = size
    mesh.box((thick, tall, deep), at, color=color)
    mesh.box((thick * 0.78, tall - 0.006, deep - 0.01),
             Placement(at.offset[0], at.offset[1] + 0.0045, at.offset[2] - 0.004),
             color=(0.72, 0.66, 0.54))

    def back(u, v):
        angle = math.pi * (1 - u)
        return (thick / 2 * math.cos(angle), tall * (v - 0.5),
                deep / 2 + 0.35 * thick * math.sin(angle))

    mesh.grid(6, 1, back, at, color)


def book_pile():
    mesh = Mesh()
    y = 0.0
    for size, turn, color in (((0.21, 0.028, 0.15), 8, (0.30, 0.06, 0.05)),
                              ((0.19, 0.022, 0.14), -7, (0.07, 0.14, 0.20)),
                              ((0.17, 0.018, 0.12), 19, (0.48, 0.36, 0.16))):
        mesh.box(size, Placement(0, y + size[1] / 2, 0, turn), color=color)
        y += size[1]
    return {"books": mesh}


def picture(width, height):
    """Hangs with its centre at the origin, back at z = 0."""
    parts = _parts("dark wood", "painting", "paper")
    border, depth = 0.04, 0.03
    for side in (-1, 1):
        parts["dark wood"].box((border, height + 2 * border, depth),
                               Placement(side * (width + border) / 2, 0, depth / 2), grain=1)
        parts["dark wood"].box((width, border, depth),
                               Placement(0, side * (height + border) / 2, depth / 2))
    w, h = width / 2, height / 2
    parts["paper"].box((width, height, 0.01), Placement(0, 0, 0.005))
    w, h = w - 0.07, h - 0.07
    parts["painting"].quad((-w, -h, 0.0115), (w, -h, 0.0115), (w, h, 0.0115), (-w, h, 0.0115),
                           uv=((0, 1), (1, 1), (1, 0), (0, 0)))
    return parts


def _shade(mesh, bottom, top, bottom_radius, top_radius, thickness=0.003):
    """An open cone with an inside and an outside."""
    mesh.lathe([(bottom_radius - thickness, bottom), (bottom_radius, bottom), (top_radius, top),
                (top_radius - thickness, top), (bottom_radius - thickness, bottom)], 64)


def floor_lamp():
    """The bulb is at y = 1.58, near the top, to light the ceiling."""
    parts = _parts("brass", "shade")
    parts["brass"].lathe([(0, 0), (0.14, 0), (0.14, 0.012), (0.02, 0.025), (0.011, 0.05),
                          (0.011, 1.44), (0.018, 1.45), (0.018, 1.48), (0, 1.48)], 48)
    _shade(parts["shade"], 1.38, 1.66, 0.20, 0.145)
    return parts


def pendant():
    """Hangs from y = 0; the bulb is at y = -0.98."""
    parts = _parts("black metal", "shade")
    parts["black metal"].cylinder(0.05, 0.02, 32, Placement(0, -0.02, 0))
    parts["black metal"].cylinder(0.004, 0.86, 8, Placement(0, -0.88, 0))
    parts["black metal"].lathe([(0, -0.94), (0.022, -0.94), (0.022, -0.88), (0, -0.86)], 24)
    _shade(parts["shade"], -1.06, -0.86, 0.23, 0.10)
    return parts


def ceiling_lamp():
    """A bare bulb below y = 0, which throws no shadow but upwards; light it at y = -0.42."""
    parts = _parts("brass", "bulb")
    parts["brass"].cylinder(0.05, 0.02, 32, Placement(0, -0.02, 0))
    parts["brass"].cylinder(0.006, 0.26, 12, Placement(0, -0.28, 0))
    parts["brass"].cylinder(0.016, 0.05, 24, Placement(0, -0.33, 0), top_radius=0.012)
    parts["bulb"].sphere(0.03, 24, Placement(0, -0.35, 0))
    return parts


def pouf():
    mesh = Mesh()
    profile = [(0, 0), (0.17, 0)]
    for i in range(25):  # a flattened round: |cos|^0.4, |sin|^0.8
        angle = math.radians(-88 + 176 * i / 24)
        height = math.copysign(abs(math.sin(angle)) ** 0.8, angle)
        profile.append((0.28 * math.cos(angle) ** 0.4, 0.195 + 0.19 * height))
    mesh.lathe([*profile, (0, 0.392)], 64, crease=80)
    return {"leather": mesh}


def plant():
    """Long arching leaves from a pot."""
    parts = _parts("terracotta", "soil", "leaf")
    parts["terracotta"].lathe(
        [(0, 0), (0.13, 0), (0.135, 0.01), (0.175, 0.27), (0.19, 0.275), (0.192, 0.32),
         (0.172, 0.322), (0.165, 0.28), (0, 0.27)], 64)
    parts["soil"].lathe([(0.168, 0.285), (0.1, 0.295), (0, 0.3)], 32)
    generator = random.Random(3)
    for i in range(46):
        length = 0.55 + 0.45 * generator.random()
        width = 0.030 + 0.018 * generator.random()
        rise = math.radians(48 + 38 * generator.random())
        droop = 0.5 + 0.9 * generator.random()
        turn = 137.5 * i + 20 * generator.random()

        def blade(u, v, length=length, width=width, rise=rise, droop=droop):
            reach, height, steps = 0.0, 0.0, 16
            for k in range(steps):  # walk along the bending midrib
                if k / steps >= v:
                    break
                angle = rise - droop * 1.4 * (k / steps) ** 1.6
                step = length * min(1 / steps, v - k / steps)
                reach += math.cos(angle) * step
                height += math.sin(angle) * step
            spread = width * math.sin(math.pi * min(1.0, 0.12 + 0.88 * v)) ** 0.7
            s = 2 * u - 1
            return (0.02 + reach, 0.29 + height + 0.3 * spread * s * s, -s * spread)

        parts["leaf"].grid(4, 12, blade, Placement(turn=turn))
    return parts


def curtain(width, height, folds):
    """Hangs from y = height, along x, gathered."""
    def cloth(u, v):
        depth = 0.035 * (0.55 + 0.45 * (1 - v)) * math.sin(2 * math.pi * folds * u + 0.4)
        sway = 0.012 * math.sin(2 * math.pi * folds * u * 0.5 + 3 * v)
        return (width * (u - 0.5) + 0.2 * sway, height * v, depth + sway)

    mesh = Mesh()
    mesh.grid(folds * 12, 16, cloth)
    return {"curtain": mesh}


def rug(width, depth):
    parts = _parts("rug", "fringe")
    top = 0.012
    w, d = width / 2, depth / 2
    parts["rug"].quad((-w, top, d), (w, top, d), (w, top, -d), (-w, top, -d),
                      uv=((0, 1), (1, 1), (1, 0), (0, 0)))
    for a, b in (((-w, d), (w, d)), ((w, d), (w, -d)), ((w, -d), (-w, -d)), ((-w, -d), (-w, d))):
        parts["fringe"].quad((a[0], 0.001, a[1]), (b[0], 0.001, b[1]), (b[0], top, b[1]),
                             (a[0], top, a[1]))
    generator = random.Random(23)
    for side in (-1, 1):
        for i in range(160):
            z = -d + depth * (i + 0.5) / 160
            bend = 0.02 * (generator.random() - 0.5)
            x0, x1 = side * w, side * (w + 0.07)
            corners = [(x0, 0.008, z + 0.005), (x1, 0.003, z + 0.005 + bend),
                       (x1, 0.003, z - 0.005 + bend), (x0, 0.008, z - 0.005)]
            parts["fringe"].quad(*(corners if side > 0 else corners[::-1]))
    return parts


"""Little random scenes to learn from: rooms, courts and plains with objects, lights and a camera that move.

A scene is a function of its number alone. Shapes and glTF come from data/scenes.
"""
import math
import pathlib
import random
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "data/scenes"))

from shapes import Mesh, Placement  # noqa: E402
from textures import noise  # noqa: E402
from writer import Gltf, png  # noqa: E402

TEXTURE_SIDE = 64


def _texture(random_source):
    """Stripes, checks or value noise between two colours, 8-bit."""
    kind = random_source.choice(("stripes", "checks", "noise"))
    a, b = ([random_source.uniform(0.1, 0.95) for _ in range(3)] for _ in range(2))
    count, seed = random_source.choice((2, 4, 8)), random_source.randrange(1000)
    rows = []
    for y in range(TEXTURE_SIDE):
        row = bytearray()
        for x in range(TEXTURE_SIDE):
            u, v = x / TEXTURE_SIDE, y / TEXTURE_SIDE
            if kind == "stripes":
                t = int(u * 2 * count) % 2
            elif kind == "checks":
                t = (int(u * 2 * count) + int(v * 2 * count)) % 2
            else:
                t = noise(u * 2 * count, v * 2 * count, seed, 2 * count, 2 * count)
            row += bytes(int(255 * (p * (1 - t) + q * t)) for p, q in zip(a, b))
        rows.append(bytes(row))
    return png(TEXTURE_SIDE, TEXTURE_SIDE, 3, rows)


def _materials(gltf, r, name, count):
    """Adds `count` materials, of which about half are diffuse; returns their names."""
    names = []
    for i in range(count):
        texture = None
        if r.random() < 0.35:
            texture = gltf.texture(f"{name}_{i}.png", _texture(r))
        grey = r.random() < 0.4
        value = r.uniform(0.3, 0.9)
        color = [value] * 3 if grey else [r.uniform(0.05, 0.95) for _ in range(3)]
        kind = r.random()
        roughness, metallic = 1.0, 0.0
        if kind > 0.87:
            roughness, metallic = r.uniform(0.05, 0.6), 1.0
            color = [0.4 + 0.6 * c for c in color]
        elif kind > 0.55:
            roughness = r.uniform(0.1, 0.7)
        names.append(f"m{i}")
        gltf.material(names[-1], color if texture is None else (1.0, 1.0, 1.0), roughness, metallic,
                      texture=texture, double_sided=True)
    return names


def _room(gltf, r, materials, half, height, open_sides):
    """Walls of quads, as boxes have; `open_sides` of ceiling, left, right and back are left out."""
    x, z = half
    walls = {"floor": ((-x, 0, z), (x, 0, z), (x, 0, -z), (-x, 0, -z)),
             "ceiling": ((-x, height, -z), (x, height, -z), (x, height, z), (-x, height, z)),
             "back": ((-x, 0, -z), (x, 0, -z), (x, height, -z), (-x, height, -z)),
             "front": ((x, 0, z), (-x, 0, z), (-x, height, z), (x, height, z)),
             "left": ((-x, 0, z), (-x, 0, -z), (-x, height, -z), (-x, height, z)),
             "right": ((x, 0, -z), (x, 0, z), (x, height, z), (x, height, -z))}
    for name, corners in walls.items():
        if name in open_sides:
            continue
        mesh = Mesh()
        mesh.quad(*corners, uv=((0, 0), (3, 0), (3, 2), (0, 2)))
        gltf.node(name, mesh=gltf.mesh(name, {r.choice(materials): mesh}))


def _object(r, size, at):
    mesh = Mesh()
    kind = r.choice(("box", "box", "sphere", "cylinder", "cushion", "vase", "table", "tube"))
    if kind == "box":
        mesh.box([size * r.uniform(0.4, 1.6) for _ in range(3)], at)
    elif kind == "sphere":
        mesh.sphere(size * 0.6, 32, at)
    elif kind == "cylinder":
        mesh.cylinder(size * r.uniform(0.2, 0.5), size * r.uniform(0.5, 2.0), 24, at)
    elif kind == "cushion":
        mesh.cushion((size * 1.4, size * 0.6, size), size * 0.15, at)
    elif kind == "vase":
        mesh.lathe([(0, 0), (0.35 * size, 0), (0.5 * size, 0.5 * size), (0.2 * size, size), (0.3 * size, 1.2 * size)],
                   32, at)
    elif kind == "table":
        low = Placement(at.offset[0], 0, at.offset[2])
        mesh.box((size * 1.6, size * 0.08, size), Placement(at.offset[0], size * 0.8, at.offset[2]))
        for sx in (-1, 1):
            for sz in (-1, 1):
                mesh.cylinder(size * 0.05, size * 0.8, 10,
                              Placement(low.offset[0] + sx * size * 0.7, 0, low.offset[2] + sz * size * 0.4))
    else:
        mesh.tube([(size * math.sin(t * 0.5), size * 0.2 * t, size * 0.3 * math.cos(t)) for t in range(8)],
                  size * 0.06, 12, at)
    return mesh


def _animate(gltf, node, start, end):
    """Moves a node there and back in two seconds."""
    times = gltf._floats([[0.0], [1.0], [2.0]], "SCALAR", bounds=True)
    places = gltf._floats([start, end, start], "VEC3")
    for accessor in (times, places):
        del gltf.root["bufferViews"][gltf.root["accessors"][accessor]["bufferView"]]["target"]
    animation = gltf.root.setdefault("animations", [{"name": "motion", "samplers": [], "channels": []}])[0]
    animation["samplers"].append({"input": times, "output": places, "interpolation": "LINEAR"})
    animation["channels"].append({"sampler": len(animation["samplers"]) - 1,
                                  "target": {"node": node, "path": "translation"}})


def _near(r, point, distance):
    return [c + r.uniform(-distance, distance) for c in point]


def _lights(gltf, r, half, height, inside):
    """Lamps; at least one that shines. Returns whether an environment should be added."""
    x, z = half
    kinds = r.sample(("point", "spot", "panel", "point"), r.choice((1, 1, 2, 3)))
    if not inside:
        kinds.append("sun")
    for i, kind in enumerate(kinds):
        color = [1.0, r.uniform(0.7, 1.0), r.uniform(0.4, 1.0)]
        at = [r.uniform(-0.7, 0.7) * x, r.uniform(0.5, 0.95) * height, r.uniform(-0.7, 0.7) * z]
        if kind == "sun":
            gltf.light(f"sun{i}", "directional", color, r.uniform(1, 4),
                       direction=(r.uniform(-0.8, 0.8), -1, r.uniform(-0.8, 0.8)))
        elif kind == "point":
            gltf.light(f"lamp{i}", "point", color, r.uniform(0.5, 4) * x * z, at)
        elif kind == "spot":
            outer = r.uniform(20, 70)
            gltf.light(f"spot{i}", "spot", color, r.uniform(2, 10) * x * z, at,
                       (r.uniform(-0.7, 0.7), -1, r.uniform(-0.7, 0.7)), (outer * 0.6, outer))
        else:
            strength = r.uniform(4, 30)
            gltf.material(f"glow{i}", (0.7, 0.7, 0.7), emission=[strength * c for c in color], double_sided=True)
            mesh, side = Mesh(), r.uniform(0.1, 0.4)
            mesh.quad((-side, 0, -side), (side, 0, -side), (side, 0, side), (-side, 0, side), at=Placement(*at))
            gltf.node(f"panel{i}", mesh=gltf.mesh(f"panel{i}", {f"glow{i}": mesh}))
            continue
        if kind != "sun" and r.random() < 0.5:
            _animate(gltf, len(gltf.root["nodes"]) - 1, at, _near(r, at, 0.4 * x))


def write(folder, number):
    """Writes scene `number` and returns its path and whether it is open to an environment."""
    r = random.Random(number)
    gltf, name = Gltf(), f"random_{number:04d}"
    half = (r.uniform(1.2, 3.0), r.uniform(1.2, 3.0))
    height = r.uniform(1.6, 3.2)
    layout = r.random()
    open_sides = ()
    if layout > 0.75:
        open_sides = ("ceiling", "left", "right", "back", "front")
    elif layout > 0.5:
        open_sides = r.sample(("ceiling", "left", "right", "back"), 2)
    materials = _materials(gltf, r, name, r.randint(3, 6))
    _room(gltf, r, materials, half, height, open_sides)
    for i in range(r.randint(3, 9)):
        size = r.uniform(0.2, 0.7)
        place = [r.uniform(-0.8, 0.8) * half[0], r.choice((0.3 * size, 0.5 * size, size)),
                 r.uniform(-0.8, 0.5) * half[1]]
        mesh = _object(r, size, Placement(*place, turn=r.uniform(0, 90)))
        gltf.node(f"object{i}", mesh=gltf.mesh(f"object{i}", {r.choice(materials): mesh}))
        if r.random() < 0.15:
            _animate(gltf, len(gltf.root["nodes"]) - 1, [0, 0, 0], _near(r, (0, 0.2, 0), 0.2))
    _lights(gltf, r, half, height, len(open_sides) < 2)
    position = [r.uniform(-0.6, 0.6) * half[0], r.uniform(0.4, 0.85) * height, r.uniform(0.6, 0.95) * half[1]]
    target = [r.uniform(-0.4, 0.4) * half[0], r.uniform(0.1, 0.6) * height, r.uniform(-0.6, 0.0) * half[1]]
    gltf.camera("Camera", position, target, r.uniform(35, 75))
    end = _near(r, position, 0.25)
    end[1] = max(0.2 * height, min(0.9 * height, end[1]))
    end[2] = min(end[2], 0.95 * half[1])
    _animate(gltf, len(gltf.root["nodes"]) - 1, position, end)
    gltf.save(pathlib.Path(folder), name)
    return pathlib.Path(folder) / f"{name}.gltf", len(open_sides) >= 2

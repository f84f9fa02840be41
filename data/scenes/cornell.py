"""Cornell boxes, 2 m wide: walls of two triangles, two blocks, one thing changed in each.

After C. M. Goral, K. E. Torrance, D. P. Greenberg, B. Battaile: Modeling the Interaction of Light
Between Diffuse Surfaces, SIGGRAPH 1984.
"""
from shapes import Mesh, Placement
from writer import Gltf


def _glass(gltf):
    """A ball of greenish glass, and a blue pane that leans on the tall block's corner."""
    gltf.material("glass", (1.0, 1.0, 1.0), roughness=0.0, transmission=1.0, thickness=0.76, ior=1.5,
                  attenuation=(1.5, (0.6, 0.95, 0.7)))
    ball = Mesh()
    ball.sphere(0.38, 64, Placement(0.42, 0.38, 0.32))
    gltf.node("ball", mesh=gltf.mesh("ball", {"glass": ball}))
    gltf.material("pane", (0.55, 0.75, 0.95), roughness=0.0, transmission=1.0, double_sided=True)
    pane = Mesh()
    pane.quad((-0.9, 0.0, 0.35), (-0.15, 0.0, 0.55), (-0.15, 0.9, 0.55), (-0.9, 0.9, 0.35))
    gltf.node("pane", mesh=gltf.mesh("pane", {"pane": pane}))


def _box(gltf, ceiling_shines, content):
    gltf.material("white", (0.73, 0.73, 0.73))
    gltf.material("red", (0.63, 0.06, 0.05))
    gltf.material("green", (0.15, 0.48, 0.09))
    ceiling = "white"
    if ceiling_shines:
        ceiling = "lamp"
        gltf.material("lamp", (0.73, 0.73, 0.73), emission=(1.0, 0.85, 0.65))
    walls = {"floor": ("white", (-1, 0, 1), (1, 0, 1), (1, 0, -1), (-1, 0, -1)),
             "ceiling": (ceiling, (-1, 2, -1), (1, 2, -1), (1, 2, 1), (-1, 2, 1)),
             "back": ("white", (-1, 0, -1), (1, 0, -1), (1, 2, -1), (-1, 2, -1)),
             "left": ("red", (-1, 0, 1), (-1, 0, -1), (-1, 2, -1), (-1, 2, 1)),
             "right": ("green", (1, 0, -1), (1, 0, 1), (1, 2, 1), (1, 2, -1))}
    for name, (material, *corners) in walls.items():
        mesh = Mesh()
        mesh.quad(*corners)
        gltf.node(name, mesh=gltf.mesh(name, {material: mesh}))

    tall = Mesh()
    tall.box((0.6, 1.2, 0.6), Placement(-0.33, 0.6, -0.3, 17))
    gltf.node("tall block", mesh=gltf.mesh("tall block", {"white": tall}))
    short = Mesh()
    if content == "glass":
        _glass(gltf)
    elif content == "glossy":
        gltf.material("copper", (0.955, 0.638, 0.538), roughness=0.25, metallic=1.0)
        short.sphere(0.38, 64, Placement(0.38, 0.38, 0.32))
        gltf.node("sphere", mesh=gltf.mesh("sphere", {"copper": short}))
    else:
        short.box((0.6, 0.6, 0.6), Placement(0.35, 0.3, 0.35, -17))
        gltf.node("short block", mesh=gltf.mesh("short block", {"white": short}))
    gltf.camera("Camera", (0, 1, 3.9), (0, 1, 0), 39)


def cornell(folder, name, light="point", content="blocks"):
    """`light`: point; lamp, below the ceiling; or ceiling, which shines itself."""
    gltf = Gltf()
    _box(gltf, light == "ceiling", content)
    if light == "lamp":
        gltf.material("lamp", (0.78, 0.78, 0.78), emission=(24.0, 18.5, 11.5))
        lamp = Mesh()
        lamp.quad((-0.25, 1.99, -0.22), (0.25, 1.99, -0.22), (0.25, 1.99, 0.22),
                  (-0.25, 1.99, 0.22))
        gltf.node("lamp", mesh=gltf.mesh("lamp", {"lamp": lamp}))
    elif light == "point":
        gltf.light("Lamp", "point", (1.0, 0.85, 0.65), 2.6, (0, 1.8, 0.1))
    gltf.save(folder, name)
    return gltf

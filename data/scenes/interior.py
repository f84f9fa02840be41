"""A living room at a low evening sun: 5.2 m wide, 4.8 m deep, 2.7 m high, one window.

Radiometric units of a consistent small scale (the sun gives 16 W/m^2), so that exposure 0 looks
right. Every lamp has a shade that is seen to emit and a punctual light where its bulb is.
"""
import furniture
import textures
from shapes import Mesh, Placement
from writer import Gltf, quaternion_turn

LEFT, RIGHT, BACK, FRONT, HEIGHT = -2.6, 2.6, -2.2, 2.6, 2.7
WALL = 0.2
WINDOW = {"z": (-0.85, 0.95), "y": (0.7, 2.3)}
WARM = (1.0, 0.76, 0.48)


def _materials(gltf):
    wood = gltf.texture("interior_wood.png", textures.wood())
    floor = gltf.texture("interior_floor.png", textures.floor())
    floor_roughness = gltf.texture("interior_floor_roughness.png", textures.floor_roughness())
    weave = gltf.texture("interior_weave_normal.png", textures.weave_normal())
    rug = gltf.texture("interior_rug.png", textures.rug())
    painting = gltf.texture("interior_painting.png", textures.painting())

    def cloth(name, color):
        gltf.material(name, color, roughness=0.95, normal_texture=weave, normal_scale=0.5)

    gltf.material("plaster", (0.80, 0.76, 0.69), roughness=0.95)
    gltf.material("accent plaster", (0.30, 0.40, 0.38), roughness=0.95)
    gltf.material("ceiling", (0.86, 0.85, 0.82), roughness=1.0)
    gltf.material("white paint", (0.84, 0.83, 0.80), roughness=0.35)
    gltf.material("floor", (1, 1, 1), texture=floor, roughness_texture=floor_roughness)
    gltf.material("oak", (0.95, 0.90, 0.82), roughness=0.45, texture=wood)
    gltf.material("oak top", (0.95, 0.90, 0.82), roughness=0.3, texture=wood)
    gltf.material("dark wood", (0.32, 0.24, 0.19), roughness=0.4, texture=wood)
    gltf.material("dark wood top", (0.34, 0.25, 0.20), roughness=0.22, texture=wood)
    cloth("linen", (0.62, 0.58, 0.50))
    cloth("cushion rust", (0.52, 0.17, 0.07))
    cloth("cushion teal", (0.06, 0.24, 0.26))
    gltf.material("curtain", (0.70, 0.62, 0.48), roughness=1.0, double_sided=True)
    gltf.material("rug", (1, 1, 1), roughness=1.0, texture=rug)
    gltf.material("fringe", (0.70, 0.63, 0.50), roughness=1.0, double_sided=True)
    gltf.material("leather", (0.30, 0.13, 0.06), roughness=0.5)
    gltf.material("brass", (0.91, 0.72, 0.38), roughness=0.24, metallic=1.0)
    gltf.material("black metal", (0.03, 0.03, 0.03), roughness=0.4)
    gltf.material("ceramic", (0.82, 0.81, 0.77), roughness=0.18)
    gltf.material("glaze", (0.05, 0.16, 0.30), roughness=0.12)
    gltf.material("orange", (0.85, 0.32, 0.03), roughness=0.45)
    gltf.material("stem", (0.25, 0.19, 0.08), roughness=0.9)
    gltf.material("blossom", (0.80, 0.52, 0.40), roughness=0.9)
    gltf.material("terracotta", (0.55, 0.24, 0.13), roughness=0.85)
    gltf.material("soil", (0.06, 0.04, 0.03), roughness=1.0)
    gltf.material("leaf", (0.08, 0.26, 0.07), roughness=0.4, double_sided=True)
    gltf.material("books", (1, 1, 1), roughness=0.7)
    gltf.material("painting", (1, 1, 1), roughness=0.5, texture=painting)
    gltf.material("paper", (0.82, 0.80, 0.74), roughness=0.9)
    gltf.material("shade", (0.80, 0.72, 0.58), roughness=0.9, emission=(1.5, 1.05, 0.6))
    gltf.material("bulb", (0.80, 0.80, 0.80), roughness=0.5, emission=(12.0, 9.6, 6.8))


def _span(mesh, x, y, z):
    """A box from intervals."""
    mesh.box((x[1] - x[0], y[1] - y[0], z[1] - z[0]),
             Placement((x[0] + x[1]) / 2, (y[0] + y[1]) / 2, (z[0] + z[1]) / 2))


def _shell(gltf):
    """Walls with thickness, so that no light leaks and shadow maps have a back."""
    outer_x, outer_z = (LEFT - WALL, RIGHT + WALL), (BACK - WALL, FRONT + WALL)
    ceiling = Mesh()
    _span(ceiling, outer_x, (HEIGHT, HEIGHT + WALL), outer_z)
    gltf.node("ceiling", mesh=gltf.mesh("ceiling", {"ceiling": ceiling}))

    slab, boards = Mesh(), Mesh()
    _span(slab, outer_x, (-WALL, -0.001), outer_z)
    boards.quad((LEFT, 0, FRONT), (RIGHT, 0, FRONT), (RIGHT, 0, BACK), (LEFT, 0, BACK),
                uv=((LEFT / 2, FRONT), (RIGHT / 2, FRONT), (RIGHT / 2, BACK), (LEFT / 2, BACK)))
    gltf.node("floor", mesh=gltf.mesh("floor", {"plaster": slab, "floor": boards}))

    walls, back, y = Mesh(), Mesh(), (0, HEIGHT)
    _span(back, outer_x, y, (BACK - WALL, BACK))
    _span(walls, outer_x, y, (FRONT, FRONT + WALL))
    _span(walls, (RIGHT, RIGHT + WALL), y, (BACK, FRONT))
    left = (LEFT - WALL, LEFT)
    _span(walls, left, y, (BACK, WINDOW["z"][0]))
    _span(walls, left, y, (WINDOW["z"][1], FRONT))
    _span(walls, left, (0, WINDOW["y"][0]), WINDOW["z"])
    _span(walls, left, (WINDOW["y"][1], HEIGHT), WINDOW["z"])
    gltf.node("walls", mesh=gltf.mesh("walls", {"plaster": walls, "accent plaster": back}))

    trim, skirting, thin = Mesh(), (0, 0.11), 0.015
    _span(trim, (LEFT, RIGHT), skirting, (BACK, BACK + thin))
    _span(trim, (LEFT, RIGHT), skirting, (FRONT - thin, FRONT))
    _span(trim, (LEFT, LEFT + thin), skirting, (BACK, FRONT))
    _span(trim, (RIGHT - thin, RIGHT), skirting, (BACK, FRONT))
    (z0, z1), (y0, y1) = WINDOW["z"], WINDOW["y"]
    middle, bar = (z0 + z1) / 2, 0.03
    frame = (LEFT - 0.14, LEFT - 0.08)
    _span(trim, (LEFT - 0.16, LEFT + 0.10), (y0 - 0.03, y0), (z0 - 0.06, z1 + 0.06))
    for z in ((z0, z0 + 2 * bar), (z1 - 2 * bar, z1), (middle - bar, middle + bar)):
        _span(trim, frame, WINDOW["y"], z)
    for y in ((y0, y0 + 2 * bar), (y1 - 2 * bar, y1), (1.72, 1.72 + bar)):
        _span(trim, frame, y, WINDOW["z"])
    gltf.node("trim", mesh=gltf.mesh("trim", {"white paint": trim}))


def _furnish(gltf):
    def place(name, parts, x, y, z, turn=0):
        gltf.node(name, (x, y, z), quaternion_turn(turn) if turn else None,
                  mesh=gltf.mesh(name, parts))
        return len(gltf.root["meshes"]) - 1

    place("sofa", furniture.sofa(), -0.85, 0, -1.66)
    place("bookshelf", furniture.bookshelf(), 1.5, 0, -2.03)
    place("rug", furniture.rug(2.4, 1.6), -0.7, 0, -0.25)
    place("coffee table", furniture.coffee_table(), -0.65, 0.012, -0.35)
    place("teapot", furniture.teapot(), -0.50, 0.432, -0.42, 150)
    place("book pile", furniture.book_pile(), -0.83, 0.432, -0.28, 25)
    place("pouf", furniture.pouf(), 0.62, 0, 0.02)
    place("dining table", furniture.dining_table(), -1.5, 0, 1.15)
    place("bowl of oranges", furniture.bowl_of_oranges(), -1.28, 0.755, 1.22)
    place("vase", furniture.vase(), -1.68, 0.755, 1.02)
    chair = place("chair", furniture.chair(), -0.83, 0, 0.80, -118)
    gltf.node("chair by the wall", (-1.75, 0, 1.95), quaternion_turn(172), mesh=chair)
    place("plant", furniture.plant(), -2.2, 0, -1.8, 40)
    place("painting", furniture.picture(1.15, 0.85), -0.85, 1.62, BACK + 0.001)
    place("floor lamp", furniture.floor_lamp(), 0.56, 0, -1.86)
    place("pendant", furniture.pendant(), -1.5, HEIGHT, 1.15)
    place("ceiling lamp", furniture.ceiling_lamp(), 0.5, HEIGHT, 0.7)
    curtain = place("curtain", furniture.curtain(0.5, 2.25, 4), LEFT + 0.13, 0.2, -1.08, 90)
    gltf.node("second curtain", (LEFT + 0.13, 0.2, 1.2), quaternion_turn(90), mesh=curtain)
    rod = {"black metal": Mesh()}
    rod["black metal"].tube([(0, 0, 0), (2.9, 0, 0)], 0.012)
    place("curtain rod", rod, LEFT + 0.13, 2.46, 1.5, 90)


def _light(gltf):
    gltf.light("Sun", "directional", (1.0, 0.84, 0.64), 16.0, direction=(0.76, -0.50, -0.33))
    gltf.light("Pendant bulb", "point", WARM, 3.0, (-1.5, HEIGHT - 0.98, 1.15))
    gltf.light("Floor lamp bulb", "point", WARM, 3.0, (0.56, 1.58, -1.86))
    gltf.light("Ceiling lamp bulb", "point", (1.0, 0.86, 0.68), 8.0, (0.5, HEIGHT - 0.42, 0.7))
    gltf.light("Picture light", "spot", WARM, 3.4, (-0.85, HEIGHT - 0.05, -1.25),
               direction=(0, -0.75, -0.66), cones=(12, 36))
    gltf.light("Shelf light", "spot", WARM, 3.4, (1.5, HEIGHT - 0.05, -1.2),
               direction=(0, -0.82, -0.57), cones=(15, 40))


def interior(folder):
    gltf = Gltf()
    _materials(gltf)
    _shell(gltf)
    _furnish(gltf)
    _light(gltf)
    gltf.camera("Room", (2.35, 1.5, 2.4), (-0.62, 0.98, -0.9), 47)
    gltf.camera("Window", (1.5, 1.35, 0.9), (-2.4, 1.0, 0.25), 52)
    gltf.camera("Table", (-0.35, 1.25, 2.2), (-1.5, 0.85, 1.1), 40)
    gltf.save(folder, "interior")
    return gltf

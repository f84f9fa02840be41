"""What scripts/figures measures of the tree of lights: the tables of W. Tatzgern 2020, "Stochastic
Substitute Trees for Real-Time Global Illumination", chapter 6, and flicker."""
import base64
import json
import pathlib
import struct
import statistics
import sys

DATA = pathlib.Path(__file__).resolve().parent.parent / "data/scenes"
COUNTS = [10000, 100000, 500000, 1000000]
NODES = {"substitute": ["light_tree.node=substitute"], "lightcut": ["light_tree.node=lightcut"],
         "substitute, root": ["light_tree.node=substitute", "light_tree.cut=0"],
         "lightcut, root": ["light_tree.node=lightcut", "light_tree.cut=0"],
         "vpl": ["light_tree.node=vpl"]}


def corner_lamp(bench):
    """Writes corner_lamp.gltf, a lamp that is turned into a corner: all light of the room has bounced there first."""
    sys.path.insert(0, str(DATA))
    from shapes import Mesh
    from writer import Gltf
    gltf = Gltf()
    gltf.material("white", (0.73, 0.73, 0.73))
    gltf.material("lamp", (0.73, 0.73, 0.73), emission=(20.0, 17.0, 13.0))
    room, lamp = Mesh(), Mesh()
    for corners in (((-1, 0, 1), (1, 0, 1), (1, 0, -1), (-1, 0, -1)),
                    ((-1, 2, -1), (1, 2, -1), (1, 2, 1), (-1, 2, 1)),
                    ((-1, 0, -1), (1, 0, -1), (1, 2, -1), (-1, 2, -1)),
                    ((-1, 0, 1), (-1, 0, -1), (-1, 2, -1), (-1, 2, 1)),
                    ((1, 0, -1), (1, 0, 1), (1, 2, 1), (1, 2, -1))):
        room.quad(*corners)
    lamp.quad((-0.5, 0.8, -0.9), (-0.9, 0.8, -0.5), (-0.9, 1.2, -0.5), (-0.5, 1.2, -0.9))
    # Its front looks along (-1, 0, -1); what it is mounted on keeps the room from its back.
    room.quad((-0.89, 0.8, -0.49), (-0.49, 0.8, -0.89), (-0.49, 1.2, -0.89), (-0.89, 1.2, -0.49))
    gltf.node("room", mesh=gltf.mesh("room", {"white": room}))
    gltf.node("lamp", mesh=gltf.mesh("lamp", {"lamp": lamp}))
    gltf.camera("Camera", (0, 1, 3.9), (0, 1, 0), 39)
    gltf.save(bench.work, "corner_lamp")


def moving_lamp(bench, frames):
    """`cornell_point`, whose lamp goes 20 cm to the side at 24 frames a second."""
    scene = json.loads((DATA / "cornell_point.gltf").read_text())
    scene["buffers"][0]["uri"] = str(DATA / scene["buffers"][0]["uri"])
    (bench.work / "cornell_point.bin").write_bytes((DATA / "cornell_point.bin").read_bytes())
    scene["buffers"][0]["uri"] = "cornell_point.bin"
    lamp = next(i for i, node in enumerate(scene["nodes"]) if node.get("name") == "Lamp")
    x, y, z = scene["nodes"][lamp]["translation"]
    end = (frames - 1) / 24
    data = struct.pack("<8f", 0, end, x, y, z, x + 0.2, y, z)
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    scene["buffers"].append({"uri": uri, "byteLength": len(data)})
    buffer, view = len(scene["buffers"]) - 1, len(scene["bufferViews"])
    scene["bufferViews"] += [{"buffer": buffer, "byteOffset": 0, "byteLength": 8},
                             {"buffer": buffer, "byteOffset": 8, "byteLength": 24}]
    first = len(scene["accessors"])
    scene["accessors"] += [
        {"bufferView": view, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0.0],
         "max": [struct.unpack("<f", data[4:8])[0]]},
        {"bufferView": view + 1, "componentType": 5126, "count": 2, "type": "VEC3"}]
    scene["animations"] = [{
        "samplers": [{"input": first, "output": first + 1, "interpolation": "LINEAR"}],
        "channels": [{"sampler": 0, "target": {"node": lamp, "path": "translation"}}]}]
    path = bench.work / "moving_lamp.gltf"
    path.write_text(json.dumps(scene))
    return path


def flicker(bench):
    """Rows of what changes wrongly from frame to frame, by the number of VPLs."""
    frames = 3 if bench.quick else 60
    scene = moving_lamp(bench, frames)
    rows = []
    for count in [10000] if bench.quick else COUNTS[:3]:
        row = [f"{count:,}"]
        for words in (["--raw"], [], ["--temporal"]):
            measured = bench.json("measure", scene, "-t", "substitute_tree", "-s", 1, "--seeds", 2,
                                  "-r", "48,48", "--frames", f"0-{frames - 1}",
                                  "--reference-samples", 8 if bench.quick else 64,
                                  "--cache", bench.work, "-D", f"cloud.count={count}", *words)
            path = measured["points"][0]["path"]
            row.append([path["difference"]["value"], path["relmse"]["value"]])
        rows.append(row)
    return rows


def one_frame(bench, scene, words, size, count, seeds):
    """Medians of milliseconds over the seeds, of VPLs, the tree and sampling; the last picture. On a busy machine they
    are processor time, spread over the passes as the clock's."""
    picture, found = bench.work / "picture.exr", []
    for seed in range(1, seeds + 1):
        defines = [f"-D{d}" for d in [*words, f"cloud.count={count}", "light_tree.samples=1",
                                      "specular_path.samples=0"]]  # the thesis has no such paths
        run = bench.json("render", scene.path, *scene.options, "-t", "substitute_tree", "-s", 1,
                         "--seed", seed, "-r", size, "-o", picture, *defines)
        times = {"reflective": 0.0, "vpl_cloud": 0.0, "light_tree": 0.0, "sample": 0.0}
        for p in run["passes"]:
            name = "sample" if p["name"] == "light_tree_sample" else p["name"]
            for stem in times:
                if name.startswith(stem):
                    times[stem] += p["milliseconds"]
        scale = bench.processors if bench.clock else 1.0
        found.append([scale * ms for ms in (times["reflective"] + times["vpl_cloud"],
                                            times["light_tree"], times["sample"])])
    return [statistics.median(column) for column in zip(*found)], picture


def thesis(bench):
    """Rows of tables 6.1, 6.2 and 6.3."""
    size, seeds = ("64,36", 1) if bench.quick else ("480,270", 1 if bench.clock else 3)
    tables = [], [], []
    corner_lamp(bench)
    for name in ("corner_lamp",) if bench.quick else ("cornell_point", "cornell_glossy", "corner_lamp",
                                                      "interior", "atrium", "atrium_sun"):
        scene = bench.scene(name)
        # The path tracer finds the lamp in the corner by chance.
        samples = 4 if bench.quick else 256 if name == "corner_lamp" else 32
        halves = bench.truth(name, "-r", size, "-s", samples)
        times = {}
        for words in NODES.values():  # so that no shader is compiled while passes are timed
            one_frame(bench, scene, words, "16,16", COUNTS[0], 1)
        for count in COUNTS[:2] if bench.quick else COUNTS:
            for node, words in NODES.items():
                if count != 100000 and node not in ("substitute", "lightcut"):
                    continue
                times[node, count], picture = one_frame(bench, scene, words, size, count, seeds)
                if count == 100000:
                    error = bench.json("compare", picture, *halves)
                    tables[0].append([scene.name, node, times[node, count][2],
                                      error["rmse_relative"], error["ssim"]])
        counts = sorted({count for _, count in times})
        tables[1].append([scene.name, [times["substitute", n][:2] for n in counts]])
        tables[2].append([scene.name, [(times["substitute", n][2], times["lightcut", n][2])
                                       for n in counts]])
    return tables

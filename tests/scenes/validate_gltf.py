"""A small validator: the rules of glTF 2.0 that a file of ours could break.

Names of findings are those of the Khronos glTF-Validator where it has one. Rules are cited by
section of the glTF 2.0.1 specification.
"""
import json
import math
import pathlib
import struct
import zlib

COMPONENTS = {5120: ("b", 1), 5121: ("B", 1), 5122: ("h", 2), 5123: ("H", 2), 5125: ("I", 4),
              5126: ("f", 4)}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
ATTRIBUTES = {"POSITION": ("VEC3", {5126}), "NORMAL": ("VEC3", {5126}), "TANGENT": ("VEC4", {5126}),
              "TEXCOORD_0": ("VEC2", {5121, 5123, 5126}),
              "COLOR_0": (("VEC3", "VEC4"), {5121, 5123, 5126})}
UNIT_TOLERANCE = 5e-4  # of the length of quaternions and normals, as glTF-Validator takes it


class Validator:
    def __init__(self, path):
        self.path = pathlib.Path(path)
        self.findings = []
        self.root = json.loads(self.path.read_text())
        self.buffers = [self._file(b["uri"]) for b in self.root.get("buffers", [])]

    def _file(self, uri):
        assert "/" not in uri and ":" not in uri, uri
        return (self.path.parent / uri).read_bytes()

    def say(self, code, where, text=""):
        self.findings.append(f"{code} {where} {text}".rstrip())

    def index(self, where, value, kind):
        """Whether `value` points into root[kind]."""
        if not (isinstance(value, int) and 0 <= value < len(self.root.get(kind, []))):
            self.say("UNRESOLVED_REFERENCE", where, f"{kind} {value}")
            return False
        return True

    def run(self):
        if self.root.get("asset", {}).get("version") != "2.0":
            self.say("UNKNOWN_ASSET_MAJOR_VERSION", "asset")
        self.check_buffers()
        self.values = [self.check_accessor(i, a)
                       for i, a in enumerate(self.root.get("accessors", []))]
        for i, mesh in enumerate(self.root.get("meshes", [])):
            for j, primitive in enumerate(mesh["primitives"]):
                self.check_primitive(f"meshes/{i}/primitives/{j}", primitive)
        self.check_materials()
        self.check_nodes()
        self.check_extensions()
        self.check_unused()
        return self.findings

    # --- 3.6 binary data -------------------------------------------------------------------------

    def check_buffers(self):
        for i, buffer in enumerate(self.root.get("buffers", [])):
            if buffer["byteLength"] != len(self.buffers[i]):
                self.say("BUFFER_BYTE_LENGTH_MISMATCH", f"buffers/{i}")
        for i, view in enumerate(self.root.get("bufferViews", [])):
            where = f"bufferViews/{i}"
            if self.index(where, view["buffer"], "buffers"):
                end = view.get("byteOffset", 0) + view["byteLength"]
                if view["byteLength"] < 1 or end > len(self.buffers[view["buffer"]]):
                    self.say("BUFFER_VIEW_TOO_LONG", where)
            if view.get("target") not in (None, 34962, 34963):
                self.say("VALUE_NOT_IN_LIST", where, "target")

    def check_accessor(self, i, accessor):
        """Returns the values as rows, or an empty list."""
        where = f"accessors/{i}"
        letter, size = COMPONENTS[accessor["componentType"]]
        width = WIDTHS[accessor["type"]]
        if not self.index(where, accessor.get("bufferView"), "bufferViews"):
            return []
        view = self.root["bufferViews"][accessor["bufferView"]]
        offset = accessor.get("byteOffset", 0)
        stride = view.get("byteStride", size * width)
        if (view.get("byteOffset", 0) + offset) % size or offset % size:
            self.say("ACCESSOR_TOTAL_OFFSET_ALIGNMENT", where)
        if view.get("target") == 34962 and (stride % 4 or (view.get("byteOffset", 0) + offset) % 4):
            self.say("MESH_PRIMITIVE_ACCESSOR_UNALIGNED", where)
        if accessor["count"] < 1:
            self.say("VALUE_NOT_IN_RANGE", where, "count")
        if offset + stride * (accessor["count"] - 1) + size * width > view["byteLength"]:
            self.say("ACCESSOR_TOO_LONG", where)
            return []
        data = self.buffers[view["buffer"]]
        start = view.get("byteOffset", 0) + offset
        rows = [struct.unpack_from(f"<{width}{letter}", data, start + stride * k)
                for k in range(accessor["count"])]
        if letter == "f" and not all(math.isfinite(c) for row in rows for c in row):
            self.say("ACCESSOR_INVALID_FLOAT", where)
        for key, pick in (("min", min), ("max", max)):
            if key in accessor and list(accessor[key]) != [pick(c) for c in zip(*rows)]:
                self.say(f"ACCESSOR_{key.upper()}_MISMATCH", where)
        return rows

    # --- 3.7 geometry ----------------------------------------------------------------------------

    def check_primitive(self, where, primitive):
        counts = set()
        for name, accessor in primitive["attributes"].items():
            if not self.index(where, accessor, "accessors"):
                continue
            definition = self.root["accessors"][accessor]
            kinds, components = ATTRIBUTES[name]
            kinds = kinds if isinstance(kinds, tuple) else (kinds,)
            if definition["type"] not in kinds or definition["componentType"] not in components:
                self.say("MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT", where, name)
            if definition["componentType"] != 5126 and not definition.get("normalized"):
                self.say("MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT", where, name)
            counts.add(definition["count"])
            if name == "POSITION" and not ("min" in definition and "max" in definition):
                self.say("MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS", where)
            if name == "NORMAL":
                for row in self.values[accessor]:
                    if abs(math.sqrt(sum(c * c for c in row)) - 1) > UNIT_TOLERANCE:
                        self.say("ACCESSOR_VECTOR3_NON_UNIT", where)
                        break
        if "POSITION" not in primitive["attributes"]:
            self.say("MESH_PRIMITIVE_NO_POSITION", where)
        if len(counts) != 1:
            self.say("MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT", where)
        self.index(where, primitive.get("material"), "materials")
        if self.index(where, primitive.get("indices"), "accessors"):
            definition = self.root["accessors"][primitive["indices"]]
            indices = [row[0] for row in self.values[primitive["indices"]]]
            restart = {5121: 255, 5123: 65535, 5125: 4294967295}[definition["componentType"]]
            if len(indices) % 3 or max(indices) >= min(counts) or max(indices) == restart:
                self.say("MESH_PRIMITIVE_INDICES_INVALID", where)
            self.check_facing(where, primitive, indices)

    def check_facing(self, where, primitive, indices):
        """Not a rule of glTF but ours: a triangle faces the way that its vertex normals point."""
        positions = self.values[primitive["attributes"]["POSITION"]]
        normals = self.values[primitive["attributes"]["NORMAL"]]
        against = 0
        for k in range(0, len(indices), 3):
            a, b, c = (positions[i] for i in indices[k:k + 3])
            u, v = [[q[i] - a[i] for i in range(3)] for q in (b, c)]
            n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
            mean = [sum(normals[i][axis] for i in indices[k:k + 3]) for axis in range(3)]
            if not any(n):
                self.say("MESH_PRIMITIVE_DEGENERATE_TRIANGLE", where, str(k // 3))
            against += sum(x * y for x, y in zip(n, mean)) < 0
        if against:
            self.say("NORMALS_AGAINST_WINDING", where, f"{against} triangles")

    # --- 3.8, 3.9 textures and materials ---------------------------------------------------------

    def check_materials(self):
        for i, image in enumerate(self.root.get("images", [])):
            check_png(self._file(image["uri"]), lambda text: self.say("IMAGE", image["uri"], text))
        for i, texture in enumerate(self.root.get("textures", [])):
            self.index(f"textures/{i}", texture["source"], "images")
            self.index(f"textures/{i}", texture["sampler"], "samplers")
        for i, material in enumerate(self.root.get("materials", [])):
            where = f"materials/{i}"
            pbr = material.get("pbrMetallicRoughness", {})
            factors = (pbr.get("baseColorFactor", []) + material.get("emissiveFactor", [])
                       + [pbr.get("metallicFactor", 1), pbr.get("roughnessFactor", 1)])
            if not all(0 <= factor <= 1 for factor in factors):
                self.say("VALUE_NOT_IN_RANGE", where)
            for holder in (pbr, material):
                for key, value in holder.items():
                    if key.endswith("Texture"):
                        self.index(where, value["index"], "textures")

    # --- 3.5, 3.10 nodes, cameras, lights --------------------------------------------------------

    def check_nodes(self):
        nodes = self.root.get("nodes", [])
        parents = [0] * len(nodes)
        for i, node in enumerate(nodes):
            where = f"nodes/{i}"
            for key, kind in (("mesh", "meshes"), ("camera", "cameras")):
                if key in node:
                    self.index(where, node[key], kind)
            for child in node.get("children", []):
                if self.index(where, child, "nodes"):
                    parents[child] += 1
            rotation = node.get("rotation", [0, 0, 0, 1])
            if abs(math.sqrt(sum(c * c for c in rotation)) - 1) > UNIT_TOLERANCE:
                self.say("ROTATION_NON_UNIT", where)
        for root in (n for scene in self.root["scenes"] for n in scene["nodes"]):
            if self.index("scenes", root, "nodes") and parents[root]:
                self.say("SCENE_NON_ROOT_NODE", f"nodes/{root}")
        if any(count > 1 for count in parents):
            self.say("NODE_PARENT_OVERRIDE", "nodes")
        for i, camera in enumerate(self.root.get("cameras", [])):
            lens = camera["perspective"]
            if not (0 < lens["yfov"] < math.pi and lens["znear"] > 0):
                self.say("VALUE_NOT_IN_RANGE", f"cameras/{i}")
        lights = self.root.get("extensions", {}).get("KHR_lights_punctual", {}).get("lights", [])
        for i, light in enumerate(lights):
            where = f"lights/{i}"
            if light["intensity"] < 0 or not all(0 <= c <= 1 for c in light["color"]):
                self.say("VALUE_NOT_IN_RANGE", where)
            if light["type"] == "spot":
                inner, outer = (light["spot"][k] for k in ("innerConeAngle", "outerConeAngle"))
                if not 0 <= inner < outer <= math.pi / 2:
                    self.say("KHR_LIGHTS_PUNCTUAL_LIGHT_SPOT_ANGLES", where)

    # --- 3.12 extensions -------------------------------------------------------------------------

    def check_extensions(self):
        found = set()

        def walk(value):
            if isinstance(value, dict):
                found.update(value.get("extensions", {}))
                for child in value.values():
                    walk(child)
            elif isinstance(value, list):
                for child in value:
                    walk(child)

        walk(self.root)
        used = set(self.root.get("extensionsUsed", []))
        for name in found - used:
            self.say("UNDECLARED_EXTENSION", name)
        for name in used - found:
            self.say("UNUSED_EXTENSION", name)

    def check_unused(self):
        text = json.dumps(self.root["nodes"])
        for i in range(len(self.root.get("meshes", []))):
            if f'"mesh": {i}' not in text:
                self.say("UNUSED_OBJECT", f"meshes/{i}")


def check_png(data, say):
    """Signature, checksums, and as many bytes as the header promises."""
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        return say("no PNG")
    at, compressed, header = 8, b"", None
    while at < len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        body = data[at + 8:at + 8 + length]
        if zlib.crc32(kind + body) != struct.unpack_from(">I", data, at + 8 + length)[0]:
            say(f"checksum of {kind.decode()}")
        if kind == b"IHDR":
            header = struct.unpack(">IIBBBBB", body)
        elif kind == b"IDAT":
            compressed += body
        at += 12 + length
    width, height, depth, color = header[:4]
    if len(zlib.decompress(compressed)) != height * (1 + width * {0: 1, 2: 3}[color] * depth // 8):
        say("size of the pixels")
    return None


def validate(path):
    return Validator(path).run()

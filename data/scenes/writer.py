"""Writes what the default scenes hold as glTF 2.0 and PNG, byte for byte the same every time."""
import json
import math
import struct
import zlib


def real(value):
    """Rounded so that the last bits of a mathematics library never show."""
    value = round(float(value), 6)
    return 0.0 if value == 0.0 else value


def single(value):
    return struct.unpack("<f", struct.pack("<f", real(value)))[0]


def png(width, height, channels, rows):
    """8-bit grey (1 channel) or RGB (3); `rows` are bytes from the top."""
    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data
                + struct.pack(">I", zlib.crc32(kind + data)))

    header = struct.pack(">IIBBBBB", width, height, 8, {1: 0, 3: 2}[channels], 0, 0, 0)
    filtered = b"".join(_sub_filter(row, channels) for row in rows)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
            + chunk(b"IDAT", zlib.compress(filtered, 9)) + chunk(b"IEND", b""))


def _sub_filter(row, channels):
    return b"\x01" + bytes((row[i] - (row[i - channels] if i >= channels else 0)) & 255
                           for i in range(len(row)))


def quaternion_towards(direction):
    """Turns -z, where lights and cameras look, to `direction`, keeping x level."""
    length = math.sqrt(sum(c * c for c in direction))
    x, y, z = (c / length for c in direction)
    yaw = math.atan2(-x, -z)
    pitch = math.asin(max(-1.0, min(1.0, y)))
    cy, sy = math.cos(yaw / 2), math.sin(yaw / 2)
    cp, sp = math.cos(pitch / 2), math.sin(pitch / 2)
    return [cy * sp, sy * cp, -sy * sp, cy * cp]


def quaternion_turn(degrees):
    """About y."""
    return [0.0, math.sin(math.radians(degrees) / 2), 0.0, math.cos(math.radians(degrees) / 2)]


class Gltf:
    def __init__(self):
        self.binary = bytearray()
        self.root = {
            "asset": {"version": "2.0", "generator": "Lightsheaf data/scenes/generate.py",
                      "copyright": "The Lightsheaf authors, MIT"},
            "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [], "materials": [],
            "accessors": [], "bufferViews": [], "buffers": [],
        }
        self.material_index = {}
        self.files = {}

    # --- contents --------------------------------------------------------------------------------

    def texture(self, name, data):
        """A PNG beside the .gltf; returns the texture's index."""
        self.files[name] = data
        self.root.setdefault("images", []).append({"uri": name, "mimeType": "image/png"})
        self.root.setdefault("samplers", [{"magFilter": 9729, "minFilter": 9987}])
        textures = self.root.setdefault("textures", [])
        textures.append({"source": len(self.root["images"]) - 1, "sampler": 0})
        return len(textures) - 1

    def material(self, name, color=(0.8, 0.8, 0.8), roughness=1.0, metallic=0.0, texture=None,
                 roughness_texture=None, normal_texture=None, normal_scale=1.0, emission=None,
                 double_sided=False, transmission=0.0, thickness=0.0, ior=1.5, attenuation=None):
        """`emission` is a radiance [W/(m^2 sr)]; `attenuation` a distance [m] and a colour."""
        pbr = {"baseColorFactor": [real(c) for c in color] + [1.0],
               "metallicFactor": real(metallic), "roughnessFactor": real(roughness)}
        material = {"name": name, "pbrMetallicRoughness": pbr}
        if texture is not None:
            pbr["baseColorTexture"] = {"index": texture}
        if roughness_texture is not None:
            pbr["metallicRoughnessTexture"] = {"index": roughness_texture}
        if normal_texture is not None:
            material["normalTexture"] = {"index": normal_texture, "scale": real(normal_scale)}
        if emission is not None:
            strength = max(emission)
            material["emissiveFactor"] = [real(c / strength) for c in emission]
            if strength != 1.0:
                self._extend(material, "emissive_strength", emissiveStrength=real(strength))
        if transmission > 0.0:
            self._extend(material, "transmission", transmissionFactor=real(transmission))
        if thickness > 0.0:
            distance, color = attenuation
            self._extend(material, "ior", ior=real(ior))
            self._extend(material, "volume", thicknessFactor=real(thickness),
                         attenuationDistance=real(distance),
                         attenuationColor=[real(c) for c in color])
        if double_sided:
            material["doubleSided"] = True
        self.material_index[name] = len(self.root["materials"])
        self.root["materials"].append(material)

    def _extend(self, material, name, **values):
        name = f"KHR_materials_{name}"
        material.setdefault("extensions", {})[name] = values
        self._use(name)

    def mesh(self, name, parts):
        """`parts`: material name -> Mesh. Returns the mesh's index."""
        primitives = []
        for material, part in parts.items():
            attributes = {
                "POSITION": self._floats(part.positions, "VEC3", bounds=True),
                "NORMAL": self._floats(part.normals, "VEC3"),
            }
            definition = self.root["materials"][self.material_index[material]]
            if any("Texture" in key for key in
                   list(definition) + list(definition["pbrMetallicRoughness"])):
                attributes["TEXCOORD_0"] = self._floats(part.uvs, "VEC2")
            if part.colors:
                assert len(part.colors) == len(part.positions)
                attributes["COLOR_0"] = self._colors(part.colors)
            primitives.append({"attributes": attributes, "indices": self._indices(part.indices),
                               "material": self.material_index[material]})
        self.root["meshes"].append({"name": name, "primitives": primitives})
        return len(self.root["meshes"]) - 1

    def node(self, name, translation=None, rotation=None, **content):
        node = {"name": name, **content}
        if translation is not None:
            node["translation"] = [real(c) for c in translation]
        if rotation is not None:
            # Rounding keeps the length within a float's precision of 1.
            node["rotation"] = [real(c) for c in rotation]
        self.root["nodes"].append(node)
        self.root["scenes"][0]["nodes"].append(len(self.root["nodes"]) - 1)

    def light(self, name, kind, color, intensity, position=None, direction=None, cones=None):
        """`intensity` [W/sr], directional [W/m^2]; `cones` inner and outer half angle, degrees."""
        light = {"name": name, "type": kind, "color": [real(c) for c in color],
                 "intensity": real(intensity)}
        if cones:
            light["spot"] = {"innerConeAngle": real(math.radians(cones[0])),
                             "outerConeAngle": real(math.radians(cones[1]))}
        self._use("KHR_lights_punctual")
        lights = self.root.setdefault("extensions", {}).setdefault(
            "KHR_lights_punctual", {"lights": []})["lights"]
        lights.append(light)
        self.node(name, position, quaternion_towards(direction) if direction else None,
                  extensions={"KHR_lights_punctual": {"light": len(lights) - 1}})

    def camera(self, name, position, target, fov_y):
        cameras = self.root.setdefault("cameras", [])
        cameras.append({"name": name, "type": "perspective",
                        "perspective": {"yfov": real(math.radians(fov_y)), "znear": 0.05}})
        self.node(name, position, quaternion_towards([t - p for t, p in zip(target, position)]),
                  camera=len(cameras) - 1)

    # --- buffers ---------------------------------------------------------------------------------

    def _use(self, extension):
        used = self.root.setdefault("extensionsUsed", [])
        if extension not in used:
            used.append(extension)

    def _accessor(self, data, component_type, kind, count, target, **more):
        self.binary += b"\0" * (-len(self.binary) % 4)
        self.root["bufferViews"].append({"buffer": 0, "byteOffset": len(self.binary),
                                         "byteLength": len(data), "target": target})
        self.binary += data
        self.root["accessors"].append({"bufferView": len(self.root["bufferViews"]) - 1,
                                       "componentType": component_type, "count": count,
                                       "type": kind, **more})
        return len(self.root["accessors"]) - 1

    def _floats(self, rows, kind, bounds=False):
        rows = [[single(c) for c in row] for row in rows]
        data = b"".join(struct.pack(f"<{len(row)}f", *row) for row in rows)
        more = {}
        if bounds:
            more = {"min": [min(c) for c in zip(*rows)], "max": [max(c) for c in zip(*rows)]}
        return self._accessor(data, 5126, kind, len(rows), 34962, **more)

    def _colors(self, rows):
        """Linear, as normalised bytes with alpha."""
        data = b"".join(struct.pack("<4B", *(int(c * 255 + 0.5) for c in row), 255)
                        for row in rows)
        return self._accessor(data, 5121, "VEC4", len(rows), 34962, normalized=True)

    def _indices(self, indices):
        if max(indices) < 65535:
            return self._accessor(struct.pack(f"<{len(indices)}H", *indices), 5123, "SCALAR",
                                  len(indices), 34963)
        return self._accessor(struct.pack(f"<{len(indices)}I", *indices), 5125, "SCALAR",
                              len(indices), 34963)

    # --- files -----------------------------------------------------------------------------------

    def save(self, folder, name):
        binary = bytes(self.binary) + b"\0" * (-len(self.binary) % 4)
        self.root["buffers"] = [{"uri": f"{name}.bin", "byteLength": len(binary)}]
        self.files[f"{name}.bin"] = binary
        self.files[f"{name}.gltf"] = (json.dumps(self.root, indent=1) + "\n").encode()
        for file, data in self.files.items():
            (folder / file).write_bytes(data)

    def triangles(self):
        """Of all placed meshes."""
        count = 0
        for node in self.root["nodes"]:
            if "mesh" in node:
                for primitive in self.root["meshes"][node["mesh"]]["primitives"]:
                    count += self.root["accessors"][primitive["indices"]]["count"] // 3
        return count

"""The default scenes keep the rules of glTF, and their generator still writes these very bytes."""
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

from validate_gltf import validate

SCENES = pathlib.Path(os.environ["LSF_SOURCE_ROOT"]) / "data/scenes"
NAMES = ("cornell_emissive", "cornell_glass", "cornell_glossy", "cornell_point", "interior")


def content(data):
    """The bytes, but of a PNG the filtered pixels: deflate may pack them in more ways than one."""
    if data[:4] != b"\x89PNG":
        return data
    parts, at = [], 8
    while at < len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        body = data[at + 8:at + 8 + length]
        parts.append(zlib.decompress(body) if kind == b"IDAT" else body)
        at += 12 + length
    return b"".join(parts)


class Scenes(unittest.TestCase):
    def test_valid(self):
        self.assertEqual(sorted(path.stem for path in SCENES.glob("*.gltf")), sorted(NAMES))
        for name in NAMES:
            with self.subTest(scene=name):
                self.assertEqual(validate(SCENES / f"{name}.gltf"), [])

    def test_generator_writes_the_same(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, "-B", SCENES / "generate.py", folder], check=True,
                           stdout=subprocess.DEVNULL)
            written = {path.name: path for path in pathlib.Path(folder).iterdir()}
            kept = {path.name: path for path in SCENES.iterdir()
                    if path.suffix in (".gltf", ".bin", ".png")}
            self.assertEqual(sorted(written), sorted(kept))
            differ = [name for name in kept
                      if content(written[name].read_bytes()) != content(kept[name].read_bytes())]
            self.assertEqual(differ, [])


if __name__ == "__main__":
    unittest.main()

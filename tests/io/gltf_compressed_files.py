"""Writes small glTF files whose meshes or textures are compressed.

usage: gltf_compressed_files.py FOLDER

FOLDER/cases.tsv is as gltf_files.py writes it.
"""
from gltf_writer import *

# The quad of gltf_writer.py with normals, texture coordinates and colours (attributes 0 to 3), as
# Draco 1.5.5 encodes it with 8 bits each.
DRACO = {'sequential': base64.b64decode(
    'RFJBQ08CAgEAAAACBAEAAQIAAgMBBAAJAwAAAQkDAAEDCQIAAgICBAEDAgMCAQABAQADAwEwARADADSCiAQAAAAA/wAA'
    'AAADAQEBgAEBOP/3AQgDAJiE/wAAAH8AAAAAAQEAAwMBIAEgAwAghIYCAAAAAP8AAAAAAQEAAwMBIAEgAwDwg2mAMQAA'
    'AAD/AAAAAAAAAAAAAAAAAAAAAACAPwgIAAAAAAAAAAAAAIA/CA=='), 'edgebreaker': base64.b64decode(
    'RFJBQ08CAgEBAAAABAIDAgAAAR//ARH/ARH/ARH/AREE/wAAAAAAAQAAAgAAAQAJAwAAAgEBCQMAAQMBAwkCAAICAQIC'
    'BAEDAQEBAQADAwEwARADACiCmAAAAAAA/wAAAAAAAAAAAAAAAAAAAAAAgD8IAAMBAQGAAQE4//cBCAMAmIT/AAAAfwAA'
    'AAgBAQEAAwMBIAEgAwDwg6YAAAAAAP8AAAAAAAAAAAAAAAAAgD8IAQEBAAMDATABEAMAJIIpMQIAAAAA/wAAAA==')}


def draco(name, expected, compressed=DRACO['edgebreaker'], triangles='', points=4, indices=6,
          attributes=None, change=None):
    file = File()
    view = file.view(compressed)
    for component, kind, count in [(FLOAT, 'VEC3', points), (FLOAT, 'VEC3', points),
                                   (FLOAT, 'VEC2', points), (UBYTE, 'VEC4', points),
                                   (USHORT, 'SCALAR', indices)]:
        file.json['accessors'].append({'componentType': component, 'type': kind, 'count': count,
                                       **({'normalized': True} if kind == 'VEC4' else {})})
    ids = {'POSITION': 0, 'NORMAL': 1, 'TEXCOORD_0': 2, 'COLOR_0': 3}
    file.json['meshes'][0]['primitives'] = [{
        'attributes': ids, 'indices': 4, 'material': 0,
        'extensions': {'KHR_draco_mesh_compression': {
            'bufferView': view, 'attributes': attributes or ids}}}]
    # A texture makes the coordinates needed.
    file.json['materials'] = [{'pbrMetallicRoughness': {'baseColorTexture': {'index': 0}}}]
    file.json.update(textures=[{'source': 0}], images=[{'uri': PIXEL}],
                     extensionsUsed=['KHR_draco_mesh_compression'],
                     extensionsRequired=['KHR_draco_mesh_compression'])
    if change:
        change(file)
    file.gltf(name)
    case(name, expected, triangles)
    return file


for method, compressed in DRACO.items():
    draco('draco_%s.gltf' % method, 'ok', compressed, 2)
    # Encoders leave out what has no area, and not all of them say so in the accessors.
    draco('draco_fewer_%s.gltf' % method, 'ok', compressed, 2, points=9, indices=30)
    draco('draco_more_points_%s.gltf' % method, '4 points', compressed, points=3)
    draco('draco_more_triangles_%s.gltf' % method, '2 triangles', compressed, indices=3)
    draco('draco_many_%s.gltf' % method, 'MEMORY_LIMIT', compressed, points=10**9, indices=3 * 10**9)
draco('draco.glb', 'ok', triangles=2).glb('draco.glb')
draco('draco_cut.gltf', 'COMPRESSED_DATA_INVALID', DRACO['edgebreaker'][:100])
draco('draco_magic.gltf', 'COMPRESSED_DATA_INVALID', b'PONY' + DRACO['edgebreaker'][4:])
draco('draco_points.gltf', 'no triangles', b'DRACO\2\3\0' + DRACO['edgebreaker'][8:])
draco('draco_missing.gltf', 'no attribute 7', attributes={'POSITION': 7})
draco('draco_width.gltf', '3 components', attributes={'TEXCOORD_0': 0})
draco('draco_strip.gltf', 'COMPRESSED_DATA_INVALID',
      change=lambda f: f.json['meshes'][0]['primitives'][0].update(mode=5))
draco('draco_reference.gltf', 'UNRESOLVED_REFERENCE', change=lambda f: f.json['meshes'][0][
    'primitives'][0]['extensions']['KHR_draco_mesh_compression'].update(bufferView=5))
draco('draco_unequal.gltf', 'MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT',
      change=lambda f: f.json['accessors'][1].update(count=3))


def twice(file, view):
    """The same accessors for another primitive, from the same compressed mesh or from another."""
    primitive = json.loads(json.dumps(file.json['meshes'][0]['primitives'][0]))
    primitive['extensions']['KHR_draco_mesh_compression']['bufferView'] = view
    file.json['meshes'][0]['primitives'].append(primitive)


draco('draco_shared.gltf', 'ok', triangles=4, change=lambda f: twice(f, 0))
draco('draco_conflict.gltf', 'belongs to another', change=lambda f: twice(
    f, f.view(DRACO['sequential'])))
# Who does not read the extension finds the same uncompressed.
file = quad()
file.json['meshes'][0]['primitives'][0]['extensions'] = {'KHR_draco_mesh_compression': {
    'bufferView': file.view(b'not Draco'), 'attributes': {'POSITION': 0}}}
file.json['extensionsUsed'] = ['KHR_draco_mesh_compression']
file.gltf('draco_fallback.gltf')
case('draco_fallback.gltf', 'ok', 2)
# Legal without any extension, too: all indices are 0.
changed('indices_without_view.gltf', 'ok', lambda f: f.json['accessors'][2].pop('bufferView'), 2)

# --- EXT_meshopt_compression and its successor, encoded as specified, without any compression -----


def zigzag(value):
    return 2 * value if value >= 0 else -2 * value - 1


def varint(value):
    return bytes([value]) if value < 128 else bytes([value & 127 | 128]) + varint(value >> 7)


def meshopt_attributes(content, stride):
    """Appendix A, mode 0: differences of bytes, in groups of 16 that are kept as they are."""
    elements = [content[i:i + stride] for i in range(0, len(content), stride)]
    block_size = min(8192 // stride & ~15, 256)
    result, previous = b'\xa0', elements[0]
    for first in range(0, len(elements), block_size):
        block = elements[first:first + block_size]
        groups = (len(block) + 15) // 16
        for byte in range(stride):
            values = [(b[byte] - a[byte]) & 255 for a, b in zip([previous] + block, block)]
            values = [zigzag(value - 256 if value > 127 else value) for value in values]
            result += b'\xff' * ((groups + 3) // 4)
            result += bytes(values + [0] * (-len(values) % 16))
        previous = block[-1]
    return result + elements[0].rjust(max(32, stride), b'\0')


def meshopt_triangles(indices):
    """Mode 1: each index as its difference from the one before."""
    result, last = b'\xe1' + b'\xff' * (len(indices) // 3), 0
    for i, index in enumerate(indices):
        result += (b'' if i % 3 else b'\xff') + varint(zigzag(index - last))
        last = index
    return result + bytes(16)


def meshopt_indices(indices):
    """Mode 2: the same, with one of the two baselines."""
    result, last = b'\xd1', 0
    for index in indices:
        result += varint(zigzag(index - last) << 1)
        last = index
    return result + bytes(4)


class CompressedFile(File):
    """Views become compressed ones of a second buffer that has no data."""

    def __init__(self):
        super().__init__()
        self.size = 0  # of the second buffer

    def compressed(self, content, stride, count, mode, filter=None, view=None, **more):
        inner = File.view(self, content)
        compressed = self.json['bufferViews'].pop(inner)
        extension = {'buffer': 0, 'byteOffset': compressed['byteOffset'],
                     'byteLength': len(content), 'byteStride': stride, 'count': count,
                     'mode': mode, **({'filter': filter} if filter else {}), **more}
        outer = {'buffer': 1, 'byteOffset': self.size, 'byteLength': stride * count,
                 'extensions': {self.extension: extension}, **(view or {})}
        if mode == 'ATTRIBUTES':
            outer['byteStride'] = stride
        self.size += stride * count
        self.json['bufferViews'].append(outer)
        return len(self.json['bufferViews']) - 1

    def document(self):
        document = super().document()
        document['buffers'] = [{'byteLength': len(self.data)}, {'byteLength': self.size}]
        if self.marked:
            document['buffers'][1]['extensions'] = {self.extension: {'fallback': True}}
        if self.fallback:
            document['buffers'][1]['uri'] = 'data:application/octet-stream;base64,' + \
                base64.b64encode(self.fallback).decode()
        return document

    def gltf(self, name):
        document = self.document()
        document['buffers'][0]['uri'] = ('data:application/octet-stream;base64,' +
                                         base64.b64encode(self.data).decode())
        write(name, json.dumps(document).encode())

    extension = 'EXT_meshopt_compression'
    fallback = None
    marked = True


# More than a block of 256 elements, so that several follow each other.
GRID = 20
POINTS = [(x, y, 3 * y % 7 - x) for y in range(GRID) for x in range(GRID)]
TRIANGLES = [i for y in range(GRID - 1) for x in range(GRID - 1)
             for i in (y * GRID + x, y * GRID + x + 1, y * GRID + x + GRID)]


def meshopt(name, expected, triangles='', mode='TRIANGLES', index_size=2, change=None, glb=False,
            encode=lambda content: content, extension='EXT_meshopt_compression', **more):
    """A grid: positions by exponents, normals as octahedra (all of them +x)."""
    file = CompressedFile()
    file.extension = extension
    positions = b''.join(struct.pack('<3i', *(v * 2 | -1 << 24 for v in p)) for p in POINTS)
    normals = bytes([127, 0, 127, 0]) * len(POINTS)
    encoders = {'TRIANGLES': meshopt_triangles, 'INDICES': meshopt_indices}
    views = [file.compressed(encode(meshopt_attributes(positions, 12)), 12, len(POINTS),
                             'ATTRIBUTES', 'EXPONENTIAL', **more),
             file.compressed(meshopt_attributes(normals, 4), 4, len(POINTS), 'ATTRIBUTES',
                             'OCTAHEDRAL'),
             file.compressed(encoders[mode](TRIANGLES), index_size, len(TRIANGLES), mode)]
    file.json['accessors'] = [
        {'bufferView': views[0], 'componentType': FLOAT, 'type': 'VEC3', 'count': len(POINTS)},
        {'bufferView': views[1], 'componentType': BYTE, 'type': 'VEC3', 'count': len(POINTS),
         'normalized': True},
        {'bufferView': views[2], 'componentType': USHORT if index_size == 2 else UINT,
         'type': 'SCALAR', 'count': len(TRIANGLES)}]
    file.json['meshes'][0]['primitives'] = [
        {'attributes': {'POSITION': 0, 'NORMAL': 1}, 'indices': 2}]
    file.json.update(extensionsUsed=[extension], extensionsRequired=[extension])
    if change:
        change(file)
    if glb:
        file.glb(name)
    else:
        file.gltf(name)
    case(name, expected, triangles)


WHOLE = len(TRIANGLES) // 3


def change_extension(**members):
    return lambda f: f.json['bufferViews'][0]['extensions']['EXT_meshopt_compression'].update(members)


meshopt('meshopt.gltf', 'ok', WHOLE)
meshopt('meshopt.glb', 'ok', WHOLE, glb=True)
meshopt('meshopt_u32.gltf', 'ok', WHOLE, index_size=4)
meshopt('meshopt_indices.gltf', 'ok', WHOLE, mode='INDICES')
meshopt('meshopt_khr.gltf', 'ok', WHOLE, extension='KHR_meshopt_compression')
meshopt('meshopt_unmarked.gltf', 'ok', WHOLE, change=lambda f: setattr(f, 'marked', False))
meshopt('meshopt_cut.gltf', 'COMPRESSED_DATA_INVALID', encode=lambda content: content[:-400])
meshopt('meshopt_version.gltf', 'COMPRESSED_DATA_INVALID',
        encode=lambda content: b'\xa1' + content[1:])
meshopt('meshopt_count.gltf', 'COMPRESSED_DATA_INVALID', change=change_extension(count=7))
meshopt('meshopt_stride.gltf', 'COMPRESSED_DATA_INVALID',
        change=change_extension(byteStride=6, count=800))
meshopt('meshopt_filter.gltf', 'COMPRESSED_DATA_INVALID', change=change_extension(filter='QUATERNION'))
meshopt('meshopt_triangles.gltf', 'COMPRESSED_DATA_INVALID',
        change=change_extension(mode='TRIANGLES', filter='NONE', byteStride=4, count=1200))
meshopt('meshopt_color.gltf', 'VALUE_NOT_IN_LIST', change=change_extension(filter='COLOR'))
meshopt('meshopt_mode.gltf', 'VALUE_NOT_IN_LIST', change=change_extension(mode='LINES'))
meshopt('meshopt_length.gltf', 'BUFFER_VIEW_TOO_LONG', change=change_extension(byteLength=10**6))
meshopt('meshopt_placeholder.gltf', 'BUFFER_VIEW_TOO_LONG', change=change_extension(buffer=1))
meshopt('meshopt_buffer.gltf', 'UNRESOLVED_REFERENCE', change=change_extension(buffer=2))
meshopt('meshopt_nothing.gltf', 'UNDEFINED_PROPERTY',
        change=lambda f: f.json['bufferViews'][0].pop('extensions'))
meshopt('meshopt_index.gltf', 'ACCESSOR_INDEX_OOB', change=lambda f: f.json['accessors'][0].update(
    count=300) or f.json['accessors'][1].update(count=300))


def huge(file):
    view = file.json['bufferViews'][0]
    file.size = view['byteLength'] = 256 * 2**30
    view['byteOffset'] = 0
    view['extensions']['EXT_meshopt_compression'].update(byteStride=256, count=2**30)


meshopt('meshopt_huge.gltf', 'MEMORY_LIMIT', change=huge)


def with_fallback(file):
    """The same data for those who do not read the extension; what is compressed is damaged."""
    file.json.pop('extensionsRequired')
    file.fallback = (b''.join(struct.pack('<3f', *p) for p in POINTS) +
                     bytes([127, 0, 0, 0]) * len(POINTS) + struct.pack('<%dH' % len(TRIANGLES), *TRIANGLES))
    file.data = bytearray(len(file.data))


meshopt('meshopt_fallback.gltf', 'ok', WHOLE, change=with_fallback)

# --- EXT_texture_webp ----------------------------------------------------------------------------

# 4 x 3 pixels, lossless.
WEBP = ('UklGRj4AAABXRUJQVlA4TDEAAAAvA4AAAF+goG0bhj9Xc2h3'
        'QAyFQCDFg4Xw/BchKiLuX0AQQKIQSyyzzDLLpBH9D0x3AA==')


def webp(name, expected, texture, image='data:image/webp;base64,' + WEBP, triangles='', note=''):
    changed(name, expected, lambda f: (
        f.json.update(images=[{'uri': PIXEL}, {'uri': image}], textures=[texture],
                      materials=[{'pbrMetallicRoughness': {'baseColorTexture': {'index': 0}}}],
                      extensionsUsed=['EXT_texture_webp']),
        f.json['meshes'][0]['primitives'][0].update(material=0)), triangles, note)


webp('webp.gltf', 'ok', {'source': 0, 'extensions': {'EXT_texture_webp': {'source': 1}}}, triangles=2)
webp('webp_alone.gltf', 'ok', {'extensions': {'EXT_texture_webp': {'source': 1}}}, triangles=2)
webp('webp_cut.gltf', 'IMAGE_DATA_INVALID', {'extensions': {'EXT_texture_webp': {'source': 1}}},
     'data:image/webp;base64,' + WEBP[:48])
webp('webp_source.gltf', 'UNRESOLVED_REFERENCE', {'extensions': {'EXT_texture_webp': {'source': 2}}})
webp('ktx2.gltf', 'leniently', {'source': 1},
     'data:image/ktx2;base64,' + base64.b64encode(b'\xabKTX 20\xbb\r\n\x1a\n' + bytes(80)).decode())
webp('basisu.gltf', 'ok', {'extensions': {'KHR_texture_basisu': {'source': 1}}}, triangles=2,
     note='without a PNG, JPEG or WebP image')

write_table()

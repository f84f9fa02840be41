"""Writes small glTF files, good and bad, and what is expected of each.

usage: gltf_files.py FOLDER

FOLDER/cases.tsv has a line for each file: name, "ok" or the finding that its error must name,
number of triangles, text that one note must hold.
"""
import base64
import json
import math
import os
import struct

from gltf_writer import *

# --- what must load ---------------------------------------------------------------------------

quad().glb('quad.glb')
case('quad.glb', 'ok', 2)
DOWN = [(0, 0, -1)] * 4
quad(normals=DOWN).gltf('normals_turned.gltf')
case('normals_turned.gltf', 'ok', 2, '4 normals on the back of all triangles around')
quad(normals=UP[:2] + [(0, -0.8, -0.6), (0, -1, 0)]).gltf('normals_bent.gltf')
case('normals_bent.gltf', 'ok', 2, '1 normal on the back of all triangles around')
quad(normals=None).gltf('flat.gltf')
case('flat.gltf', 'ok', 2, 'without normals')
for name, index_type in ('u8', UBYTE), ('u16', USHORT), ('u32', UINT):
    quad(index_type=index_type).gltf('indices_%s.gltf' % name)
    case('indices_%s.gltf' % name, 'ok', 2)
quad(indices=None, mode=5).gltf('strip.gltf')
case('strip.gltf', 'ok', 2)
quad(indices=None, mode=6).gltf('fan.gltf')
case('fan.gltf', 'ok', 2)
quad(indices=(0, 1, 3, 2), mode=5).gltf('strip_indexed.gltf')
case('strip_indexed.gltf', 'ok', 2)
quad(indices=None).gltf('trailing.gltf')
case('trailing.gltf', 'ok', 1, 'left over at the end')
for mode, (name, left_out) in enumerate((('points', 'of points, 6 in'), ('lines', 'of lines, 3 in'),
                                         ('line_loop', 'of lines, 6 in'),
                                         ('line_strip', 'of lines, 5 in'))):
    file = quad(mode=mode)
    file.primitive(normals=UP)
    file.gltf(name + '.gltf')
    case(name + '.gltf', 'ok', 2, '1 primitive ' + left_out)
changed('no_scenes.gltf', 'ok', lambda f: (f.json.pop('scenes'), f.json.pop('scene')), 2)
changed('other_scene.gltf', 'ok',
        lambda f: f.json.update(scenes=[{'nodes': [0]}, {'nodes': []}], scene=1), 0)
write('empty.gltf', b'{"asset": {"version": "2.0"}}')
case('empty.gltf', 'ok', 0)
changed('zero_scale.gltf', 'ok', lambda f: f.json['nodes'][0].update(scale=[0, 0, 0]), 2)
changed('mirrored.gltf', 'ok', lambda f: f.json['nodes'][0].update(scale=[-1, 1, 1]), 2)
changed('unused_extension.gltf', 'ok', lambda f: f.json.update(extensionsUsed=['EXT_nothing']), 2,
        'EXT_nothing')
changed('skinned.gltf', 'ok',
        lambda f: (f.json.update(skins=[{'joints': [0]}]), f.json['nodes'][0].update(skin=0)), 2,
        'without joints')
changed('morphed.gltf', 'ok',
        lambda f: f.json['meshes'][0]['primitives'][0].update(targets=[{'POSITION': 0}]), 2)
changed('blend.gltf', 'ok',
        lambda f: (f.json.update(materials=[{'alphaMode': 'BLEND'}]),
                   f.json['meshes'][0]['primitives'][0].update(material=0)), 2)
changed('rotation.gltf', 'ok', lambda f: f.json['nodes'][0].update(rotation=[0, 0, 0, 2]), 2,
        'a unit quaternion')
quad(normals=[(0, 0, 0), (0, 0, 3), (0, 0, 1), (0, 0, 1)]).gltf('normals.gltf')
case('normals.gltf', 'ok', 2, 'without length')
quad(normals=[(0, 0, 1), (math.nan, 0, 1), (0, 0, 1), (0, math.inf, 0)]).gltf('normals_nan.gltf')
case('normals_nan.gltf', 'ok', 2, '2 normals without length, or not a number')
file = quad()
file.json['nodes'] = [{'children': [1, 2]}, {'mesh': 0}, {'mesh': 0, 'translation': [3, 0, 0]}]
file.gltf('instances.gltf')
case('instances.gltf', 'ok', 4)
chain = 1000000
write('million_nodes.gltf', ('{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[' +
      ','.join('{"children":[%d]}' % (i + 1) for i in range(chain - 1)) + ',{}]}').encode())
case('million_nodes.gltf', 'ok', 0)

# --- 25: GLB ------------------------------------------------------------------------------------

good = json.dumps(quad().document()).encode()
binary = bytes(quad().data)
write('glb_length.glb', glb([(JSON, good), (BIN, binary)], length=0xffffffff))
case('glb_length.glb', 'GLB_LENGTH_MISMATCH')
write('glb_version.glb', glb([(JSON, good), (BIN, binary)], version=1))
case('glb_version.glb', 'GLB_INVALID_VERSION')
write('glb_magic.glb', glb([(JSON, good)], magic=b'glTG'))
case('glb_magic.glb', 'this is neither')
write('glb_order.glb', glb([(BIN, binary), (JSON, good)]))
case('glb_order.glb', 'GLB_UNEXPECTED_FIRST_CHUNK')
write('glb_two_json.glb', glb([(JSON, good), (JSON, good)]))
case('glb_two_json.glb', 'GLB_DUPLICATE_CHUNK')
write('glb_late_binary.glb', glb([(JSON, good), (0x41414141, b''), (BIN, binary)]))
case('glb_late_binary.glb', 'GLB_UNEXPECTED_BIN_CHUNK')
write('glb_chunk.glb', glb([(JSON, good, 0xfffffffc)]))
case('glb_chunk.glb', 'GLB_UNEXPECTED_END_OF_CHUNK_DATA')
# The padding of chunks may not be counted, or left out; in the binary chunk, too.
odd = good + b' ' * ((3 - len(good)) % 4)
uncounted = '%d GLB chunk%s of a length that is no multiple of 4'
write('glb_uncounted.glb', glb([(JSON, odd, len(odd)), (BIN, binary)]))
case('glb_uncounted.glb', 'ok', 2, uncounted % (1, ''))
write('glb_uncounted_binary.glb', glb([(JSON, odd, len(odd)), (BIN, binary + b'xyz', len(binary) + 3)]))
case('glb_uncounted_binary.glb', 'ok', 2, uncounted % (2, 's'))
chunks = [struct.pack('<II', len(content), kind) + content for kind, content in ((JSON, odd), (BIN, binary + b'x'))]
write('glb_unpadded.glb', b'glTF' + struct.pack('<II', 2, 12 + sum(map(len, chunks))) + b''.join(chunks))
case('glb_unpadded.glb', 'ok', 2, uncounted % (2, 's'))
write('glb_trailing.glb', glb([(JSON, good), (BIN, binary)]) + b'pad')
case('glb_trailing.glb', 'ok', 2, '3 bytes beyond the length that the GLB declares')
write('glb_no_json.glb', glb([(JSON, b'')]))
case('glb_no_json.glb', 'GLB_EMPTY_CHUNK')
write('glb_no_binary.glb', glb([(JSON, good)]))
case('glb_no_binary.glb', 'BUFFER_BYTE_LENGTH_MISMATCH')
write('glb_extra_chunk.glb', glb([(JSON, good), (BIN, binary), (0x41414141, b'more')]))
case('glb_extra_chunk.glb', 'ok', 2)

write('asset_array.gltf', b'{"asset":[]}')
case('asset_array.gltf', 'TYPE_MISMATCH at /asset')

# --- 26: depth ----------------------------------------------------------------------------------

write('nested.gltf', b'{"asset":{"version":"2.0"},"extras":' + b'[' * 20000 + b']' * 20000 + b'}')
case('nested.gltf', 'nested')
write('nested_open.gltf', b'[' * 20000)
case('nested_open.gltf', 'nested')
write('nested_objects.gltf', b'{"a":' * 20000)
case('nested_objects.gltf', 'nested')

# --- 27: nodes ----------------------------------------------------------------------------------

changed('node_self.gltf', 'NODE_LOOP', lambda f: f.json['nodes'].append({'children': [1]}))
changed('node_loop.gltf', 'NODE_LOOP',
        lambda f: f.json['nodes'].extend([{'children': [2]}, {'children': [3]}, {'children': [1]}]))
changed('node_parents.gltf', 'NODE_PARENT_OVERRIDE',
        lambda f: f.json['nodes'].extend([{'children': [3]}, {'children': [3]}, {}]))
for name, change in {
        'child': lambda f: f.json['nodes'][0].update(children=[7]),
        'child_negative': lambda f: f.json['nodes'][0].update(children=[-1]),
        'mesh': lambda f: f.json['nodes'][0].update(mesh=1),
        'mesh_big': lambda f: f.json['nodes'][0].update(mesh=2**32),
        'camera': lambda f: f.json['nodes'][0].update(camera=0),
        'scene': lambda f: f.json.update(scene=1),
        'scene_node': lambda f: f.json['scenes'][0].update(nodes=[1]),
        'material': lambda f: f.json['meshes'][0]['primitives'][0].update(material=0),
        'position': lambda f: f.json['meshes'][0]['primitives'][0]['attributes'].update(POSITION=9),
        'indices': lambda f: f.json['meshes'][0]['primitives'][0].update(indices=-2),
        'view': lambda f: f.json['accessors'][0].update(bufferView=99),
        'buffer': lambda f: f.json['bufferViews'][0].update(buffer=1),
        'light': lambda f: f.json['nodes'][0].update(
            extensions={'KHR_lights_punctual': {'light': 0}}),
}.items():
    changed('reference_%s.gltf' % name, 'UNRESOLVED_REFERENCE', change)
# A scene may not list children, but files of some exporters do.
child_note = ' of the scene with a parent'
changed('scene_child.gltf', 'ok', lambda f: f.json['nodes'].append(
    {'children': [0], 'translation': [5, 0, 0]}), 2, child_note)
changed('scene_family.gltf', 'ok', lambda f: (f.json['nodes'].append(
    {'children': [0], 'translation': [5, 0, 0]}), f.json['scenes'][0].update(nodes=[0, 1])), 2, child_note)
changed('scene_twice.gltf', 'DUPLICATE_ELEMENTS', lambda f: f.json['scenes'][0].update(nodes=[0, 0]))
changed('matrix_and_scale.gltf', 'NODE_MATRIX_TRS',
        lambda f: f.json['nodes'][0].update(matrix=[1, 0, 0, 0] * 4, scale=[1, 1, 1]))
changed('matrix_projective.gltf', 'NODE_MATRIX_NON_TRS', lambda f: f.json['nodes'][0].update(
    matrix=[1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]))
changed('overflow.gltf', 'use smaller scales', lambda f: f.json.update(
    nodes=[{'scale': [1e38] * 3, 'children': [i + 1]} for i in range(20)] + [{'mesh': 0}]))

# --- 28: accessors and views ---------------------------------------------------------------------

position, normal, index = 0, 1, 2
for name, expected, change in [
        ('count_0', 'VALUE_NOT_IN_RANGE', {'count': 0}),
        ('count_negative', 'VALUE_NOT_IN_RANGE', {'count': -1}),
        ('count_float', 'TYPE_MISMATCH', {'count': 4.5}),
        ('count_2e9', 'ACCESSOR_TOO_LONG', {'count': 2000000000}),
        ('count_one_more', 'ACCESSOR_TOO_LONG', {'count': 5}),
        ('offset_2_64', 'VALUE_NOT_IN_RANGE', {'byteOffset': 2**64 - 8}),
        ('offset_2_62', 'ACCESSOR_TOO_LONG', {'byteOffset': 2**62}),
        ('offset_end', 'ACCESSOR_TOO_LONG', {'byteOffset': 4}),
        ('offset_odd', 'ACCESSOR_TOO_LONG', {'byteOffset': 2}),
        ('component', 'VALUE_NOT_IN_LIST', {'componentType': 5124}),
        ('type', 'VALUE_NOT_IN_LIST', {'type': 'VEC5'}),
        ('format', 'MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT', {'type': 'VEC2'}),
]:
    changed('accessor_%s.gltf' % name, expected,
            lambda f: f.json['accessors'][position].update(change))
changed('accessor_zeros.gltf', 'MEMORY_LIMIT', lambda f: [
    (a.pop('bufferView', None), a.update(count=2000000000)) for a in f.json['accessors'][:2]])
changed('accessor_unequal.gltf', 'MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT',
        lambda f: f.json['accessors'][normal].update(count=3))
for name, expected, change in [
        ('stride_2', 'VALUE_NOT_IN_RANGE', {'byteStride': 2}),
        ('stride_256', 'VALUE_NOT_IN_RANGE', {'byteStride': 256}),
        ('stride_14', 'VALUE_NOT_IN_RANGE', {'byteStride': 14}),
        ('stride_8', 'ACCESSOR_SMALL_BYTESTRIDE', {'byteStride': 8}),
        ('stride_16', 'ACCESSOR_TOO_LONG', {'byteStride': 16}),
        ('length', 'BUFFER_VIEW_TOO_LONG', {'byteLength': 10**6}),
        ('length_0', 'ACCESSOR_TOO_LONG', {'byteLength': 0}),
        ('offset_2_63', 'BUFFER_VIEW_TOO_LONG', {'byteOffset': 2**63 - 1}),
]:
    changed('view_%s.gltf' % name, expected, lambda f: f.json['bufferViews'][position].update(change))

# Data that no accessor reads may be missing, and unaligned data are read.
changed('view_empty.gltf', 'ok', lambda f: f.json['bufferViews'].append(
    {'buffer': 0, 'byteOffset': 0, 'byteLength': 0}), 2)
file = quad()
file.json['buffers'] = [{'byteLength': len(file.data)}, {'byteLength': 0, 'uri': ''}, {'byteLength': 0},
                        {'byteLength': 9}]
file.json['bufferViews'].append({'buffer': 1, 'byteLength': 0})
file.glb('buffers_unread.glb')
case('buffers_unread.glb', 'ok', 2)
file = quad()
shifted = file.view(b'x' + bytes(file.data[:48]))
file.json['accessors'][position].update(bufferView=shifted, byteOffset=1)
file.gltf('accessor_unaligned.gltf')
case('accessor_unaligned.gltf', 'ok', 2, '1 accessor with data at an offset')
file = quad()
for accessor in file.json['accessors']:
    accessor.update((key, float(value)) for key, value in list(accessor.items()) if type(value) is int)
file.gltf('integers_with_points.gltf')
case('integers_with_points.gltf', 'ok', 2, 'written with a point where an integer is meant')

# --- 29: vertex indices ---------------------------------------------------------------------------

quad(indices=(0, 1, 4, 0, 2, 3)).gltf('index_oob.gltf')
case('index_oob.gltf', 'ACCESSOR_INDEX_OOB')
for name, index_type, value in (('u8', UBYTE, 255), ('u16', USHORT, 65535), ('u32', UINT, 2**32 - 1)):
    quad(indices=(0, 1, value), index_type=index_type).gltf('restart_%s.gltf' % name)
    case('restart_%s.gltf' % name, 'ACCESSOR_INDEX_PRIMITIVE_RESTART')
many = [QUAD[i % 4] for i in range(256)]  # the last one has index 255, which may restart a strip
for name, mode, expected in ('list', 4, 'ok'), ('strip', 5, 'ACCESSOR_INDEX_PRIMITIVE_RESTART'):
    file = File()
    file.primitive(many, (0, 1, 2, 0, 2, 255), UP * 64, UBYTE, mode=mode)
    file.gltf('restart_in_%s.gltf' % name)
    case('restart_in_%s.gltf' % name, expected, *([2, '1 corner of triangles'] if mode == 4 else []))
quad(index_type=FLOAT).gltf('index_float.gltf')
case('index_float.gltf', 'MESH_PRIMITIVE_INDICES_ACCESSOR_INVALID_FORMAT')

# --- 30: sparse -------------------------------------------------------------------------------------


def sparse(name, expected, indices, values=None, **more):
    file = quad()
    values = values if values is not None else [(5, 5, 5)] * len(indices)
    offset = more.get('offset', 0)
    index_view = file.view(b'x' * offset + b''.join(struct.pack('<H', i) for i in indices))
    value_view = file.view(b''.join(struct.pack('<3f', *v) for v in values))
    file.json['accessors'][position]['sparse'] = {
        'count': more.get('count', len(indices)),
        'indices': {'bufferView': more.get('index_view', index_view), 'byteOffset': offset, 'componentType': USHORT},
        'values': {'bufferView': value_view}}
    file.gltf(name)
    case(name, expected, 2 if expected == 'ok' else '', more.get('note', ''))


sparse('sparse.gltf', 'ok', [1, 3], [(2, 0, 0), (0, 2, 0)])
sparse('sparse_unaligned.gltf', 'ok', [1, 3], [(2, 0, 0), (0, 2, 0)], offset=1, note='1 accessor with data at an offset')
sparse('sparse_oob.gltf', 'ACCESSOR_SPARSE_INDEX_OOB', [1, 4])
sparse('sparse_unsorted.gltf', 'ACCESSOR_SPARSE_INDICES_NON_INCREASING', [2, 1])
sparse('sparse_twice.gltf', 'ACCESSOR_SPARSE_INDICES_NON_INCREASING', [1, 1])
sparse('sparse_count.gltf', 'ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE', [0, 1], count=5)
sparse('sparse_short.gltf', 'ACCESSOR_TOO_LONG', [0, 1, 2], [(0, 0, 0)])
sparse('sparse_view.gltf', 'UNRESOLVED_REFERENCE', [0], index_view=77)

# --- 31: data URIs -------------------------------------------------------------------------------------


def with_uri(name, expected, uri, **more):
    file = quad()
    file.json['buffers'] = [{'byteLength': more.get('length', len(file.data)), 'uri': uri}]
    file.gltf(name)
    case(name, expected, 2 if expected == 'ok' else '', more.get('note', ''))


encoded = base64.b64encode(bytes(quad().data)).decode()
prefix = 'data:application/octet-stream;base64,'
with_uri('data_gltf_buffer.gltf', 'ok', 'data:application/gltf-buffer;base64,' + encoded)
for name, media_type in (('type', 'model/gltf-buffer'), ('none', ''), ('charset', 'text/plain;charset=US-ASCII')):
    with_uri('data_%s.gltf' % name, 'ok', 'data:%s;base64,%s' % (media_type, encoded))
changed('data_image.gltf', 'INVALID_URI at /images/0/uri', lambda f: f.json.update(
    images=[{'uri': 'data:image/png;base64,`'}]))
with_uri('data_characters.gltf', 'INVALID_URI', prefix + '*' + encoded[1:])
with_uri('data_cut.gltf', 'BUFFER_BYTE_LENGTH_MISMATCH', prefix + encoded[:40])
with_uri('data_digits.gltf', 'INVALID_URI', prefix + encoded[:41])
with_uri('data_empty.gltf', 'BUFFER_BYTE_LENGTH_MISMATCH', prefix)
with_uri('data_plain.gltf', 'INVALID_URI', 'data:text/plain,hello')
with_uri('data_no_comma.gltf', 'INVALID_URI', 'data:application/octet-stream;base64')
with_uri('data_huge.gltf', 'ok', prefix + encoded.rstrip('=') + 'A' * (-len(encoded.rstrip('=')) % 4)
         + 'A' * 24000000, length=(len(encoded.rstrip('=')) + 3) // 4 * 3 + 18000000)

# --- 32, 33: paths ----------------------------------------------------------------------------------------

write('paths/inside/a b+c.bin', bytes(quad().data))
write('paths/outside.bin', bytes(quad().data))
inside = os.path.join(folder, 'paths/inside')
os.makedirs(os.path.join(inside, 'folder'), exist_ok=True)
for name, target in {'link_in.bin': 'a b+c.bin', 'link_out.bin': '../outside.bin',
                     'link_device.bin': '/dev/zero', 'link_folder': '..'}.items():
    os.symlink(target, os.path.join(inside, name))
os.mkfifo(os.path.join(inside, 'pipe.bin'))
for name, expected, uri in [
        ('spaces', 'ok', 'a b+c.bin'), ('escaped', 'ok', 'a%20b%2Bc.bin'),
        ('dot', 'ok', './a b+c.bin'), ('link_in', 'ok', 'link_in.bin'),
        ('up', 'leads out', '../outside.bin'), ('up_escaped', 'leads out', '%2e%2e/outside.bin'),
        ('up_later', 'leads out', 'folder/../../outside.bin'),
        ('up_back', 'leads out', '../inside/a b+c.bin'), ('up_only', 'leads out', '..'),
        ('absolute', 'leads out', os.path.abspath(os.path.join(inside, 'a b+c.bin'))),
        ('absolute_escaped', 'leads out', '%2fetc/passwd'),
        ('link_out', 'symbolic link', 'link_out.bin'),
        ('link_folder', 'symbolic link', 'link_folder/outside.bin'),
        ('link_device', 'symbolic link', 'link_device.bin'),
        ('file_scheme', 'INVALID_URI', 'file:///etc/passwd'),
        ('file_scheme_relative', 'INVALID_URI', 'FILE:a b+c.bin'),
        ('http', 'INVALID_URI', 'http://localhost/a.bin'), ('nul', 'INVALID_URI', 'a%00.bin'),
        ('half_escape', 'INVALID_URI', 'a%2'), ('missing', 'cannot be found', 'missing.bin'),
        ('pipe', 'named pipe', 'pipe.bin'), ('folder', 'directory', 'folder')]:
    with_uri('paths/inside/%s.gltf' % name, expected, uri)
with_uri('paths/inside/short.gltf', 'BUFFER_BYTE_LENGTH_MISMATCH', 'a b+c.bin', length=10**5)
os.mkfifo(os.path.join(folder, 'pipe.gltf'))
case('pipe.gltf', 'named pipe')
os.symlink('/dev/zero', os.path.join(folder, 'zero.gltf'))
case('zero.gltf', 'character device')
os.makedirs(os.path.join(folder, 'directory.gltf'))
case('directory.gltf', 'directory')
case('not there.gltf', 'cannot be read')

# --- 34: numbers --------------------------------------------------------------------------------------------

for name, value in ('nan', math.nan), ('infinity', math.inf):
    file = File()
    file.primitive(positions=QUAD[:3] + [(0, value, 0)], normals=UP, indices=(0, 1, 2))
    file.gltf('position_%s.gltf' % name)
    case('position_%s.gltf' % name, 'ACCESSOR_INVALID_FLOAT at /accessors/0')
for name, expected, text in [('1e999', 'INVALID_JSON at line 1, column', '1e999'),
                             ('1e39', 'VALUE_NOT_IN_RANGE at /nodes/0/translation/1', '1e39'),
                             ('minus_1e39', 'VALUE_NOT_IN_RANGE', '-1e39'),
                             ('nan', 'INVALID_JSON', 'NaN'), ('text', 'TYPE_MISMATCH', '"1"')]:
    write('number_%s.gltf' % name, ('{"asset":{"version":"2.0"},"nodes":[{"translation":[0,%s,0]}]}'
                                    % text).encode())
    case('number_%s.gltf' % name, expected)

# --- 38: required extensions -----------------------------------------------------------------------------------

for name in ('KHR_texture_basisu', 'EXT_texture_avif'):
    changed('required_%s.gltf' % name, name,
            lambda f: f.json.update(extensionsUsed=[name], extensionsRequired=[name]))
changed('required_quantization.gltf', 'ok', lambda f: f.json.update(
    extensionsUsed=['KHR_mesh_quantization'], extensionsRequired=['KHR_mesh_quantization']), 2)

# --- lights, cameras, animations -----------------------------------------------------------------------------------


def with_light(name, expected, light):
    changed(name, expected, lambda f: f.json.update(
        extensions={'KHR_lights_punctual': {'lights': [light]}},
        nodes=[{'mesh': 0, 'extensions': {'KHR_lights_punctual': {'light': 0}}}]),
        2 if expected == 'ok' else '')


with_light('spot.gltf', 'ok', {'type': 'spot', 'spot': {}})
with_light('spot_inner.gltf', 'KHR_LIGHTS_PUNCTUAL_LIGHT_SPOT_ANGLES',
           {'type': 'spot', 'spot': {'innerConeAngle': 0.8}})
with_light('spot_outer.gltf', 'KHR_LIGHTS_PUNCTUAL_LIGHT_SPOT_ANGLES',
           {'type': 'spot', 'spot': {'outerConeAngle': 1.6}})
with_light('spot_missing.gltf', 'UNDEFINED_PROPERTY', {'type': 'spot'})
with_light('light_type.gltf', 'VALUE_NOT_IN_LIST', {'type': 'area'})
with_light('light_negative.gltf', 'VALUE_NOT_IN_RANGE', {'type': 'point', 'intensity': -1})
with_light('light_overflow.gltf', 'VALUE_NOT_IN_RANGE',
           {'type': 'point', 'intensity': 3e38, 'color': [2, 1, 1]})
for name, expected, camera in [
        ('fov', 'VALUE_NOT_IN_RANGE', {'type': 'perspective', 'perspective': {'yfov': 0, 'znear': 1}}),
        ('far', 'CAMERA_ZFAR_LEQUAL_ZNEAR',
         {'type': 'perspective', 'perspective': {'yfov': 1, 'znear': 1, 'zfar': 0.5}}),
        ('mag', 'VALUE_NOT_IN_RANGE', {'type': 'orthographic', 'orthographic':
                                       {'xmag': 0, 'ymag': 1, 'znear': 0, 'zfar': 1}}),
        ('missing', 'UNDEFINED_PROPERTY', {'type': 'orthographic'})]:
    changed('camera_%s.gltf' % name, expected,
            lambda f: (f.json.update(cameras=[camera]), f.json['nodes'][0].update(camera=0)))
distant = {'camera': 0, 'translation': [0, 0, 1e12]}  # shows nothing; another one may
changed('camera_distant.gltf', 'ok',
        lambda f: (f.json.update(cameras=[{'type': 'perspective', 'perspective': {'yfov': 1, 'znear': 1}}]),
                   f.json['nodes'].append(distant), f.json['scenes'][0]['nodes'].append(1)), 2)


def animated(name, expected, times, values, note='', node=None, **more):
    file = quad()
    rotation = more.get('path') == 'rotation'
    sampler = {'input': file.accessor(times, FLOAT, 'SCALAR'),
               'output': file.accessor(values, FLOAT, 'VEC4' if rotation else 'VEC3'),
               'interpolation': more.get('interpolation', 'LINEAR')}
    file.json['nodes'][0].update(node or {})
    channel = {'sampler': 0, 'target': {'node': 0, 'path': more.get('path', 'translation')}}
    file.json['animations'] = [{'samplers': [sampler], 'channels': [channel] * more.get('repeat', 1)}]
    file.gltf(name)
    case(name, expected, 2 if expected == 'ok' else '', note)


HALF = math.sqrt(0.5)
animated('animated.gltf', 'ok', [1, 2], [(0, 0, 0), (4, 0, 0)])
animated('animated_step.gltf', 'ok', [1, 2], [(0, 0, 0), (4, 0, 0)], interpolation='STEP')
animated('animated_cubic.gltf', 'ok', [0, 2],
         [(0, 0, 0), (0, 0, 0), (1, 0, 0), (0, 0, 0), (4, 0, 0), (0, 0, 0)],
         interpolation='CUBICSPLINE')
animated('animated_turn.gltf', 'ok', [0, 1], [(0, 0, 0, 1), (0, 0, -HALF, -HALF)], path='rotation')
animated('animated_weights.gltf', 'ok', [0], [(0, 0, 0)], 'without morph targets', path='weights')
animated('animation_order.gltf', 'ACCESSOR_ANIMATION_INPUT_NON_INCREASING', [1, 1], [(0, 0, 0)] * 2)
animated('animation_negative.gltf', 'ACCESSOR_ANIMATION_INPUT_NEGATIVE', [-1, 1], [(0, 0, 0)] * 2)
animated('animation_count.gltf', 'ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_COUNT', [0, 1],
         [(0, 0, 0)] * 3)
animated('animation_nan.gltf', 'ACCESSOR_INVALID_FLOAT', [0, math.nan], [(0, 0, 0)] * 2)
animated('animation_matrix.gltf', 'ANIMATION_CHANNEL_TARGET_NODE_MATRIX', [0, 1], [(0, 0, 0)] * 2,
         node={'matrix': [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]})
animated('animation_twice.gltf', 'ANIMATION_DUPLICATE_TARGETS', [0, 1], [(0, 0, 0)] * 2, repeat=2)
changed('animation_sampler.gltf', 'UNRESOLVED_REFERENCE', lambda f: f.json.update(animations=[
    {'samplers': [], 'channels': [{'sampler': 0, 'target': {'node': 0, 'path': 'scale'}}]}]))

# --- materials --------------------------------------------------------------------------------------------------------

for name, expected, material in [
        ('ok', 'ok', {'emissiveFactor': [1, 0.5, 0], 'extensions': {
            'KHR_materials_emissive_strength': {'emissiveStrength': 10},
            'KHR_materials_ior': {'ior': 1.33}, 'KHR_materials_transmission': {'transmissionFactor': 1},
            'KHR_materials_volume': {'thicknessFactor': 0.1, 'attenuationDistance': 0.5,
                                     'attenuationColor': [1, 0.5, 0.25]},
            'KHR_materials_anisotropy': {'anisotropyStrength': 0.5},
            'KHR_materials_clearcoat': {'clearcoatFactor': 0.5, 'clearcoatRoughnessFactor': 0.25},
            'KHR_materials_sheen': {'sheenColorFactor': [0.5, 0.25, 1], 'sheenRoughnessFactor': 0.75},
            'KHR_materials_specular': {'specularFactor': 0.5, 'specularColorFactor': [1, 2, 0.25]}}}),
        ('five', 'ARRAY_LENGTH_NOT_IN_LIST', {'emissiveFactor': [1, 1, 1, 1, 1]}),
        ('sheen', 'VALUE_NOT_IN_RANGE', {'extensions': {'KHR_materials_sheen': {'sheenColorFactor': [0, 2, 0]}}}),
        ('clearcoat', 'VALUE_NOT_IN_RANGE', {'extensions': {'KHR_materials_clearcoat': {'clearcoatFactor': -1}}}),
        ('specular', 'VALUE_NOT_IN_RANGE', {'extensions': {'KHR_materials_specular': {'specularFactor': 2}}}),
        ('metallic', 'VALUE_NOT_IN_RANGE', {'pbrMetallicRoughness': {'metallicFactor': 1.5}}),
        ('color', 'ARRAY_LENGTH_NOT_IN_LIST', {'pbrMetallicRoughness': {'baseColorFactor': [1, 1, 1]}}),
        ('ior', 'VALUE_NOT_IN_RANGE', {'extensions': {'KHR_materials_ior': {'ior': 0.5}}}),
        ('attenuation', 'VALUE_NOT_IN_RANGE',
         {'extensions': {'KHR_materials_volume': {'attenuationDistance': 0}}}),
        ('thickness', 'UNRESOLVED_REFERENCE',
         {'extensions': {'KHR_materials_volume': {'thicknessTexture': {'index': 0}}}}),
        ('emission', 'VALUE_NOT_IN_RANGE', {'emissiveFactor': [1e30, 0, 0], 'extensions': {
            'KHR_materials_emissive_strength': {'emissiveStrength': 1e30}}}),
        ('integer', 'VALUE_NOT_IN_RANGE', {'extensions': {
            'KHR_materials_emissive_strength': {'emissiveStrength': 5000000000}}}),
        ('alpha', 'VALUE_NOT_IN_LIST', {'alphaMode': 'HASHED'}),
        ('texture', 'UNRESOLVED_REFERENCE', {'normalTexture': {'index': 0}})]:
    changed('material_%s.gltf' % name, expected,
            lambda f: (f.json.update(materials=[material]),
                       f.json['meshes'][0]['primitives'][0].update(material=0)),
            2 if expected == 'ok' else '')
changed('material_alpha_of_emission.gltf', 'ok', lambda f: (
    f.json.update(materials=[{'emissiveFactor': [1, 0.5, 0, 1]}]),
    f.json['meshes'][0]['primitives'][0].update(material=0)), 2, '1 emissive factor of four numbers')
for name, expected, image in [('missing', 'cannot be found', {'uri': 'none.png'}),
                              ('corrupt', 'IMAGE_DATA_INVALID',
                               {'uri': 'data:image/png;base64,iVBORw0KGgoAAAAN'}),
                              ('both', 'ONE_OF_MISMATCH', {'uri': 'none.png', 'bufferView': 0}),
                              ('up', 'leads out', {'uri': '../none.png'})]:
    changed('image_%s.gltf' % name, expected, lambda f: (
        f.json.update(images=[image], textures=[{'source': 0}],
                      materials=[{'pbrMetallicRoughness': {'baseColorTexture': {'index': 0}}}]),
        f.json['meshes'][0]['primitives'][0].update(material=0)))
changed('image_unused.gltf', 'ok', lambda f: f.json.update(
    images=[{'uri': 'none.png'}], textures=[{'source': 0}],
    materials=[{'pbrMetallicRoughness': {'baseColorTexture': {'index': 0}}}]), 2)

# --- values, checked one by one by the tests ----------------------------------------------------------------------------

file = File()
primitive = file.primitive(normals=None)
primitive['attributes'].update(
    POSITION=file.accessor([(0, 0, 0), (127, 0, 0), (127, 127, 0), (-128, 127, 0)], BYTE, 'VEC3',
                           pad=1, normalized=True),
    NORMAL=file.accessor([(0, 0, 127)] * 4, BYTE, 'VEC3', pad=1, normalized=True),
    COLOR_0=file.accessor([(65535, 1, 0), (0, 65535, 0), (0, 0, 32768), (7, 8, 9)], USHORT, 'VEC3',
                          pad=2, normalized=True))
file.gltf('normalized.gltf')
case('normalized.gltf', 'ok', 2)
file = File()
primitive = file.primitive(normals=UP)
primitive['attributes']['POSITION'] = file.accessor(
    [(0, 0, 0), (300, 0, 0), (300, 300, 0), (-32768, 300, 0)], SHORT, 'VEC3', pad=2)
file.gltf('quantized.gltf')
case('quantized.gltf', 'ok', 2)

# A quad whose texture is mirrored about its diagonal: two triangles, two handednesses.
file = File()
primitive = file.primitive(normals=UP, material=0)
primitive['attributes']['TEXCOORD_0'] = file.accessor([(0, 1), (1, 1), (1, 0), (1, 1)], FLOAT, 'VEC2')
file.json['materials'] = [{'extensions': {'KHR_materials_anisotropy': {'anisotropyStrength': 1}}}]
file.gltf('tangents.gltf')
case('tangents.gltf', 'ok', 2)

write_table()

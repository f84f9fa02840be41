"""Writes small glTF files that use extensions, or offer something to choose from.

usage: gltf_extension_files.py FOLDER

FOLDER/cases.tsv is as gltf_files.py writes it.
"""
import math

from gltf_writer import *

HALF = math.sqrt(0.5)

# --- scenes, animations, variants ---------------------------------------------------------------


def choices():
    """Two scenes, the second one the file's own, of a quad at x = 0 and at x = 10; animations that
    move the latter along y, z and y; a material and two variants of it."""
    file = quad(material=0)
    file.json.update(
        scene=1, scenes=[{'nodes': [0], 'name': 'left'}, {'nodes': [1], 'name': '0'}],
        nodes=[{'mesh': 0}, {'mesh': 0, 'translation': [10, 0, 0]}],
        extensionsUsed=['KHR_materials_variants', 'EXT_nothing'],
        extensions={'KHR_materials_variants': {'variants': [{'name': 'red'}, {'name': 'blue'}]}},
        materials=[{'name': name} for name in ('plain', 'rouge', 'bleu')])
    file.json['meshes'][0]['primitives'][0]['extensions'] = {'KHR_materials_variants': {
        'mappings': [{'variants': [0], 'material': 1}, {'variants': [0, 1], 'material': 2}]}}
    times = file.accessor([0, 1], FLOAT, 'SCALAR')
    file.json['animations'] = []
    for name, end in ('up', (10, 4, 0)), ('near', (10, 0, 8)), ('far', (10, -2, 0)):
        values = file.accessor([(10, 0, 0), end], FLOAT, 'VEC3')
        file.json['animations'].append({
            'name': name, 'samplers': [{'input': times, 'output': values}],
            'channels': [{'sampler': 0, 'target': {'node': 1, 'path': 'translation'}}]})
    return file


choices().gltf('choices.gltf')
case('choices.gltf', 'ok', 2, 'can be chosen')
file = choices()
file.json['meshes'][0]['primitives'][0]['extensions']['KHR_materials_variants']['mappings'][1][
    'variants'] = [2]
file.gltf('variant_mapping.gltf')
case('variant_mapping.gltf', 'UNRESOLVED_REFERENCE')
file = choices()
file.json['extensions'] = {'KHR_materials_variants': {'variants': [{}]}}
file.gltf('variant_name.gltf')
case('variant_name.gltf', 'UNDEFINED_PROPERTY')

# --- EXT_mesh_gpu_instancing --------------------------------------------------------------------


def instanced(name, expected, triangles='', node=None, **attributes):
    """`attributes`: values, component type and shape of each."""
    file = quad()
    accessors = {key: file.accessor(*value[:3], **dict(value[3:])) for key, value in attributes.items()}
    file.json['nodes'][0].update(node or {})
    file.json['nodes'][0]['extensions'] = {'EXT_mesh_gpu_instancing': {'attributes': accessors}}
    file.json.update(extensionsUsed=['EXT_mesh_gpu_instancing'],
                     extensionsRequired=['EXT_mesh_gpu_instancing'])
    file.gltf(name)
    case(name, expected, triangles)
    return file


instanced('instanced.gltf', 'ok', 6, node={'translation': [0, 0, 5]},
          TRANSLATION=([(0, 0, 0), (10, 0, 0), (0, 20, 0)], FLOAT, 'VEC3'),
          ROTATION=([(0, 0, 0, 127), (0, 0, 127, 0), (0, 0, 90, 90)], BYTE, 'VEC4',
                    ('normalized', True)),
          SCALE=([(1, 1, 1), (2, 2, 2), (1, 3, 1)], FLOAT, 'VEC3'), _ID=([1, 2, 3], FLOAT, 'SCALAR'))
instanced('instanced_scale.gltf', 'ok', 4, SCALE=([(1, 1, 1), (2, 2, 2)], FLOAT, 'VEC3'))
instanced('instanced_nothing.gltf', 'ok', 2)
instanced('instanced_unequal.gltf', 'MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT',
          TRANSLATION=([(0, 0, 0)] * 3, FLOAT, 'VEC3'), SCALE=([(1, 1, 1)] * 2, FLOAT, 'VEC3'))
instanced('instanced_format.gltf', 'MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT',
          TRANSLATION=([(0, 0, 0, 0)], FLOAT, 'VEC4'))
instanced('instanced_integer.gltf', 'MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT',
          ROTATION=([(0, 0, 0, 127)], BYTE, 'VEC4'))
instanced('instanced_nan.gltf', 'ACCESSOR_INVALID_FLOAT',
          TRANSLATION=([(0, math.nan, 0)], FLOAT, 'VEC3'))
for name, expected, change in [('reference', 'UNRESOLVED_REFERENCE', {'attributes': {'SCALE': 99}}),
                               ('missing', 'UNDEFINED_PROPERTY', {}),
                               ('type', 'TYPE_MISMATCH', {'attributes': {'SCALE': 'big'}})]:
    changed('instanced_%s.gltf' % name, expected,
            lambda f: f.json['nodes'][0].update(extensions={'EXT_mesh_gpu_instancing': change}))
# Legal, and of three hundred million instances without a byte behind them.
file = quad()
file.json['accessors'].append({'componentType': FLOAT, 'type': 'VEC3', 'count': 300000000})
file.json['nodes'][0]['extensions'] = {'EXT_mesh_gpu_instancing': {'attributes': {
    'TRANSLATION': len(file.json['accessors']) - 1}}}
file.gltf('instanced_many.gltf')
case('instanced_many.gltf', 'MEMORY_LIMIT')

# --- required extensions, ignored by --lenient --------------------------------------------------

for name in ('KHR_materials_nothing', 'KHR_techniques_webgl', 'EXT_nothing'):
    changed('require_%s.gltf' % name, name, lambda f: f.json.update(
        extensionsUsed=[name], extensionsRequired=[name]))

# --- what --lenient shows all the same ----------------------------------------------------------

for name, expected, material, more in [
        ('factors', 'VALUE_NOT_IN_RANGE at /materials/0/pbrMetallicRoughness/metallicFactor',
         {'metallicFactor': 1.5, 'roughnessFactor': -0.25}, {}),
        ('rounding', 'ok', {'baseColorFactor': [1.00000012, 0.5, -1e-9, 1]}, {}),
        ('absent', 'cannot be found', {'baseColorTexture': {'index': 0},
                                       'metallicRoughnessTexture': {'index': 1}},
         {'images': [{'uri': 'none.png'}], 'textures': [{'source': 0}, {'source': 0}]})]:
    changed('%s.gltf' % name, expected, lambda f: (
        f.json.update(materials=[{'pbrMetallicRoughness': material}], **more),
        f.json['meshes'][0]['primitives'][0].update(material=0)), 2 if expected == 'ok' else '')

# --- files of other formats ---------------------------------------------------------------------

for name, content, what in [
        ('model.obj', b'# vertices\nv 0 0 0\n', 'a Wavefront OBJ file'),
        ('ascii.fbx', b'; FBX 7.3.0 project file\n', 'an Autodesk FBX file'),
        ('renamed.gltf', b'Kaydara FBX Binary  \0\x1a\0', 'an Autodesk FBX file'),
        ('scene.usdz', b'PK\3\4', 'a USD file'), ('layer.usd', b'PXR-USDC', 'a USD file'),
        ('mesh.PLY', b'ply\nformat ascii 1.0\n', 'a PLY file'),
        ('solid.stl', b'solid\n', 'an STL file'), ('part.blend', b'BLENDER-v293', 'a Blender file'),
        ('collada.dae', b'\xef\xbb\xbf<?xml version="1.0"?>', 'a COLLADA file'),
        ('picture.glb', b'\x89PNG\r\n\x1a\n', 'a PNG picture'),
        ('page.glb', b'\n\n<!doctype HTML>', 'a web page'),
        ('pointer.glb', b'version https://git-lfs.github.com/spec/v1\n', 'git lfs pull')]:
    write('foreign/' + name, content)
    case('foreign/' + name, what)
quad().gltf('foreign/in_spite_of_its_name.obj')
case('foreign/in_spite_of_its_name.obj', 'ok', 2)
write('foreign/neither.txt', b'hello')
case('foreign/neither.txt', 'this is neither')
write('foreign/nothing.obj', b'')
case('foreign/nothing.obj', 'an empty file')

pointer = b'version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1000\n'
write('foreign/pointer.bin', pointer)
write('foreign/pointer.png', pointer)
changed('foreign/buffer_pointer.gltf', 'pointer.bin: is a pointer of Git LFS',
        lambda f: f.json.update(buffers=[{'uri': 'pointer.bin', 'byteLength': 1000}]))
changed('foreign/image_pointer.gltf', 'pointer.png: is a pointer of Git LFS', lambda f: (
    f.json.update(images=[{'uri': 'pointer.png'}], textures=[{'source': 0}],
                  materials=[{'pbrMetallicRoughness': {'baseColorTexture': {'index': 0}}}]),
    f.json['meshes'][0]['primitives'][0].update(material=0)))

# A file of glTF 1.0 keys its buffers by name, and may leave out its version.
for name, content in [('stated', b'{"asset": {"version": "1.0"}}'),
                      ('number', b'{"asset": {"version": 1}}'),
                      ('absent', b'{"buffers": {"box": {"byteLength": 0, "uri": "data:,"}}}')]:
    write('version_1_%s.gltf' % name, content)
    case('version_1_%s.gltf' % name, 'glTF version 1.0 is not supported')

# --- KHR_materials_pbrSpecularGlossiness ----------------------------------------------------------


def glossy(name, expected, extension, note='', **more):
    changed(name, expected, lambda f: (
        f.json.update(images=[{'uri': PIXEL}, {'uri': png(2, 1, [255, 128, 0, 255, 0, 64, 255, 64], 4)}],
                      textures=[{'source': 0}, {'source': 1}],
                      materials=[{'extensions': {'KHR_materials_pbrSpecularGlossiness': extension},
                                  'pbrMetallicRoughness': {'baseColorTexture': {'index': 0}}}],
                      extensionsUsed=['KHR_materials_pbrSpecularGlossiness'],
                      extensionsRequired=['KHR_materials_pbrSpecularGlossiness'], **more),
        f.json['meshes'][0]['primitives'][0].update(material=0)),
        2 if expected == 'ok' else '', note)


glossy('glossiness.gltf', 'ok', {'diffuseFactor': [0.5, 0.25, 0.125, 1], 'glossinessFactor': 0.75,
                                 'specularFactor': [0.25, 0.5, 1]})
glossy('glossiness_textured.gltf', 'ok', {'diffuseTexture': {'index': 0}, 'glossinessFactor': 0.5,
                                          'specularGlossinessTexture': {'index': 1, 'extensions': {
                                              'KHR_texture_transform': {'scale': [2, 3]}}}})
glossy('glossiness_opaque.gltf', 'ok', {'specularGlossinessTexture': {'index': 0}})
glossy('glossiness_range.gltf', 'VALUE_NOT_IN_RANGE', {'glossinessFactor': 2})
glossy('glossiness_reference.gltf', 'UNRESOLVED_REFERENCE', {'diffuseTexture': {'index': 2}})

write_table()

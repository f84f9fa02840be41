"""Writes small glTF files with skins and morph targets, and what is expected of each.

usage: gltf_deform_files.py FOLDER
"""
import math

from gltf_writer import *

HALF = math.sqrt(0.5)
IDENTITY = (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)
ONE_LOWER = (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1)

STRIP = [(x, y, 0) for y in range(3) for x in (-0.5, 0.5)]
JOINTS = [(0, 0, 0, 0)] * 2 + [(0, 1, 0, 0)] * 2 + [(1, 0, 0, 0)] * 2
WEIGHTS = [(1, 0, 0, 0)] * 2 + [(0.5, 0.5, 0, 0)] * 2 + [(1, 0, 0, 0)] * 2


def strip(joints=(JOINTS, UBYTE), weights=(WEIGHTS, FLOAT, {}), bind=(IDENTITY, ONE_LOWER),
          normals=True):
    """A strip along y from 0 to 2: its lower row follows joint 0, its upper one joint 1, which
    stands at y = 1, and the one between both. Its own node is far away."""
    file = File()
    attributes = file.primitive(STRIP, (0, 1, 3, 0, 3, 2, 2, 3, 5, 2, 5, 4),
                                [(0, 0, 1)] * 6 if normals else None)['attributes']
    if joints:
        attributes['JOINTS_0'] = file.accessor(joints[0], joints[1], 'VEC4')
    if weights:
        attributes['WEIGHTS_0'] = file.accessor(weights[0], weights[1], 'VEC4', **weights[2])
    skin = {'joints': [1, 2]}
    if bind:
        skin['inverseBindMatrices'] = file.accessor(bind, FLOAT, 'MAT4')
    file.json.update(skins=[skin], scenes=[{'nodes': [0, 1]}],
                     nodes=[{'mesh': 0, 'skin': 0, 'translation': [100, 0, 0]}, {'children': [2]},
                            {'translation': [0, 1, 0]}])
    return file


def bent(file):
    """A quarter of a turn about x, of joint 1, within a second."""
    sampler = {'input': file.accessor([0, 1], FLOAT, 'SCALAR'),
               'output': file.accessor([(0, 0, 0, 1), (HALF, 0, 0, HALF)], FLOAT, 'VEC4')}
    file.json['animations'] = [{'samplers': [sampler],
                                'channels': [{'sampler': 0,
                                              'target': {'node': 2, 'path': 'rotation'}}]}]
    return file


def skinned(name, expected, note='', change=None, **how):
    file = bent(strip(**how))
    if change:
        change(file.json)
    file.gltf(name)
    case(name, expected, 4 if expected == 'ok' else '', note)


def byte_weights(values):
    return ([tuple(round(255 * w) for w in v) for v in values], UBYTE, {'normalized': True})


skinned('strip.gltf', 'ok')
skinned('strip_flat.gltf', 'ok', 'without normals', normals=False)
skinned('strip_bytes.gltf', 'ok', weights=byte_weights(WEIGHTS), joints=(JOINTS, USHORT))
skinned('strip_scaled.gltf', 'ok', 'other than 1',
        weights=([tuple(3 * w for w in v) for v in WEIGHTS], FLOAT, {}))
skinned('strip_unweighted.gltf', 'ok', 'other than 1', weights=([(0, 0, 0, 0)] * 6, FLOAT, {}))
skinned('strip_unbound.gltf', 'ok', bind=None)
skinned('strip_mirrored.gltf', 'ok', change=lambda j: j['nodes'][1].update(scale=[-1, 1, 1]))
skinned('strip_twice.gltf', 'ok', change=lambda j: (
    j['nodes'].append({'mesh': 0, 'translation': [7, 0, 0]}), j['scenes'][0]['nodes'].append(3)))
cases[-1] = ('strip_twice.gltf', 'ok', '8', '')
skinned('strip_without_joints.gltf', 'ok', 'placed by the node', joints=None, weights=None)
skinned('joint_out_of_range.gltf', 'ACCESSOR_JOINTS_INDEX_OOB',
        joints=([(0, 0, 0, 0)] * 5 + [(2, 0, 0, 0)], UBYTE))
skinned('joints_float.gltf', 'MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT',
        joints=(JOINTS, FLOAT))
skinned('joints_short.gltf', 'MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT', joints=(JOINTS[1:], UBYTE))
skinned('weights_missing.gltf', 'MESH_PRIMITIVE_JOINTS_WEIGHTS_MISMATCH', weights=None)
skinned('weights_nan.gltf', 'ACCESSOR_INVALID_FLOAT',
        weights=([(math.nan, 0, 0, 0)] * 6, FLOAT, {}))
skinned('weights_negative.gltf', 'ACCESSOR_WEIGHTS_NEGATIVE',
        weights=([(2, -1, 0, 0)] * 6, FLOAT, {}))
skinned('weights_integer.gltf', 'MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT',
        weights=([(1, 0, 0, 0)] * 6, UBYTE, {}))
skinned('bind_few.gltf', 'INVALID_IBM_ACCESSOR_COUNT', bind=(IDENTITY,))
skinned('bind_nan.gltf', 'ACCESSOR_INVALID_FLOAT', bind=(IDENTITY, (math.nan,) * 16))
skinned('bind_vectors.gltf', 'SKIN_IBM_INVALID_FORMAT',
        change=lambda j: j['skins'][0].update(inverseBindMatrices=0))
skinned('skin_empty.gltf', 'EMPTY_ENTITY', change=lambda j: j['skins'][0].update(joints=[]))
skinned('skin_without_joints.gltf', 'UNDEFINED_PROPERTY',
        change=lambda j: j['skins'][0].pop('joints'))
skinned('skin_elsewhere.gltf', 'NODE_SKIN_NO_SCENE',
        change=lambda j: j.update(scenes=[{'nodes': [0]}, {'nodes': [1]}], animations=[]))
skinned('joint_no_node.gltf', 'UNRESOLVED_REFERENCE',
        change=lambda j: j['skins'][0].update(joints=[1, 9]))


# --- morph targets ------------------------------------------------------------------------------

def sparse(file, count, elements):
    indices = file.view(struct.pack('<%dH' % len(elements), *(at for at, _ in elements)))
    values = file.view(b''.join(struct.pack('<3f', *value) for _, value in elements))
    file.json['accessors'].append(
        {'componentType': FLOAT, 'count': count, 'type': 'VEC3',
         'sparse': {'count': len(elements), 'indices': {'bufferView': indices,
                                                        'componentType': USHORT},
                    'values': {'bufferView': values}}})
    return len(file.json['accessors']) - 1


def morphed(name, expected, note='', change=None, weights=(0, 1), count=4, triangles=2):
    """A quad: target 0 lifts its third corner by 1, target 1 shifts it along x by 2 and turns its
    normals to x."""
    file = quad()
    file.json['meshes'][0]['primitives'][0]['targets'] = [
        {'POSITION': sparse(file, count, [(2, (0, 0, 1))])},
        {'POSITION': file.accessor([(2, 0, 0)] * count, FLOAT, 'VEC3'),
         'NORMAL': file.accessor([(1, 0, -1)] * count, FLOAT, 'VEC3')}]
    file.json['meshes'][0]['weights'] = [0.25, 0.5]
    sampler = {'input': file.accessor([0, 1], FLOAT, 'SCALAR'),
               'output': file.accessor([0, 0, *weights], FLOAT, 'SCALAR')}
    channel = {'sampler': 0, 'target': {'node': 0, 'path': 'weights'}}
    file.json['animations'] = [{'samplers': [sampler], 'channels': [channel]}]
    if change:
        change(file.json)
    file.gltf(name)
    case(name, expected, triangles if expected == 'ok' else '', note)


morphed('morph.gltf', 'ok')
morphed('morph_still.gltf', 'ok', change=lambda j: j.pop('animations'))
morphed('morph_node.gltf', 'ok',
        change=lambda j: (j.pop('animations'), j['nodes'][0].update(weights=[1, 0])))
morphed('morph_short.gltf', 'MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT', count=3)
morphed('morph_weights.gltf', 'MESH_INVALID_WEIGHTS_COUNT',
        change=lambda j: j['meshes'][0].update(weights=[1]))
morphed('morph_node_weights.gltf', 'NODE_WEIGHTS_INVALID',
        change=lambda j: j['nodes'][0].update(weights=[1, 2, 3]))
morphed('morph_keys.gltf', 'ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_COUNT', weights=(0, 1, 1))
morphed('morph_unequal.gltf', 'ok', '1 primitive with fewer morph targets', change=lambda j: (
    j['meshes'][0]['primitives'].append(dict(j['meshes'][0]['primitives'][0])),
    j['meshes'][0]['primitives'][1].update(targets=j['meshes'][0]['primitives'][0]['targets'][:1])), triangles=4)
morphed('morph_nan.gltf', 'ACCESSOR_INVALID_FLOAT', weights=(0, math.nan))
morphed('morph_scalar.gltf', 'MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT',
        change=lambda j: j['meshes'][0]['primitives'][0]['targets'][0].update(POSITION=2))
write_table()

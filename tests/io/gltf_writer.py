"""What the scripts beside this one write glTF files with."""
import base64
import json
import os
import struct
import sys
import zlib

folder = sys.argv[1]
cases = []  # name, "ok" or the finding, number of triangles, text of a note

BYTE, UBYTE, SHORT, USHORT, UINT, FLOAT = 5120, 5121, 5122, 5123, 5125, 5126
FORMATS = {BYTE: 'b', UBYTE: 'B', SHORT: 'h', USHORT: 'H', UINT: 'I', FLOAT: 'f'}
WIDTHS = {'SCALAR': 1, 'VEC2': 2, 'VEC3': 3, 'VEC4': 4, 'MAT4': 16}

QUAD = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
UP = [(0, 0, 1)] * 4


class File:
    """A document with one buffer that accessors are appended to."""

    def __init__(self):
        self.data = bytearray()
        self.json = {'asset': {'version': '2.0'}, 'scene': 0, 'scenes': [{'nodes': [0]}],
                     'nodes': [{'mesh': 0}], 'meshes': [{'primitives': []}],
                     'buffers': [], 'bufferViews': [], 'accessors': []}

    def view(self, content, **more):
        while len(self.data) % 4:
            self.data.append(0)
        self.json['bufferViews'].append(
            {'buffer': 0, 'byteOffset': len(self.data), 'byteLength': len(content), **more})
        self.data += content
        return len(self.json['bufferViews']) - 1

    def accessor(self, values, component, kind, pad=0, **more):
        content = b''
        for value in values:
            value = value if isinstance(value, (tuple, list)) else (value,)
            assert len(value) == WIDTHS[kind]
            content += struct.pack('<%d%s' % (len(value), FORMATS[component]), *value) + bytes(pad)
        size = struct.calcsize(FORMATS[component]) * WIDTHS[kind]
        stride = {'byteStride': size + pad} if pad else {}
        self.json['accessors'].append({'bufferView': self.view(content, **stride),
                                       'componentType': component, 'count': len(values),
                                       'type': kind, **more})
        return len(self.json['accessors']) - 1

    def primitive(self, positions=QUAD, indices=(0, 1, 2, 0, 2, 3), normals=None,
                  index_type=USHORT, **more):
        attributes = {'POSITION': self.accessor(positions, FLOAT, 'VEC3')}
        if normals is not None:
            attributes['NORMAL'] = self.accessor(normals, FLOAT, 'VEC3')
        primitive = {'attributes': attributes, **more}
        if indices is not None:
            primitive['indices'] = self.accessor(indices, index_type, 'SCALAR')
        self.json['meshes'][0]['primitives'].append(primitive)
        return primitive

    def document(self):
        if 'buffers' in self.json and not self.json['buffers'] and self.data:
            self.json['buffers'] = [{'byteLength': len(self.data)}]
        document = {k: v for k, v in self.json.items() if v != []}
        return document

    def gltf(self, name, embed=True):
        document = self.document()
        for buffer in document.get('buffers', []):
            if 'uri' not in buffer and embed:
                buffer['uri'] = ('data:application/octet-stream;base64,' +
                                 base64.b64encode(self.data).decode())
        write(name, json.dumps(document).encode())

    def glb(self, name):
        write(name, glb([(JSON, json.dumps(self.document()).encode()), (BIN, bytes(self.data))]))


def png(width, height, texels, channels=3):
    """A PNG of 8 bits a channel, as a data URI."""
    rows = b''.join(b'\0' + bytes(texels[y * width * channels:(y + 1) * width * channels])
                    for y in range(height))
    content = b'\x89PNG\r\n\x1a\n'
    for kind, data in ((b'IHDR', struct.pack('>IIBBBBB', width, height, 8,
                                             {1: 0, 3: 2, 4: 6}[channels], 0, 0, 0)),
                       (b'IDAT', zlib.compress(rows)), (b'IEND', b'')):
        content += struct.pack('>I', len(data)) + kind + data
        content += struct.pack('>I', zlib.crc32(kind + data))
    return 'data:image/png;base64,' + base64.b64encode(content).decode()


PIXEL = png(1, 1, [255, 255, 255])

JSON, BIN = 0x4e4f534a, 0x004e4942


def glb(chunks, length=None, version=2, magic=b'glTF'):
    body = b''
    for kind, content, *declared in chunks:
        content += (b' ' if kind == JSON else b'\0') * (-len(content) % 4)
        body += struct.pack('<II', declared[0] if declared else len(content), kind) + content
    return magic + struct.pack('<II', version, 12 + len(body) if length is None else length) + body


def write(name, content):
    path = os.path.join(folder, name)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, 'wb') as file:
        file.write(content)


def case(name, expected, triangles='', note=''):
    cases.append((name, expected, str(triangles), note))


def quad(normals=UP, **more):
    file = File()
    file.primitive(normals=normals, **more)
    return file


def changed(name, expected, change, triangles='', note=''):
    """A quad whose document is changed before it is written."""
    file = quad()
    change(file)
    file.gltf(name)
    case(name, expected, triangles, note)


def write_table():
    """FOLDER/cases.tsv: a line for each file, as `case` was told."""
    with open(os.path.join(folder, 'cases.tsv'), 'w') as table:
        for line in cases:
            table.write('\t'.join(line) + '\n')

"""Models of furniture and rooms, written as binary glTF 2.0.

A Mesh is shapes by material. A Model is meshes placed by nodes: a mesh that is placed many times is stored once.
Metres, Y up. Standard library only, and the same bytes at every run.
"""
import json
import math
import struct

from shapes import Shape, cross, dot, length, sub, times, unit


class Mesh:
    def __init__(self, name, solid=True):
        self.name = name
        self.solid = solid  # closed all round; else a part of a room, or it has sheets on it
        self.parts = {}  # material -> Shape, in the order of first use

    def add(self, material, *shapes):
        self.parts.setdefault(material, Shape()).add(*shapes)
        return self


class Model:
    def __init__(self):
        self.materials = {}  # name -> glTF material
        self.images = []
        self.meshes = []
        self.nodes = []
        self.names = set()

    def material(self, name, colour=None, texture=None, two_sided=False, emissive=False):
        """`colour` is linear sRGB reflectance; `texture` a picture's path relative to the model (its texels times `colour`)."""
        colour = colour or (1.0, 1.0, 1.0)
        pbr = {'baseColorFactor': [round(c, 4) for c in colour] + [1.0], 'metallicFactor': 0.0, 'roughnessFactor': 1.0}
        if texture:
            if texture not in self.images:
                self.images.append(texture)
            pbr['baseColorTexture'] = {'index': self.images.index(texture)}
        self.materials[name] = {'name': name, 'pbrMetallicRoughness': pbr}
        if two_sided:
            self.materials[name]['doubleSided'] = True
        if emissive:
            self.materials[name]['emissiveFactor'] = [1.0, 1.0, 1.0]

    def place(self, mesh, name=None, at=(0.0, 0.0, 0.0), turn=0.0):
        """Places the mesh with its origin at `at`, turned about y by `turn` degrees."""
        name = name or mesh.name
        assert name not in self.names, name
        self.names.add(name)
        if mesh not in self.meshes:
            self.meshes.append(mesh)
        node = {'name': name, 'mesh': self.meshes.index(mesh)}
        if any(at):
            node['translation'] = [round(c, 5) for c in at]
        if turn:
            half = math.radians(turn) / 2
            node['rotation'] = [0.0, round(math.sin(half), 7), 0.0, round(math.cos(half), 7)]
        self.nodes.append(node)

    def triangles(self):
        each = [sum(len(s.triangles) for s in mesh.parts.values()) for mesh in self.meshes]
        return sum(each[node['mesh']] for node in self.nodes)

    def write(self, path, source):
        data = bytearray()
        views, accessors, meshes = [], [], []
        names = list(self.materials)

        def accessor(values, kind, component, code, target, bounds=False):
            while len(data) % 4:
                data.append(0)
            flat = [c for v in values for c in v] if kind != 'SCALAR' else values
            packed = struct.pack('<%d%s' % (len(flat), code), *flat)
            views.append({'buffer': 0, 'byteOffset': len(data), 'byteLength': len(packed), 'target': target})
            data.extend(packed)
            entry = {'bufferView': len(views) - 1, 'componentType': component, 'count': len(values), 'type': kind}
            if bounds:
                packed_back = list(struct.iter_unpack('<3f', packed))
                entry['min'] = [min(p[i] for p in packed_back) for i in range(3)]
                entry['max'] = [max(p[i] for p in packed_back) for i in range(3)]
            accessors.append(entry)
            return len(accessors) - 1

        for mesh in self.meshes:
            primitives = []
            for material, shape in mesh.parts.items():
                textured = 'baseColorTexture' in self.materials[material]['pbrMetallicRoughness']
                vertices, triangles = welded(shape, textured)
                attributes = {
                    'POSITION': accessor([v[0] for v in vertices], 'VEC3', 5126, 'f', 34962, True),
                    'NORMAL': accessor([v[1] for v in vertices], 'VEC3', 5126, 'f', 34962),
                }
                if textured:
                    attributes['TEXCOORD_0'] = accessor([v[2] for v in vertices], 'VEC2', 5126, 'f', 34962)
                short = len(vertices) < 65536
                indices = accessor(
                    [i for t in triangles for i in t], 'SCALAR', 5123 if short else 5125, 'H' if short else 'I', 34963
                )
                primitives.append({'attributes': attributes, 'indices': indices, 'material': names.index(material)})
            meshes.append({'name': mesh.name, 'primitives': primitives})
        while len(data) % 4:
            data.append(0)
        document = {
            'asset': {'version': '2.0', 'generator': source, 'copyright': 'MIT licence'},
            'scene': 0,
            'scenes': [{'nodes': list(range(len(self.nodes)))}],
            'nodes': self.nodes,
            'meshes': meshes,
            'materials': list(self.materials.values()),
            'accessors': accessors,
            'bufferViews': views,
            'buffers': [{'byteLength': len(data)}],
        }
        if self.images:
            document['images'] = [{'uri': path} for path in self.images]
            document['samplers'] = [{'magFilter': 9729, 'minFilter': 9987, 'wrapS': 10497, 'wrapT': 10497}]
            document['textures'] = [{'sampler': 0, 'source': i} for i in range(len(self.images))]
        text = json.dumps(document, separators=(',', ':')).encode()
        text += b' ' * (-len(text) % 4)
        with open(path, 'wb') as file:
            file.write(struct.pack('<4sII', b'glTF', 2, 12 + 8 + len(text) + 8 + len(data)))
            file.write(struct.pack('<I4s', len(text), b'JSON') + text)
            file.write(struct.pack('<I4s', len(data), b'BIN\0') + bytes(data))


def welded(shape, textured):
    """Vertices that agree in position, normal and uv become one."""
    index, vertices, triangles = {}, [], []
    remap = []
    for p, n, t in shape.vertices:
        n = unit(n)
        key = (
            tuple(round(c, 6) for c in p),
            tuple(round(c, 4) for c in n),
            tuple(round(c, 6) for c in t) if textured else None,
        )
        if key not in index:
            index[key] = len(vertices)
            vertices.append((tuple(round(c, 6) + 0.0 for c in p), n, t))
        remap.append(index[key])
    for a, b, c in shape.triangles:
        a, b, c = remap[a], remap[b], remap[c]
        if a != b and b != c and a != c:
            triangles.append((a, b, c))
    return vertices, triangles


def srgb(text):
    """'#rrggbb' -> linear sRGB."""

    def decode(c):
        return c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4

    return tuple(decode(int(text[i : i + 2], 16) / 255) for i in (1, 3, 5))


def report(model):
    """What is wrong with the meshes: degenerate triangles, normals against their faces, open edges of what should be solid."""
    faults = []
    for mesh in model.meshes:
        edges, volume = {}, 0.0
        for material, shape in mesh.parts.items():
            for p, n, _ in shape.vertices:
                if not all(math.isfinite(c) for c in p + tuple(n)) or abs(length(n) - 1) > 1e-5:
                    faults.append('%s, %s: vertex %s normal %s' % (mesh.name, material, p, n))
            for triangle in shape.triangles:
                a, b, c = (shape.vertices[i][0] for i in triangle)
                face = cross(sub(b, a), sub(c, a))
                volume += dot(a, cross(b, c)) / 6
                if length(face) < 1e-9:
                    faults.append('%s, %s: degenerate triangle at %s' % (mesh.name, material, a))
                    continue
                if any(dot(unit(face), shape.vertices[i][1]) < 0.2 for i in triangle):
                    faults.append('%s, %s: normal against its face at %s' % (mesh.name, material, a))
                if not model.materials[material].get('doubleSided', False):
                    keys = [tuple(round(x, 5) + 0.0 for x in p) for p in (a, b, c)]
                    for u, v in zip(keys, keys[1:] + keys[:1]):
                        edges[u, v] = edges.get((u, v), 0) + 1
        open_edges = sum(1 for (u, v), count in edges.items() if edges.get((v, u), 0) != count)
        if open_edges and mesh.solid:
            faults.append('%s: %d open edges' % (mesh.name, open_edges))
        if mesh.solid and volume <= 0:
            faults.append('%s: inside out' % mesh.name)
    return faults

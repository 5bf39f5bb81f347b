# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangle meshes: PLY as meshSurface writes it."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

_TYPES = {
    "char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1", "short": "i2", "int16": "i2", "ushort": "u2", "uint16": "u2",
    "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4", "float": "f4", "float32": "f4", "double": "f8", "float64": "f8",
}


@dataclass
class Mesh:
    """vertices (n, 3) in m, triangles (m, 3) of numbers of vertices, and normals (n, 3) or None."""

    vertices: np.ndarray
    triangles: np.ndarray
    normals: np.ndarray = None

    def volume(self):
        """Inside, of a closed mesh that looks outward; m3."""
        a, b, c = (self.vertices[self.triangles[:, k]] - self.vertices.mean(axis=0) for k in range(3))
        return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)

    def area(self):
        a, b, c = (self.vertices[self.triangles[:, k]] for k in range(3))
        return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)


def read_ply(path):
    """The Mesh of a binary PLY file of triangles. ValueError where it is none."""
    path = Path(path)
    data = path.read_bytes()
    end = data.find(b"end_header\n")
    if not data.startswith(b"ply") or end < 0:
        raise ValueError(f"{path}: no header; expected: ply ... end_header")
    order, elements = None, {}
    for line in data[:end].decode().splitlines():
        words = line.split()
        if words[:1] == ["format"]:
            order = {"binary_little_endian": "<", "binary_big_endian": ">"}.get(words[1])
            if order is None:
                raise ValueError(f"{path}: format {words[1]}; expected: binary_little_endian or binary_big_endian")
        elif words[:1] == ["element"]:
            elements[words[1]] = (int(words[2]), [])
            last = words[1]
        elif words[:1] == ["property"]:
            elements[last][1].append(words[1:])
    if list(elements) != ["vertex", "face"] or len(elements["face"][1]) != 1:
        raise ValueError(f"{path}: elements {', '.join(elements)}; expected: vertex, and face with a list alone")
    count, properties = elements["vertex"]
    vertex = np.dtype([(name, order + _TYPES[kind]) for kind, name in properties])
    points = np.frombuffer(data, vertex, count, end + len(b"end_header\n"))
    count, ((_, length, index, _),) = elements["face"]
    face = np.dtype([("n", order + _TYPES[length]), ("v", order + _TYPES[index], 3)])
    begin = end + len(b"end_header\n") + points.nbytes
    if len(data) != begin + count * face.itemsize:
        raise ValueError(f"{path}: {len(data) - begin} bytes of faces; expected: {count} triangles of {face.itemsize}")
    faces = np.frombuffer(data, face, count, begin)
    if (faces["n"] != 3).any():
        raise ValueError(f"{path}: a face has no three corners; expected: triangles")
    columns = lambda names: np.stack([points[name].astype(float) for name in names], axis=1)
    return Mesh(columns("xyz"), faces["v"].astype(np.int64), columns(("nx", "ny", "nz")) if "nx" in vertex.names else None)

"""A triangle mesh that grows, moves, and is written as binary PLY."""
import array
import math
import sys

AXES = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}


class Mesh:
    """Positions are rounded to float32; with `smooth`, vertices get the mean normal of
    their triangles, weighted by area."""

    def __init__(self, smooth=False):
        self.points = array.array("f")
        self.triangles = array.array("i")
        self.smooth = smooth

    def count(self):
        return len(self.triangles) // 3

    def point(self, x, y, z):
        self.points.extend((x, y, z))
        return len(self.points) // 3 - 1

    def triangle(self, a, b, c):
        self.triangles.extend((a, b, c))

    def quad(self, a, b, c, d):
        self.triangle(a, b, c)
        self.triangle(a, c, d)

    def grid(self, rows, columns, at):
        """A sheet of rows x columns quads; at(i, j) is the point of corner (i, j)."""
        first = len(self.points) // 3
        for i in range(rows + 1):
            for j in range(columns + 1):
                self.point(*at(i, j))
        for i in range(rows):
            for j in range(columns):
                a = first + i * (columns + 1) + j
                d = a + columns + 1
                self.quad(a, a + 1, d + 1, d)

    def add(self, other):
        first = len(self.points) // 3
        self.points.extend(other.points)
        self.triangles.extend(first + i for i in other.triangles)
        return self

    def move(self, *by):
        for axis, distance in enumerate(by):
            if distance:
                self.points[axis::3] = array.array(
                    "f", [p + distance for p in self.points[axis::3]])
        return self

    def scale(self, *by):
        for axis, factor in enumerate(by):
            self.points[axis::3] = array.array(
                "f", [p * factor for p in self.points[axis::3]])
        return self

    def turn(self, axis, degrees):
        """About an axis through the origin, counterclockwise as seen from its tip."""
        i, j = AXES[axis]
        c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        u, v = self.points[i::3], self.points[j::3]
        self.points[i::3] = array.array("f", [c * a - s * b for a, b in zip(u, v)])
        self.points[j::3] = array.array("f", [s * a + c * b for a, b in zip(u, v)])
        return self

    def normals(self):
        sums = [0.0] * len(self.points)
        p, t = self.points, self.triangles
        for k in range(0, len(t), 3):
            a, b, c = 3 * t[k], 3 * t[k + 1], 3 * t[k + 2]
            x, y, z = p[a], p[a + 1], p[a + 2]
            ux, uy, uz = p[b] - x, p[b + 1] - y, p[b + 2] - z
            vx, vy, vz = p[c] - x, p[c + 1] - y, p[c + 2] - z
            nx, ny, nz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
            for corner in (a, b, c):
                sums[corner] += nx
                sums[corner + 1] += ny
                sums[corner + 2] += nz
        out = array.array("f")
        for k in range(0, len(sums), 3):
            length = math.hypot(*sums[k:k + 3]) or 1.0
            out.extend(s / length for s in sums[k:k + 3])
        return out

    def vertices(self):
        """The columns of the file by name, and what they hold, vertex by vertex."""
        if not self.smooth:
            return "xyz", self.points[:]
        normals, mixed = self.normals(), array.array("f", bytes(8 * len(self.points)))
        for axis in range(3):
            mixed[axis::6] = self.points[axis::3]
            mixed[3 + axis::6] = normals[axis::3]
        return ("x", "y", "z", "nx", "ny", "nz"), mixed

    def write(self, path):
        names, points = self.vertices()
        triangles, count = self.triangles[:], self.count()
        header = (
            "ply\nformat binary_little_endian 1.0\ncomment written by scenes/generate\n"
            f"element vertex {len(self.points) // 3}\n"
            + "".join(f"property float {name}\n" for name in names)
            + f"element face {count}\n"
            "property list uchar int vertex_indices\nend_header\n")
        if sys.byteorder == "big":
            points.byteswap()
            triangles.byteswap()
        # Each face is the byte 3 and three indices: the index bytes are laid out by
        # strides, which is much faster than packing face by face.
        faces = bytearray(13 * count)
        faces[0::13] = bytes([3]) * count
        raw = triangles.tobytes()
        for byte in range(12):
            faces[1 + byte::13] = raw[byte::12]
        with open(path, "wb") as file:
            file.write(header.encode("ascii"))
            file.write(points.tobytes())
            file.write(faces)
        return count

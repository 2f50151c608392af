"""Forms that things are made of: boxes, turned shapes, tubes, sheets and pillows."""
import itertools
import math

from model.mesh import Mesh


def cross(u, v):
    return (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
            u[0] * v[1] - u[1] * v[0])


def unit(v):
    length = math.hypot(*v)
    return tuple(a / length for a in v)


def box(low, high, bevel=0.003):
    """With its edges cut off at 45 degrees: real ones catch the light there."""
    mesh, corners = Mesh(), list(itertools.product((0, 1), repeat=3))
    ends = (low, high)
    middle = [(a + b) / 2 for a, b in zip(low, high)]
    place = {}  # by corner and by the face that the point is on
    for corner in corners:
        for face in range(3):
            inset = [0 if a == face else bevel * (1 - 2 * side)
                     for a, side in enumerate(corner)]
            place[corner, face] = mesh.point(
                *(ends[side][a] + inset[a] for a, side in enumerate(corner)))

    def outward(a, b, c):
        p = [mesh.points[3 * i:3 * i + 3] for i in (a, b, c)]
        u, v = ([q - r for q, r in zip(p[k], p[0])] for k in (1, 2))
        away = sum(n * (q - m) for n, q, m in zip(cross(u, v), p[0], middle)) > 0
        mesh.triangle(a, b if away else c, c if away else b)

    def strip(a, b, c, d):
        outward(a, b, c)
        outward(b, d, c)

    for corner in corners:
        outward(*(place[corner, face] for face in range(3)))
    for axis in range(3):
        one, two = (axis + 1) % 3, (axis + 2) % 3
        for side in (0, 1):
            strip(*(place[c, axis] for c in corners if c[axis] == side))
        for at in itertools.product((0, 1), repeat=2):
            edge = [c for c in corners if (c[one], c[two]) == at]
            strip(*(place[c, face] for c in edge for face in (one, two)))
    return mesh


def spline(points, steps):
    """Catmull-Rom through the points, `steps` pieces from each to the next."""
    if len(points) == 2:
        return list(points)
    out, last = [], len(points) - 1
    for i in range(last):
        around = [points[min(max(i + k, 0), last)] for k in (-1, 0, 1, 2)]
        for t in (k / steps for k in range(steps)):
            out.append(tuple(
                b + t / 2 * (c - a + t * (2 * a - 5 * b + 4 * c - d
                                          + t * (3 * (b - c) + d - a)))
                for a, b, c, d in zip(*around)))
    return out + [points[-1]]


def smooth_runs(profile):
    """A point given twice is a sharp edge: it ends one smooth run and begins another."""
    runs = [[profile[0]]]
    for before, point in zip(profile, profile[1:]):
        if point == before:
            runs.append([point])
        else:
            runs[-1].append(point)
    return runs


def lathe(profile, sides=48, steps=2):
    """Turned about z, from (radius, height); the outside is on the right of the profile,
    which goes up outside and down inside."""
    mesh = Mesh(smooth=True)
    for run in smooth_runs(profile):
        rings = []
        for radius, z in spline(run, steps):
            radius = max(radius, 0)
            if radius < 1e-6:
                rings.append([mesh.point(0, 0, z)] * sides)
                continue
            rings.append([mesh.point(radius * math.cos(2 * math.pi * j / sides),
                                     radius * math.sin(2 * math.pi * j / sides), z)
                          for j in range(sides)])
        join(mesh, rings)
    return mesh


def ball(radius, sides=48, steps=24):
    return lathe([(radius * math.sin(math.pi * k / steps),
                   radius - radius * math.cos(math.pi * k / steps))
                  for k in range(steps + 1)], sides, 2)


def join(mesh, rings):
    """The skin between closed rings; a ring may be one point many times."""
    for low, high in zip(rings, rings[1:]):
        for j in range(len(low)):
            k = (j + 1) % len(low)
            if low[j] != low[k]:
                mesh.triangle(low[j], low[k], high[k])
            if high[j] != high[k]:
                mesh.triangle(low[j], high[k], high[j])


def tube(path, radius, sides=16, steps=6):
    """Around a smooth path, with closed ends; radius is a number, or one for each
    (radius, radius across) of the path's points."""
    radii = radius if isinstance(radius, (list, tuple)) else [radius] * len(path)
    pairs = [r if isinstance(r, tuple) else (r, r) for r in radii]
    curve = spline([tuple(p) + r for p, r in zip(path, pairs)], steps)
    mesh, rings, side = Mesh(smooth=True), [], None
    for i, (x, y, z, wide, across) in enumerate(curve):
        before, after = curve[max(i - 1, 0)], curve[min(i + 1, len(curve) - 1)]
        along = unit([b - a for a, b in zip(before[:3], after[:3])])
        # The frame turns as little as it can from ring to ring.
        side = side or ((0, 1, 0) if abs(along[1]) < 0.9 else (0, 0, 1))
        side = unit(cross(cross(along, side), along))
        other = cross(along, side)
        ring = []
        for j in range(sides):
            c = wide * math.cos(2 * math.pi * j / sides)
            s = across * math.sin(2 * math.pi * j / sides)
            ring.append(mesh.point(x + c * side[0] + s * other[0],
                                   y + c * side[1] + s * other[1],
                                   z + c * side[2] + s * other[2]))
        rings.append(ring)
    ends = [[mesh.point(*end[:3])] * sides for end in (curve[0], curve[-1])]
    join(mesh, [ends[0], *rings, ends[1]])
    return mesh


def sheet(rows, columns, at):
    """at(u, v) with u, v in [0, 1]; the normal is d/dv x d/du."""
    mesh = Mesh(smooth=True)
    mesh.grid(rows, columns, lambda i, j: at(i / rows, j / columns))
    return mesh


def pillow(length, width, height, steps=24, dent=0.0):
    """A stuffed rectangle around the origin; `dent` is how much its middle sinks in."""
    mesh = Mesh(smooth=True)
    for side in (1, -1):
        def at(i, j, side=side):
            u, v = -math.cos(math.pi * i / steps), -math.cos(math.pi * j / steps)
            swell = ((1 - u**4) * (1 - v**4))**0.5
            swell *= 1 - dent * math.exp(-4 * (u * u + v * v))
            waist = 1 - 0.06 * (u * u + v * v - u * u * v * v)
            return (-side * u * length / 2 * waist, v * width / 2 * waist,
                    side * swell * height / 2)
        mesh.grid(steps, steps, at)
    return mesh

"""A folder with a pbrt-v4 scene whose shapes are PLY files, as exporters write them."""
import array
import math
import sys

REST = .0004  # metres: what stands on something does not share its plane


class SceneFolder:
    def __init__(self, folder):
        self.folder = folder
        self.shapes = []  # (material, file)
        self.triangles = 0
        (folder / "models").mkdir(parents=True, exist_ok=True)

    def add(self, name, material, mesh):
        file = f"models/{len(self.shapes):03}-{name}.ply"
        self.triangles += mesh.write(self.folder / file)
        self.shapes.append((material, file))

    def stand(self, name, material, mesh, x, y, z, turn=0):
        self.add(name, material, mesh.turn("z", turn).move(x, y, z + REST))

    def write(self, name, head):
        """Shapes by material, so that each is named once."""
        lines = []
        for material in dict.fromkeys(m for m, _ in self.shapes):
            lines.append(f'\nNamedMaterial "{material}"\n')
            lines += [f'Shape "plymesh" "string filename" [ "{file}" ]\n'
                      for m, file in self.shapes if m == material]
        counts = f"{len(self.shapes)} meshes, {self.triangles} triangles"
        text = head.replace("COUNTS", counts) + "".join(lines)
        (self.folder / name).write_text(text, encoding="ascii")
        return counts


def direction(x, y, size):
    """Of a texel of an equal-area octahedral map (Clarberg 2008); z is up."""
    u, v = 2 * (x + 0.5) / size - 1, 2 * (y + 0.5) / size - 1
    inside = 1 - abs(u) - abs(v)
    ring = 1 - abs(inside)
    phi = math.pi / 4 * ((abs(v) - abs(u)) / ring + 1 if ring > 0 else 1)
    radius = ring * math.sqrt(2 - ring * ring)
    return (math.copysign(radius * math.cos(phi), u),
            math.copysign(radius * math.sin(phi), v),
            math.copysign(1 - ring * ring, inside))


def write_map(path, size, radiance):
    """An environment as PFM (rows from the bottom); radiance(x, y, z) of a direction."""
    texels = array.array("f")
    for y in reversed(range(size)):
        for x in range(size):
            texels.extend(radiance(*direction(x, y, size)))
    if sys.byteorder == "big":
        texels.byteswap()
    path.write_bytes(b"PF\n%d %d\n-1.0\n" % (size, size) + texels.tobytes())

"""A kitchen in the morning: an interior of about 400 PLY meshes, none instanced."""
import random

from model import fittings, joinery, materials, plants, room, shelves, table_top
from model.scene_folder import SceneFolder, write_map

CAMERA = "2.75 0.32 1.5   1.72 4 1.08"
TABLE = (1.95, 2.72, 1.75, .9, .75)  # x, y, length, width, height
LAMP = (1.95, 2.72, 1.62)


def furniture(folder, generator):
    joinery.table(folder, *TABLE, "oak x")
    x, y = TABLE[:2]
    for dx, dy, degrees in ((-.45, .62, 176), (.45, .58, 183), (-.48, -.6, 4),
                            (.52, -.74, -22)):
        joinery.chair(folder, x + dx, y + dy, degrees)
    room.rug(folder, x, y - .1, 2.7, 1.9, generator)


def shell(folder, generator):
    room.walls(folder)
    room.floor(folder, generator, 4)
    room.window(folder)
    room.curtains(folder, generator)
    room.pendant(folder, *LAMP)


def built_in(folder, generator):
    for build in (fittings.base_units, fittings.worktop, fittings.oven, fittings.hob,
                  fittings.hood, fittings.tall_cupboard):
        build(folder)
    fittings.tiles(folder, generator, 3)


def around(low, high):
    """The corners of a rectangle, in turn."""
    return low, (high[0], low[1]), high, (low[0], high[1])


def head(seed):
    portal = "  ".join(f"{room.OUTSIDE} {y} {z}" for y, z in around(*room.WINDOW))
    strip = "  ".join(f"{a} {b} 1.505" for a, b in around((1.96, 4.84), (3.06, 4.86)))
    door = "  ".join(f"{a} 0.004 {b}" for a, b in around((1.9, .1), (3.5, 2.2)))
    lamp = f"{LAMP[0]} {LAMP[1]} {LAMP[2] + .07:.4g}"
    text = materials.HEAD + materials.LIGHTS + materials.materials()
    for word, value in (("SEED", str(seed)), ("CAMERA", CAMERA), ("PORTAL", portal),
                        ("BULB", lamp), ("STRIP", strip), ("DOOR", door)):
        text = text.replace(word, value)
    return text


def write(seed, out):
    """Writes kitchen.pbrt and its models/ into the folder; says how large they are."""
    folder, generator = SceneFolder(out), random.Random(seed)
    shell(folder, generator)
    built_in(folder, generator)
    shelves.left_shelves(folder)
    shelves.right_shelves(folder, generator)
    shelves.on_worktop(folder, generator)
    shelves.on_cupboard(folder)
    furniture(folder, generator)
    table_top.on_table(folder, generator, TABLE)
    plants.rubber_plant(folder, generator, .42, 4.0)
    for k, (material, radius) in enumerate((("terracotta", .06), ("porcelain", .055),
                                            ("terracotta", .065))):
        plants.herb_pot(folder, generator, -.03, 2.55 + .5 * k, 1.01, material, radius,
                        .17)
    write_map(out / "sky.pfm", 256, materials.sky)
    return folder.write("kitchen.pbrt", head(seed))

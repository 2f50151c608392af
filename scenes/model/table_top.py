"""The laid table: cloth, four places, fruit, flowers, water."""
import math

from model import crockery, nature
from model.crockery import stretched
from model.forms import ball, box, lathe, sheet
from model.plants import flowers


def parts(kind, mesh):
    """A fruit, and an apple's stalk."""
    out = [(f"fruit-{kind.replace(' ', '-')}", kind, mesh)]
    return out + [("stalk", "stalk", nature.stalk(.055))] * kind.startswith("apple")


def fruit_bowl(folder, generator, x, y, z):
    folder.stand("fruit-bowl", "indigo", lathe(crockery.FRUIT_BOWL, 64), x, y, z)
    forms = {"apple": nature.APPLE, "apple green": nature.APPLE, "pear": nature.PEAR,
             "lemon": nature.LEMON}
    kinds = ("apple", "orange", "apple green", "lemon", "pear", "apple", "orange")
    for k, kind in enumerate(kinds):
        angle = math.pi / 3 * k
        mesh = ball(.037) if kind == "orange" else lathe(forms[kind], 48)
        if kind in ("lemon", "pear"):
            mesh.move(0, 0, -.036).turn("y", generator.uniform(55, 80)).move(0, 0, .03)
        reach, up = (.083, .05) if k < 6 else (0, .098)
        place = (reach * math.cos(angle), reach * math.sin(angle), z + up)
        turn = generator.uniform(0, 360)
        for name, material, part in parts(kind, mesh):
            folder.add(name, material,
                       part.turn("z", turn).move(x + place[0], y + place[1], place[2]))
    folder.add("fruit-orange", "orange", ball(.036).move(x, y, z + .022))


def place_setting(folder, x, y, z, degrees, glass):
    """For one who sits at -y before it is turned."""
    parts = [("plate", "porcelain", lathe(crockery.PLATE, 64)),
             ("bowl", "celadon", lathe(crockery.BOWL, 56).move(0, 0, .0065)),
             ("fork", "silver", crockery.fork().turn("z", 90).move(-.165, -.1, 0)),
             ("knife", "silver", crockery.knife().turn("z", 90).move(.16, -.11, 0)),
             ("spoon", "silver", crockery.spoon().turn("z", 90).move(.19, -.1, 0)),
             ("napkin", "cloth", box((-.23, -.1, 0), (-.19, .09, .006), .002)),
             ("glass", "glass", lathe(glass, 56).move(.14, .17, 0))]
    for name, material, mesh in parts:
        folder.stand(name, material, mesh, x, y, z, degrees)


def on_table(folder, generator, table):
    x, y, _, width, z = table

    def cloth(u, v):
        across, along = (u - .5) * (width + .34), (v - .5) * .38
        over = max(abs(across) - width / 2 - .004, 0)
        fold = .008 * (1 - .5 * over) * over / .17 * math.sin(26 * along)
        side = min(abs(across), width / 2 + .004) + fold + over * .06
        return x + along, y + (side if across > 0 else -side), z + .0012 - over

    folder.add("runner", "cloth", sheet(150, 40, cloth))
    top = z + .0014
    fruit_bowl(folder, generator, x + .02, y + .08, top)
    flowers(folder, generator, x - .42, y + .06, z)
    for dx, dy, degrees, glass in ((-.45, -.27, 0, crockery.WINE_GLASS),
                                   (.45, -.27, 0, crockery.WINE_GLASS),
                                   (-.45, .3, 180, crockery.TUMBLER),
                                   (.45, .3, 180, crockery.TUMBLER)):
        place_setting(folder, x + dx, y + dy, z, degrees, glass)
    folder.stand("carafe", "glass", lathe(crockery.CARAFE, 64), x + .3, y - .02, z)
    folder.stand("water", "water", lathe(crockery.WATER, 64), x + .3, y - .02, z)

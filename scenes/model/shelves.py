"""What stands and hangs along the back wall: on shelves, rail, worktop and cupboard."""
from model import crockery, fittings, joinery
from model.crockery import stretched
from model.fittings import BACK, TOP
from model.forms import box, lathe, tube
from model.mesh import Mesh
from model.plants import herb_pot

FRONT_BURNER = fittings.FRONT + .18  # y
COVERS = ("cover red", "cover blue", "cover green", "cover ochre", "cover cream")


def jar(folder, x, y, z, content, fill):
    folder.stand("jar", "glass", lathe(crockery.JAR, 48), x, y, z)
    folder.stand("jar-content", content,
                 lathe([(0, .0055), (.043, .0055), (.0468, .0105), (.0468, fill),
                        (.0468, fill), (.03, fill + .004), (0, fill + .006)]), x, y, z)
    folder.stand("jar-stopper", "cork", lathe(crockery.STOPPER, 32), x, y, z + .139)


def hung_pan(folder, x, radius, depth, z):
    """From the rail by its handle, bottom to the room."""
    for name, mesh in zip(("pan", "pan-handle"), crockery.pan(radius, depth)):
        mesh.turn("y", -90).turn("z", -90)
        material = "copper" if name == "pan" else "brass"
        folder.add(name, material, mesh.move(x, BACK - .055 - depth, z - radius - .2))
    folder.add("hook", "brass", tube(
        [(x, BACK - .07, z - .03), (x, BACK - .05, z - .025), (x, BACK - .05, z + .005),
         (x, BACK - .062, z + .011), (x, BACK - .07, z)], .0022, 12, 8))


def plate_stack(folder, x, y, z, count, material, profile=crockery.PLATE, step=.0085):
    for k in range(count):
        folder.stand("plate", material, lathe(profile, 56, 2), x, y, z + k * step)


def left_shelves(folder):
    fittings.rail(folder, .14, 1.08, 1.52)
    for x, radius, depth in ((.24, .075, .055), (.45, .09, .05), (.69, .105, .05),
                             (.95, .12, .05)):
        hung_pan(folder, x, radius, depth, 1.52)
    fittings.shelf(folder, .08, 1.12, 1.8)
    y = BACK - .12
    for k, (content, fill) in enumerate((("pasta", .11), ("lentils", .08), ("flour", .1),
                                         ("beans", .115), ("pasta", .06))):
        jar(folder, .2 + .125 * k, y, 1.8, content, fill)
    folder.stand("vase", "indigo", lathe(stretched(crockery.VASE, 1.0), 64), .98, y, 1.8)
    fittings.shelf(folder, .08, 1.12, 2.16)
    for k in range(4):
        folder.stand("bowl", "stoneware", lathe(crockery.BOWL, 48), .22, y,
                     2.16 + .02 * k)
    for k in range(3):
        folder.stand("bowl", "celadon", lathe(stretched(crockery.BOWL, 1.15), 48), .44, y,
                     2.16 + .024 * k)
    folder.stand("teapot", "porcelain", crockery.teapot_body(), .7, y, 2.16, -20)
    folder.stand("teapot-lid", "porcelain", lathe(crockery.TEAPOT_LID, 48), .7, y, 2.16)
    folder.stand("pot", "copper", lathe(stretched(crockery.PAN, .09, .22), 64), .98, y,
                 2.16)


def right_shelves(folder, generator):
    y = BACK - .12
    for z in (1.54, 1.88, 2.22):
        fittings.shelf(folder, 1.92, 3.1, z)
    plate_stack(folder, 2.09, y + .005, 1.54, 7, "porcelain",
                stretched(crockery.PLATE, .86))
    plate_stack(folder, 2.36, y, 1.54, 5, "celadon", stretched(crockery.PLATE, .7))
    for k in range(5):
        folder.stand("tumbler", "glass", lathe(crockery.TUMBLER, 48), 2.53 + .095 * k,
                     y + (.03 if k % 2 else -.03), 1.54)
    colours = ("porcelain", "indigo", "celadon", "porcelain", "stoneware")
    for k, colour in enumerate(colours):
        folder.stand("cup", colour, crockery.cup(), 2.03 + .135 * k, y - .02, 1.88,
                     generator.uniform(-60, 10))
    for k in range(3):
        folder.stand("bowl", "indigo", lathe(crockery.BOWL, 48), 2.78, y, 1.88 + .02 * k)
    folder.stand("bottle", "glass", lathe(crockery.BOTTLE, 48), 2.94, y, 1.88)
    folder.stand("bottle-stopper", "cork",
                 lathe([(0, .28), (.0118, .28), (.0125, .315), (0, .317)], 24), 2.94, y,
                 1.88)
    joinery.books(folder, generator, 1.98, 2.55, BACK - .2, 2.22, COVERS)
    folder.stand("vase", "stoneware", lathe(stretched(crockery.VASE, 1.0, .9), 64), 2.7,
                 y, 2.22)
    folder.stand("pot", "celadon", lathe(stretched(crockery.FLOWER_POT, .07), 48), 2.95,
                 y, 2.22)


def on_worktop(folder, generator):
    folder.stand("board", "oak x",
                 box((-.02, -.14, 0), (.0, .14, .4), .005).turn("z", 90).turn("x", -10),
                 2.08, BACK - .1, TOP + .004)
    pots = ("stoneware", .065), ("porcelain", .05)
    for k, (material, radius) in enumerate(pots):
        folder.stand("crock", material, lathe(stretched(crockery.FLOWER_POT, radius), 48),
                     2.37 + .17 * k, BACK - .16, TOP)
    spoons = Mesh(smooth=True)
    for k in range(6):
        spoons.add(crockery.spoon(.27).turn("y", -80 - 2 * (k % 3)).turn("z", 60 * k))
    folder.stand("wooden-spoons", "oak z", spoons, 2.37, BACK - .16, TOP + .012)
    for k, content in enumerate(("lentils", "flour", "beans")):
        jar(folder, 2.75 + .125 * k, BACK - .12, TOP, content, .07 + .02 * k)
    pan, grip = crockery.pan(.12, .11, .21)
    for name, material, mesh in (("pan", "steel", pan), ("pan-handle", "steel", grip)):
        folder.stand(name, material, mesh, 1.63, FRONT_BURNER, TOP + .047, -60)
    folder.stand("kettle", "copper", crockery.teapot_body().scale(1.15, 1.15, 1.15), 1.37,
                 FRONT_BURNER + .24, TOP + .047, 40)
    folder.stand("kettle-lid", "copper", lathe(stretched(crockery.TEAPOT_LID, 1.15), 48),
                 1.37, FRONT_BURNER + .24, TOP + .047)
    herb_pot(folder, generator, .3, BACK - .2, TOP, "terracotta", .075, .26)
    folder.stand("bottle", "glass", lathe(crockery.BOTTLE, 48), .5, BACK - .13, TOP)


def on_cupboard(folder):
    folder.stand("big-bowl", "stoneware",
                 lathe(stretched(crockery.FRUIT_BOWL, 1.3, 1.8), 64), 3.45, 4.68, 2.24)
    folder.stand("big-vase", "celadon", lathe(stretched(crockery.VASE, 1.3, 1.1), 64),
                 3.78, 4.66, 2.24)

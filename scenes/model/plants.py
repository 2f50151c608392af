"""Plants in their pots, and flowers in a vase, put into a SceneFolder."""
from model import crockery, nature
from model.crockery import stretched
from model.forms import lathe, tube


def herb_pot(folder, generator, x, y, z, material, radius, height):
    folder.stand("flower-pot", material,
                 lathe(stretched(crockery.FLOWER_POT, radius), 48), x, y, z)
    folder.stand("soil", "soil", lathe([(0, 0), (radius * .9, 0), (0, .008)], 32), x, y,
                 z + radius * 1.5)
    stems, foliage = nature.herb(generator, 80, height, radius * 1.3, .045)
    folder.stand("herb-stems", "stem", stems, x, y, z + radius * 1.5)
    folder.stand("herb", "herb", foliage, x, y, z + radius * 1.5)


def rubber_plant(folder, generator, x, y):
    """Leaves around three stems, each leaf a mesh of its own."""
    folder.stand("plant-pot", "stoneware", lathe(stretched(crockery.FLOWER_POT, .17), 64),
                 x, y, 0)
    folder.stand("soil", "soil", lathe([(0, 0), (.15, 0), (0, .01)], 40), x, y, .26)
    for stem in range(3):
        angle = 120 * stem + generator.uniform(-20, 20)
        path = [(.02, 0, .25), (.05, .01, .6), (.1, -.01, 1 + .14 * stem)]
        folder.add("plant-stem", "stalk", tube(path, [.011, .009, .004], 16, 8)
                   .turn("z", angle).move(x, y, 0))
        for k in range(9):
            t = .3 + .7 * k / 8
            one = nature.leaf(generator.uniform(.2, .29), generator.uniform(.1, .13),
                              generator.uniform(.3, .9), .25)
            one.turn("y", generator.uniform(-60, -25)).turn("z", 137.5 * k)
            one.move(.02 + .08 * t * t, 0, .25 + t * (.75 + .14 * stem))
            folder.add("plant-leaf", "leaf", one.turn("z", angle).move(x, y, 0))


def flowers(folder, generator, x, y, z):
    folder.stand("vase", "porcelain", lathe(stretched(crockery.VASE, .85), 64), x, y, z)
    for k in range(7):
        angle, lean = 51 * k + generator.uniform(-15, 15), generator.uniform(.03, .11)
        top = generator.uniform(.31, .38)
        stem = tube([(0, 0, .05), (.012, 0, .2), (lean * .5 + .008, 0, .27),
                     (lean, 0, top)], .0028, 12, 6)
        tilt = 70 * lean / .1 * .6
        petals = nature.tulip(generator).turn("y", tilt).move(lean, 0, top - .002)
        blade = nature.leaf(.2, .034, 1.1, .5).turn("y", -72).move(.015, 0, .16)
        for name, material, mesh in (("stem", "stem", stem), ("tulip", "petal", petals),
                                     ("tulip-leaf", "herb", blade)):
            folder.stand(name, material, mesh, x, y, z, angle)

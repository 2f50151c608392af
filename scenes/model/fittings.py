"""What is built in along the wall y = 5: cupboards, sink, oven, hob, hood, tiles."""
import math

from model.forms import ball, box, lathe, sheet, tube
from model.joinery import doors, drawers
from model.mesh import Mesh

FRONT, BACK, TOP = 4.38, 5.0, .92  # of the base units; TOP is that of the worktop
UNITS = (0.0, .6, 1.2, 1.8, 2.4, 3.2)
SINK = ((.66, 4.47), (1.14, 4.87))


def base_units(folder):
    for x0, x1 in zip(UNITS, UNITS[1:]):
        folder.add("carcass", "cabinet",
                   box((x0 + .001, FRONT + .021, .1), (x1 - .001, BACK, .78), .001))
    folder.add("plinth", "dark", box((0, FRONT + .06, 0), (3.2, BACK, .1)))
    drawers(folder, UNITS[0], UNITS[1], FRONT, (.1, .37, .64, .88), "cabinet")
    doors(folder, UNITS[1], UNITS[2], FRONT, .1, .88, "cabinet")
    doors(folder, UNITS[3], UNITS[4], FRONT, .1, .88, "cabinet")
    drawers(folder, UNITS[4], UNITS[5], FRONT, (.1, .4, .7, .88), "cabinet")


def worktop(folder):
    """A slab in four pieces around the sink, which is a rough steel basin."""
    (x0, y0), (x1, y1) = SINK
    slab = Mesh()
    for (a, b), (c, d) in (((0, FRONT - .02), (x0, BACK)),
                           ((x1, FRONT - .02), (3.2, BACK)),
                           ((x0, FRONT - .02), (x1, y0)), ((x0, y1), (x1, BACK))):
        slab.add(box((a, b, TOP - .04), (c, d, TOP), .0006))
    folder.add("worktop", "stone", slab)
    basin = Mesh()
    for low, high in (((x0, y0, .72), (x1, y1, .724)),
                      ((x0, y0, .72), (x0 + .004, y1, TOP)),
                      ((x1 - .004, y0, .72), (x1, y1, TOP)),
                      ((x0, y0, .72), (x1, y0 + .004, TOP)),
                      ((x0, y1 - .004, .72), (x1, y1, TOP))):
        basin.add(box(low, high, .001))
    folder.add("basin", "steel", basin)
    drain = lathe([(0, 0), (.03, .001), (.04, .004), (.045, .002)])
    folder.add("drain", "steel", drain.move(.9, 4.67, .7245))
    tap(folder, .9, 4.925)


def tap(folder, x, y):
    folder.add("tap-foot", "brass", lathe(
        [(0, 0), (.026, 0), (.027, .003), (.02, .01), (.014, .03), (.013, .06),
         (0, .06)]).move(x, y, TOP))
    path = [(0, 0, .05), (0, 0, .25), (0, -.04, .33), (0, -.11, .36), (0, -.18, .32),
            (0, -.19, .26)]
    folder.add("tap", "brass", tube(path, .011, 32, 12).move(x, y, TOP))
    lever = tube([(.01, 0, .045), (.04, 0, .05), (.085, 0, .075)],
                 [.007, .006, .0075], 20)
    folder.add("tap-lever", "brass", lever.move(x, y, TOP))


def tiles(folder, generator, tones, x1=3.2, z0=TOP, z1=1.46):
    """Bricks of glazed tile; those of one tone are one mesh, and the grout is behind."""
    wide, high, gap, rows = .2, .0675, .0015, 8
    meshes = [Mesh() for _ in range(tones)]
    for row in range(rows):
        z = z0 + row * high
        x = -wide / 2 * (row % 2)
        while x < x1 - .001:
            low, top = max(x, 0), min(x + wide, x1)
            tilt = generator.uniform(0, .0008)  # hand-made tiles do not lie in one plane
            generator.choice(meshes).add(
                box((low + gap, BACK - .009 - tilt, z + gap),
                    (top - gap, BACK - .001, z + high - gap), .0022))
            x += wide
    for tone, mesh in enumerate(meshes):
        folder.add("tiles", f"glaze {tone}", mesh)
    folder.add("grout", "paint", box((0, BACK - .006, z0), (x1, BACK - .0005, z1), .0004))


def oven(folder):
    x0, x1 = UNITS[2] + .003, UNITS[3] - .003
    y = FRONT
    folder.add("oven-door", "oven glass", box((x0, y, .12), (x1, y + .02, .74), .004))
    folder.add("oven-rim", "steel", box((x0, y - .003, .74), (x1, y + .02, .875), .003))
    folder.add("oven-foot", "steel", box((x0, y, .1), (x1, y + .02, .118), .002))
    folder.add("oven-handle", "steel", tube(
        [(x0 + .05, y, .69), (x0 + .05, y - .04, .69), (x0 + .08, y - .05, .69),
         (x1 - .08, y - .05, .69), (x1 - .05, y - .04, .69), (x1 - .05, y, .69)],
        .009, 24, 10))
    towel(folder, x0 + .14, y - .05, .69)
    knob = [(0, 0), (.022, 0), (.024, .003), (.0195, .006), (.018, .028), (.016, .031),
            (0, .031)]
    for k in range(5):
        folder.add("oven-knob", "black", lathe(knob, 48).turn("x", 90)
                   .move(x0 + .09 + .105 * k, y - .003, .81))


def towel(folder, x, y, z):
    """Over the bar of the oven, longer in front."""
    def at(u, v):
        along = u * .62 - .24  # from behind the bar to the front
        angle = min(max(along / .012, -math.pi / 2), math.pi / 2)
        down = max(abs(along) - .0188, 0)
        wave = .005 * math.sin(19 * v + 2) * min(down * 9, 1)
        return (x + .2 * v, y - .012 * math.sin(angle) + wave,
                z + .012 * math.cos(angle) - down)

    folder.add("towel", "towel", sheet(124, 30, at))


def hob(folder):
    """A pane of glass with four cast-iron grates over their burners."""
    x0, y0 = UNITS[2] + .02, FRONT + .05
    folder.add("hob", "oven glass",
               box((x0, y0, TOP), (x0 + .56, y0 + .5, TOP + .006), .002))
    burner = [(0, .028), (.03, .028), (.035, .024), (.036, .015), (.05, .01), (.052, 0)]
    for k in range(4):
        x, y = x0 + .15 + .26 * (k % 2), y0 + .13 + .24 * (k // 2)
        folder.add("burner", "black", lathe(burner[::-1], 48).move(x, y, TOP + .006))
        grate = Mesh()
        for turn in range(4):
            arm = box((.025, -.005, .03), (.105, .005, .04), .0015)
            arm.add(box((.095, -.005, 0), (.105, .005, .03), .001))
            grate.add(arm.turn("z", 90 * turn))
        folder.add("grate", "iron", grate.move(x, y, TOP + .006))


def hood(folder):
    """A sloping canopy and its chimney."""
    low, high = ((1.2, 4.5), (1.8, 4.99)), ((1.38, 4.72), (1.62, 4.99))
    mesh = Mesh()
    rings = []
    for ((a, b), (c, d)), z in ((low, 1.6), (low, 1.65), (high, 1.86), (high, 2.6)):
        rings.append([mesh.point(*p, z) for p in ((a, b), (c, b), (c, d), (a, d))])
    for below, above in zip(rings, rings[1:]):
        for j in range(4):
            mesh.quad(below[j], below[(j + 1) % 4], above[(j + 1) % 4], above[j])
    mesh.quad(*rings[0])
    folder.add("hood", "steel", mesh)


def tall_cupboard(folder):
    folder.add("tall-carcass", "cabinet",
               box((3.202, FRONT + .021, .1), (3.995, BACK, 2.2), .002))
    folder.add("tall-plinth", "dark", box((3.2, FRONT + .06, 0), (4, BACK, .1)))
    folder.add("cornice", "cabinet",
               box((3.19, FRONT - .03, 2.2), (3.999, BACK, 2.24), .008))
    doors(folder, 3.2, 3.99, FRONT, .1, 1.3, "cabinet")
    doors(folder, 3.2, 3.99, FRONT, 1.304, 2.2, "cabinet", handles="bottom")


def shelf(folder, x0, x1, z, deep=.24):
    """A board on two brass brackets."""
    folder.add("shelf", "oak x",
               box((x0, BACK - deep, z - .032), (x1, BACK - .001, z), .004))
    for x in (x0 + .12, x1 - .12):
        folder.add("bracket", "brass", tube(
            [(x, BACK, z - .17), (x, BACK - .03, z - .16),
             (x, BACK - deep * .8, z - .055), (x, BACK - deep * .85, z - .033)],
            .007, 16, 8))


def rail(folder, x0, x1, z):
    """A rod for pans, with its two stand-offs."""
    y = BACK - .06
    folder.add("rail", "brass", tube([(x0, y, z), (x1, y, z)], .007, 20))
    for x in (x0, x1):
        folder.add("rail-end", "brass", ball(.012, 24, 12).move(x, y, z - .012))
        folder.add("rail-holder", "brass", tube([(x, y, z), (x, BACK, z)], .006, 16))

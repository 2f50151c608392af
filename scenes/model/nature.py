"""What grows: fruit, leaves, herbs, flowers."""
import math

from model.forms import sheet, tube
from model.mesh import Mesh

APPLE = [(0, .012), (.008, .006), (.018, .001), (.03, .008), (.037, .026), (.038, .042),
         (.031, .06), (.018, .067), (.008, .063), (0, .055)]
PEAR = [(0, .006), (.008, .002), (.02, .001), (.034, .014), (.038, .034), (.03, .058),
        (.019, .078), (.014, .09), (.006, .096), (0, .093)]
LEMON = [(0, 0), (.005, .002), (.009, .006), (.022, .017), (.027, .036), (.022, .056),
         (.009, .067), (.006, .072), (0, .074)]


def stalk(z, length=.022):
    return tube([(0, 0, z), (.001, 0, z + length * .5), (.006, .002, z + length)],
                [.0012, .001, .0017], 8, 5)


def leaf(length, width, droop, fold, rows=14, columns=10):
    """Along x from its stalk at 0, bending down; folded along the midrib."""
    def at(u, v):
        x, half = u * length, width / 2 * math.sin(math.pi * min(u**.75, .998))
        y = (2 * v - 1) * max(half, .0008)
        ripple = .06 * width * math.sin(14 * u) * (2 * v - 1)**2
        return (x * math.cos(droop * u * .8), y,
                fold * abs(y) - x * math.sin(droop * u * .8) + ripple)

    return sheet(rows, columns, at)


def herb(generator, leaves, height, spread, size):
    """Stems and leaves of a herb in a pot: one mesh each."""
    stems, foliage = Mesh(smooth=True), Mesh(smooth=True)
    for _ in range(max(4, leaves // 9)):
        angle = generator.uniform(0, 2 * math.pi)
        reach = generator.uniform(.2, 1) * spread
        top = height * generator.uniform(.6, 1)
        tip = (reach * math.cos(angle), reach * math.sin(angle), top)
        stems.add(tube([(tip[0] * .2, tip[1] * .2, -.005),
                        (tip[0] * .5, tip[1] * .5, top * .5), tip],
                       [.0016, .0013, .0008], 6, 4))
        for k in range(9):
            t = .35 + .65 * k / 8
            one = leaf(size * generator.uniform(.7, 1.2), size * .55,
                       generator.uniform(.2, 1), .3, 7, 6)
            one.turn("y", generator.uniform(-50, 5)).turn("z", generator.uniform(0, 360))
            foliage.add(one.move(tip[0] * (.2 + .8 * t**2), tip[1] * (.2 + .8 * t**2),
                                 top * t))
    return stems, foliage


def tulip(generator):
    """Six petals that nearly close, around z."""
    flower = Mesh(smooth=True)
    for k in range(6):
        inner = k % 2

        def at(u, v, inner=inner):
            radius = (.017 - .003 * inner) * math.sin(math.pi * (.12 + .68 * u))**.8
            radius += .001
            half = .62 * math.sin(math.pi * min(.15 + .83 * u, .99))**.6
            angle = (2 * v - 1) * half
            return (radius * math.cos(angle), radius * math.sin(angle),
                    .052 * u * (1 - .12 * (2 * v - 1)**2))

        flower.add(sheet(14, 12, at).turn("z", 60 * k + generator.uniform(-4, 4)))
    return flower

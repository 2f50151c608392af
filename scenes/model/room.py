"""The shell of the kitchen: walls, floor, window with curtains, lamp. z is up, the window
is in the wall x = 0, and the room reaches to x = 4, y = 5, z = 2.6 (metres)."""
import math

from model.forms import ball, box, lathe, sheet, tube
from model.mesh import Mesh

WIDE, DEEP, HIGH = 4.0, 5.0, 2.6
WINDOW = ((2.15, .98), (3.95, 2.2))  # (y, z) of two corners
OUTSIDE = -.22  # the wall is so thick


def flat(*corners):
    mesh = Mesh()
    mesh.quad(*(mesh.point(*c) for c in corners))
    return mesh


def walls(folder):
    w, d, h = WIDE, DEEP, HIGH
    folder.add("ceiling", "ceiling", flat((0, 0, h), (w, 0, h), (w, d, h), (0, d, h)))
    folder.add("wall-back", "wall", flat((0, d, 0), (w, d, 0), (w, d, h), (0, d, h)))
    folder.add("wall-front", "wall", flat((0, 0, 0), (w, 0, 0), (w, 0, h), (0, 0, h)))
    folder.add("wall-right", "wall", flat((w, 0, 0), (w, d, 0), (w, d, h), (w, 0, h)))
    (y0, z0), (y1, z1) = WINDOW
    mesh = Mesh()
    for low, high in (((0, 0), (d, z0)), ((0, z1), (d, h)), ((0, z0), (y0, z1)),
                      ((y1, z0), (d, z1))):
        (a, b), (c, e) = low, high
        mesh.add(flat((0, a, b), (0, c, b), (0, c, e), (0, a, e)))
    folder.add("wall-window", "wall", mesh)
    for name, low, high in (("back", (.01, d - .014, 0), (w, d, .09)),
                            ("right", (w - .014, .01, 0), (w, d, .09)),
                            ("left", (0, .01, 0), (.014, d, .09))):
        folder.add(f"skirting-{name}", "paint", box(low, high, .004))


def floor(folder, generator, tones, width=.14, length=1.4, gap=.0015):
    """Planks along y, each row begun anywhere; those of one tone are one mesh."""
    planks = [Mesh() for _ in range(tones)]
    for row in range(math.ceil(WIDE / width)):
        x0, x1 = row * width, min((row + 1) * width, WIDE)
        y = -generator.uniform(0, length)
        while y < DEEP:
            low, high = max(y, 0), min(y + length, DEEP)
            if high - low > .02:
                generator.choice(planks).add(
                    box((x0 + gap, low + gap, -.02), (x1 - gap, high - gap, 0), .002))
            y += length
    for tone, mesh in enumerate(planks):
        folder.add("planks", f"oak floor {tone}", mesh)
    folder.add("below-planks", "dark", flat((0, 0, -.015), (WIDE, 0, -.015),
                                            (WIDE, DEEP, -.015), (0, DEEP, -.015)))


def window(folder):
    """Two sashes of two panes each; without glass, which would hide the sky from shadow
    rays."""
    (y0, z0), (y1, z1) = WINDOW
    x = OUTSIDE
    for name, corners in (
            ("top", ((0, y0, z1), (0, y1, z1), (x, y1, z1), (x, y0, z1))),
            ("left", ((0, y0, z0), (0, y0, z1), (x, y0, z1), (x, y0, z0))),
            ("right", ((0, y1, z0), (0, y1, z1), (x, y1, z1), (x, y1, z0))),
            ("bottom", ((0, y0, z0), (0, y1, z0), (x, y1, z0), (x, y0, z0)))):
        folder.add(f"reveal-{name}", "paint", flat(*corners))
    folder.add("sill", "paint", box((x + .05, y0 - .06, z0), (.07, y1 + .06, z0 + .03),
                                    .006))
    middle = (y0 + y1) / 2
    for a, b in ((y0, middle), (middle, y1)):
        sash = Mesh()
        for low, high in (((a, z0), (a + .05, z1)), ((b - .05, z0), (b, z1)),
                          ((a, z0 + .03), (b, z0 + .09)), ((a, z1 - .06), (b, z1)),
                          ((a, z1 - .42), (b, z1 - .395))):
            sash.add(box((x + .06, *low), (x + .11, *high), .006))
        folder.add("sash", "paint", sash)
    folder.add("window-catch", "brass", tube(
        [(x + .11, middle, 1.45), (x + .15, middle, 1.45), (x + .155, middle, 1.4),
         (x + .155, middle, 1.34)], .008, 20, 8))


def curtain(folder, y0, y1, generator):
    """Pleats that open towards the hem, just in front of the wall."""
    phase, folds = generator.uniform(0, 6), round((y1 - y0) / .055)

    def at(u, v):
        z = 2.33 - u * 1.62
        wave = math.sin(2 * math.pi * folds * v + phase + .5 * math.sin(3 * u + 9 * v))
        depth = .022 + .014 * u
        return .1 + depth * wave + .006 * math.sin(11 * v + 5 * u), y0 + (y1 - y0) * v, z

    folder.add("curtain", "linen", sheet(40, 18 * folds, at))


def curtains(folder, generator):
    (y0, _), (y1, _) = WINDOW
    curtain(folder, y0 - .42, y0 - .04, generator)
    curtain(folder, y1 + .03, y1 + .36, generator)
    folder.add("curtain-rod", "brass", tube([(.1, y0 - .5, 2.34), (.1, y1 + .42, 2.34)],
                                            .011, 24))
    for y in (y0 - .5, y1 + .42):
        folder.add("finial", "brass", ball(.022, 24, 12).move(.1, y, 2.318))


SHADE = [(.19, 0), (.187, .006), (.16, .05), (.1, .105), (.05, .14), (.035, .175),
         (.03, .2), (.0, .203)]


def pendant(folder, x, y, z, name="pendant"):
    """A spun shade, white inside; the bulb is a sphere light at lamp_at(x, y, z)."""
    folder.add(f"{name}-shade", "enamel", lathe(SHADE, 80, 6).move(x, y, z))
    inner = lathe([(r - .003, h - .001) for r, h in SHADE[:-1]] + [(0, .199)], 80, 6)
    folder.add(f"{name}-lining", "paint", inner.move(x, y, z))
    folder.add(f"{name}-socket", "brass", lathe(
        [(0, .1), (.02, .1), (.021, .104), (.021, .2), (0, .2)], 32).move(x, y, z))
    folder.add(f"{name}-cord", "black", tube([(x, y, z + .2), (x, y, HIGH)], .004, 8))
    folder.add(f"{name}-rose", "brass", lathe(
        [(0, -.03), (.02, -.03), (.05, -.01), (.052, 0), (0, 0)], 48)
        .move(x, y, HIGH))


def rug(folder, x, y, length, width, generator):
    phases = [generator.uniform(0, 6) for _ in range(4)]

    def at(u, v):
        wave = sum(math.sin((3 + 2 * k) * (u + .7 * v) + p) for k, p in enumerate(phases))
        knots = math.sin(190 * u) * math.sin(150 * v)
        return (x + (v - .5) * length, y + (u - .5) * width,
                .008 + .0006 * wave + .0012 * knots)

    folder.add("rug", "rug", sheet(90, 110, at))

"""Furniture, put into a SceneFolder part by part, as exporters of CAD models do."""
from model.forms import box, pillow, tube
from model.mesh import Mesh


def bar_handle(folder, x, y, z, length, upright=False):
    """On a front that faces -y."""
    a, b = (length / 2, 0) if not upright else (0, length / 2)
    folder.add("handle", "brass", tube(
        [(x - a, y, z - b), (x - a, y - .026, z - b), (x - a * .8, y - .03, z - b * .8),
         (x + a * .8, y - .03, z + b * .8), (x + a, y - .026, z + b), (x + a, y, z + b)],
        .0055, 16, 6))


def front(folder, low, high, material, frame=.055):
    """In the plane y = low[1], facing -y: a frame around a panel that lies deeper."""
    (x0, y, z0), (x1, z1) = low, high
    panel = box((x0 + frame - .01, y + .009, z0 + frame - .01),
                (x1 - frame + .01, y + .018, z1 - frame + .01))
    for piece in (((x0, z0), (x0 + frame, z1)), ((x1 - frame, z0), (x1, z1)),
                  ((x0 + frame, z0), (x1 - frame, z0 + frame)),
                  ((x0 + frame, z1 - frame), (x1 - frame, z1))):
        (a, b), (c, d) = piece
        panel.add(box((a, y, b), (c, y + .02, d), .002))
    folder.add("front", material, panel)


def drawers(folder, x0, x1, y, heights, material):
    """Fronts between successive heights, each with a handle."""
    for low, high in zip(heights, heights[1:]):
        front(folder, (x0 + .002, y, low + .002), (x1 - .002, high - .002), material,
              .035 if high - low < .2 else .055)
        bar_handle(folder, (x0 + x1) / 2, y, (low + high) / 2, .15)


def doors(folder, x0, x1, y, z0, z1, material, handles="top"):
    """A pair of doors."""
    middle = (x0 + x1) / 2
    z = z1 - .14 if handles == "top" else z0 + .14
    for a, b, x in ((x0, middle, middle - .03), (middle, x1, middle + .03)):
        front(folder, (a + .002, y, z0 + .002), (b - .002, z1 - .002), material)
        bar_handle(folder, x, y, z, .15, upright=True)


def chair(folder, x, y, degrees):
    """A spindle-backed chair that looks along +y before it is turned."""
    parts = [("seat", "walnut x", box((-.21, -.2, .43), (.21, .21, .46), .012))]
    for sx in (-1, 1):
        for sy, foot in ((-1, -.225), (1, .215)):
            parts.append(("leg", "walnut z", tube(
                [(sx * .21, foot, 0), (sx * .195, foot * .9, .2),
                 (sx * .175, foot * .78, .435)], [.012, .018, .015], 24, 10)))
        parts.append(("post", "walnut z", tube(
            [(sx * .185, -.17, .455), (sx * .195, -.2, .65), (sx * .2, -.245, .9)],
            [.014, .015, .012], 24, 10)))
    spindles = Mesh(smooth=True)
    for k in range(-2, 3):
        spindles.add(tube(
            [(k * .06, -.175, .455), (k * .062, -.215, .65), (k * .065, -.268, .88)],
            [.007, .009, .006], 16, 8))
    parts.append(("spindles", "walnut z", spindles))
    parts.append(("rail", "walnut x", tube(
        [(-.225, -.235, .9), (-.1, -.268, .905), (.1, -.268, .905), (.225, -.235, .9)],
        [(.014, .034), (.014, .04), (.014, .04), (.014, .034)], 32, 12)))
    parts.append(("cushion", "cushion",
                  pillow(.4, .39, .06, 36, .25).move(0, .005, .487)))
    for name, material, mesh in parts:
        folder.add(f"chair-{name}", material, mesh.turn("z", degrees).move(x, y, 0))


def table(folder, x, y, length, width, height, wood):
    a, b = length / 2, width / 2
    folder.add("table-top", wood, box((-a, -b, height - .035), (a, b, height), .006)
               .move(x, y, 0))
    for sx in (-1, 1):
        for sy in (-1, 1):
            px, py = x + sx * (a - .09), y + sy * (b - .09)
            folder.add("table-leg", wood, tube(
                [(px + sx * .03, py + sy * .03, 0), (px, py, height - .034)],
                [.019, .032], 32))
        side = y + sx * (b - .1)
        folder.add("apron", wood, box((x - a + .1, side - .01, height - .115),
                                      (x + a - .1, side + .01, height - .036)))


def books(folder, generator, x0, x1, y, z, materials, deep=.17):
    """A row along x, backs to -y; covers and pages are meshes of their own."""
    x = x0
    while x < x1 - .05:
        thick, tall = generator.uniform(.014, .042), generator.uniform(.19, .27)
        depth = min(deep, tall * .72)
        lean = generator.choice((0, 0, 0, 0, 4))
        cover = box((0, 0, 0), (.002, depth, tall), .0005)
        cover.add(box((thick - .002, 0, 0), (thick, depth, tall), .0005))
        cover.add(box((0, -.002, 0), (thick, .001, tall), .0008))
        pages = box((.0021, .002, .003), (thick - .0021, depth - .004, tall - .003),
                    .0004)
        shift = x + tall * .07 * (lean > 0)
        for name, material, mesh in (("cover", generator.choice(materials), cover),
                                     ("pages", "paper", pages)):
            folder.add(f"book-{name}", material,
                       mesh.turn("y", -lean).move(shift, y, z + .001))
        x = shift + thick + .0015

"""Many strands of hair on a ball, for rays among thin curves."""
import math
import random

HEAD = """# {count} strands of hair on a ball, under a lamp.
#
# Purpose: rays among many thin curves, for measurements.
# Needs: curve, hair, a sphere, diffuse, an area light and a constant environment.
# Closed form: none. Written by scenes/generate strands --size {count} --seed {seed}.

LookAt 0 1.2 -6   0 0.15 0   0 1 0
Camera "perspective" "float fov" [ 36 ]
Film "rgb" "string filename" [ "strands.exr" ]
    "integer xresolution" [ 512 ] "integer yresolution" [ 512 ] "bool savefp16" [ false ]
PixelFilter "gaussian"
Sampler "sobol" "integer pixelsamples" [ 16 ]
Integrator "path" "integer maxdepth" [ 12 ]

WorldBegin

LightSource "infinite" "rgb L" [ 0.3 0.33 0.4 ]
AttributeBegin
    AreaLightSource "diffuse" "rgb L" [ 30 28 25 ]
    Translate -3 5 -3
    Shape "sphere" "float radius" 0.6
AttributeEnd
Material "diffuse" "rgb reflectance" [ 0.3 0.2 0.15 ]
Shape "sphere" "float radius" 1
Material "hair" "float eumelanin" 0.6
"""


def unit(v):
    length = math.sqrt(sum(c * c for c in v))
    return [c / length for c in v]


def root(rng):
    """A place on the upper part of the unit ball, by area."""
    y, phi = rng.uniform(-0.15, 1), rng.uniform(0, 2 * math.pi)
    r = math.sqrt(1 - y * y)
    return [r * math.cos(phi), y, r * math.sin(phi)]


def strand(rng, length, points, curl):
    """Points of a strand that grows outwards, falls along the ball, and curls about its
    way."""
    at = root(rng)
    out = unit([at[k] + rng.gauss(0, 0.15) for k in range(3)])
    turn, phase = rng.uniform(0.6, 1), rng.uniform(0, 2 * math.pi)
    side = unit([at[2] + 1e-3, 0, -at[0]])
    path = []
    step = length / (points - 1)
    for i in range(points):
        swing, a = 0.08 * curl * i / points, phase + 2.2 * turn * i
        path.append([at[k] + swing * (math.cos(a) * side[k] + math.sin(a) * out[k])
                     for k in range(3)])
        out = unit([out[0], out[1] - 2.2 * step, out[2]])
        at = [at[k] + step * out[k] for k in range(3)]
        size = math.sqrt(sum(c * c for c in at))
        if size < 1.04:  # it lies on the ball, and does not go in
            at = [1.04 * c / size for c in at]
    return path


def shapes(paths, widths):
    yield (f'Attribute "shape" "string basis" "bspline" "float width0" {widths[0]:g} '
           f'"float width1" {widths[1]:g}\n')
    for path in paths:
        numbers = "  ".join(" ".join(f"{c:.3g}" for c in p) for p in path)
        yield f'Shape "curve" "point3 P" [ {numbers} ]\n'


def write(size, seed, folder):
    """Writes strands.pbrt; says what it holds."""
    rng = random.Random(seed)
    folder.mkdir(parents=True, exist_ok=True)
    paths = (strand(rng, rng.uniform(1, 1.6), 12, 0.6) for _ in range(size))
    with open(folder / "strands.pbrt", "w", encoding="ascii") as file:
        file.write(HEAD.format(count=size, seed=seed))
        file.writelines(shapes(paths, (0.004, 0.001)))
    return f"{size} strands, {9 * size} parts"

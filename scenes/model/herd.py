"""Herd: 250 instances of one flake on a floor: objects of many triangles, near each other."""
import random

COUNT = 250

HEADER = """# A herd: {count} instances of a flake of {triangles} triangles.
#
# Purpose: {purpose}
# Needs: object instances, triangles (a PLY file), a plane, diffuse, a distant light, a
#   constant environment.
# Closed form: none. Written by scenes/generate {name} --size {size} --seed {seed}.

LookAt 0 -9 3   0 0 0.5   0 0 1
Camera "perspective" "float fov" [ 40 ]
Film "rgb" "string filename" [ "herd.exr" ]
    "integer xresolution" [ 512 ] "integer yresolution" [ 288 ] "bool savefp16" [ false ]
PixelFilter "box" "float xradius" [ 0.5 ] "float yradius" [ 0.5 ]
Sampler "sobol" "integer pixelsamples" [ 16 ]
Integrator "path" "integer maxdepth" [ 6 ]

WorldBegin

LightSource "infinite" "rgb L" [ 0.3 0.38 0.55 ]
LightSource "distant" "point3 from" [ -5 -1 5 ] "point3 to" [ 0 0 0 ]
    "rgb L" [ 4.6 4.1 3.3 ]
Material "diffuse" "rgb reflectance" [ 0.4 0.37 0.28 ]
Shape "plane"

ObjectBegin "flake"
    Material "diffuse" "rgb reflectance" [ 0.6 0.45 0.3 ]
    Shape "plymesh" "string filename" [ "flake.ply" ]
ObjectEnd

"""

INSTANCE = """AttributeBegin
    Translate {x:.3f} {y:.3f} {z:.4f}
    Rotate {degrees:.1f} 0 0 1
{motion}    Scale {scale:.4f} {scale:.4f} {scale:.4f}
    ObjectInstance "flake"
AttributeEnd
"""

# About as far as a flake is large.
MOTION = """    ActiveTransform EndTime
    Translate {ahead:.3f} 0 0
    Rotate {turn:.1f} 0 0 1
    ActiveTransform All
"""

DEEPEST = 0.98  # how far a flake reaches below its middle, and a little more


def write(mesh, size, seed, folder, moves=False):
    """The scene around a mesh; what it has. Its instances move or stand."""
    folder.mkdir(parents=True, exist_ok=True)
    triangles = mesh.write(folder / "flake.ply")
    text = HEADER.format(count=COUNT, triangles=triangles, size=size, seed=seed,
                         name="moving-herd" if moves else "herd",
                         purpose=__doc__.split(":", 1)[1].strip())
    generator, of_motion = random.Random(seed), random.Random(seed + 1)
    for _ in range(COUNT):
        scale = generator.uniform(0.3, 0.55)
        motion = MOTION.format(ahead=of_motion.uniform(0.2, 0.8),
                               turn=of_motion.uniform(-40, 40)) if moves else ""
        text += INSTANCE.format(x=generator.uniform(-7, 7), y=generator.uniform(-5, 12),
                                z=DEEPEST * scale, degrees=generator.uniform(0, 360),
                                motion=motion, scale=scale)
    (folder / "herd.pbrt").write_text(text, encoding="ascii")
    return f"{COUNT} instances of {triangles} triangles"

"""The head of the kitchen's scene file: camera, lights, materials; in plain pbrt-v4."""

HEAD = """# A kitchen in the morning: COUNTS.
#
# Purpose: rays of a whole interior of many meshes of all sizes, none of them instanced.
# Needs: triangles (PLY files), an environment behind a portal, distant, sphere and
#   rectangle lights; diffuse, coated, metal and glass materials, computed textures.
# Closed form: none. Written by scenes/generate kitchen --seed SEED.

Scale -1 1 1  # x to the right
LookAt CAMERA   0 0 1
Camera "perspective" "float fov" [ 43 ]
Film "rgb" "string filename" [ "kitchen.exr" ]
    "integer xresolution" [ 640 ] "integer yresolution" [ 360 ] "bool savefp16" [ false ]
PixelFilter "gaussian"
Sampler "sobol" "integer pixelsamples" [ 64 ]
Integrator "path" "integer maxdepth" [ 12 ]
    "string lightsampler" "bvh"

WorldBegin
"""

LIGHTS = """
LightSource "infinite" "string filename" [ "sky.pfm" ] "float scale" [ 19 ]
    "point3 portal" [ PORTAL ]
LightSource "distant" "point3 from" [ -3.2 0.55 1.95 ] "point3 to" [ 0 0 0 ]
    "rgb L" [ 15 12.4 9 ]
AttributeBegin
  Translate BULB
  AreaLightSource "diffuse" "rgb L" [ 60 40 21 ]
  Shape "sphere" "float radius" [ 0.045 ]
AttributeEnd
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 40 28 15 ]
  Shape "trianglemesh" "point3 P" [ STRIP ]
      "integer indices" [ 0 2 1  0 3 2 ]
AttributeEnd
# The garden door behind the camera.
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 4 4.15 4.4 ]
  Shape "trianglemesh" "point3 P" [ DOOR ]
      "integer indices" [ 0 2 1  0 3 2 ]
AttributeEnd
"""

# Grain runs along one axis: noise in a space that is stretched along it.
GRAIN = """
AttributeBegin
  Scale {scale}
  Texture "grain {name}" "float" "fbm" "integer octaves" [ 6 ] "float roughness" [ 0.6 ]
AttributeEnd
Texture "figure {name}" "float" "mix" "float tex2" [ 0.5 ] "texture tex1" "grain {name}"
"""

STRETCH = {"x": "0.28 0.016 0.016", "y": "0.016 0.32 0.016", "z": "0.016 0.016 0.28"}

# Name: grain's axis, dark and light colour, roughness.
WOODS = {
    "oak x": ("x", ".38 .22 .105", ".62 .42 .23", .25),
    "oak z": ("z", ".38 .22 .105", ".62 .42 .23", .25),
    "walnut x": ("x", ".17 .085 .04", ".37 .205 .105", .2),
    "walnut z": ("z", ".17 .085 .04", ".37 .205 .105", .2),
    "oak floor 0": ("y", ".36 .225 .125", ".58 .41 .255", .22),
    "oak floor 1": ("y", ".32 .195 .105", ".52 .355 .215", .22),
    "oak floor 2": ("y", ".40 .255 .145", ".62 .44 .28", .22),
    "oak floor 3": ("y", ".28 .17 .09", ".47 .31 .18", .22),
}

COATED = {  # reflectance, roughness
    "cabinet": (".235 .325 .275", .15), "enamel": (".10 .16 .145", .05),
    "glaze 0": (".80 .78 .72", .02), "glaze 1": (".74 .72 .66", .02),
    "glaze 2": (".68 .68 .635", .03), "porcelain": (".82 .81 .78", .01),
    "stoneware": (".58 .50 .40", .08), "indigo": (".055 .10 .22", .03),
    "celadon": (".36 .50 .43", .03), "oven glass": (".006 .006 .007", .005),
    "black": (".02 .02 .02", .1), "paint": (".80 .78 .73", .15),
    "apple": (".50 .055 .03", .05), "apple green": (".38 .48 .08", .05),
    "pear": (".50 .48 .12", .12),
    "orange": (".80 .30 .025", .15), "lemon": (".85 .66 .05", .12),
    "cover red": (".38 .06 .045", .2), "cover blue": (".06 .13 .26", .2),
    "cover green": (".09 .20 .12", .2), "cover ochre": (".60 .38 .09", .2),
    "cover cream": (".70 .64 .50", .2),
}

DIFFUSE = {
    "wall": ".80 .755 .68", "ceiling": ".85 .84 .81", "dark": ".03 .028 .025",
    "paper": ".78 .74 .64", "soil": ".045 .03 .02", "cloth": ".46 .42 .36",
    "cushion": ".46 .19 .10", "towel": ".62 .50 .33", "terracotta": ".52 .23 .12",
    "stalk": ".16 .10 .04", "stem": ".14 .26 .07", "cork": ".48 .31 .17",
    "pasta": ".78 .58 .25", "lentils": ".46 .20 .07", "beans": ".24 .055 .04",
    "flour": ".84 .80 .72",
}

THIN = {  # reflectance, transmittance
    "linen": (".52 .49 .43", ".32 .30 .25"), "leaf": (".075 .21 .045", ".06 .16 .025"),
    "herb": (".12 .30 .055", ".10 .24 .03"), "petal": (".62 .10 .12", ".26 .03 .04"),
}

METALS = {"steel": ("Al", .12), "copper": ("Cu", .05), "brass": ("CuZn", .06),
          "silver": ("Ag", .04), "iron": ("Al", .4)}

OTHERS = """
AttributeBegin
  Scale 0.09 0.09 0.09
  Texture "veins" "float" "wrinkled" "integer octaves" [ 7 ] "float roughness" [ 0.55 ]
AttributeEnd
Texture "marbling" "spectrum" "mix" "rgb tex1" [ 0.80 0.79 0.76 ]
    "rgb tex2" [ 0.42 0.41 0.40 ] "texture amount" "veins"
MakeNamedMaterial "stone" "string type" "coateddiffuse" "texture reflectance" "marbling"
    "float roughness" [ 0.03 ]
Texture "stripes" "spectrum" "checkerboard" "string mapping" "planar"
    "vector3 v1" [ 12 0 0 ] "vector3 v2" [ 0 0.001 0 ]
    "rgb tex1" [ 0.60 0.56 0.48 ] "rgb tex2" [ 0.13 0.20 0.24 ]
MakeNamedMaterial "rug" "string type" "diffuse" "texture reflectance" "stripes"
MakeNamedMaterial "glass" "string type" "dielectric" "float eta" [ 1.5 ]
MakeNamedMaterial "water" "string type" "dielectric" "float eta" [ 1.33 ]
"""


def coated(name, reflectance, roughness):
    return (f'MakeNamedMaterial "{name}" "string type" "coateddiffuse"\n'
            f'    {reflectance} "float roughness" [ {roughness} ]\n')


def wood(name, axis, dark, light, roughness):
    return (f'Texture "{name}" "spectrum" "mix" "rgb tex1" [ {dark} ]\n'
            f'    "rgb tex2" [ {light} ] "texture amount" "figure {axis}"\n'
            + coated(name, f'"texture reflectance" "{name}"', roughness))


def materials():
    parts = [GRAIN.format(name=axis, scale=scale) for axis, scale in STRETCH.items()]
    parts += [wood(name, *values) for name, values in WOODS.items()]
    parts += [coated(name, f'"rgb reflectance" [ {rgb} ]', roughness)
              for name, (rgb, roughness) in COATED.items()]
    parts += [f'MakeNamedMaterial "{name}" "string type" "diffuse" '
              f'"rgb reflectance" [ {rgb} ]\n' for name, rgb in DIFFUSE.items()]
    parts += [f'MakeNamedMaterial "{name}" "string type" "diffusetransmission"\n'
              f'    "rgb reflectance" [ {there} ] "rgb transmittance" [ {through} ]\n'
              for name, (there, through) in THIN.items()]
    parts += [f'MakeNamedMaterial "{name}" "string type" "conductor"\n'
              f'    "spectrum eta" "metal-{metal}-eta" "spectrum k" "metal-{metal}-k" '
              f'"float roughness" [ {roughness} ]\n'
              for name, (metal, roughness) in METALS.items()]
    return "".join(parts) + OTHERS


def sky(x, y, z):
    """Radiance of the sky before its scale: paler towards the horizon, a garden below."""
    del x, y
    haze = (1 - abs(z))**3
    above = 0.36 + 0.5 * haze, 0.54 + 0.38 * haze, 0.86 + 0.12 * haze
    risen = min(max(z / 0.16 + 0.4, 0), 1)  # trees in the haze hide the horizon
    risen *= risen * (3 - 2 * risen)
    return tuple(b + (a - b) * risen for a, b in zip(above, (0.013, 0.021, 0.009)))

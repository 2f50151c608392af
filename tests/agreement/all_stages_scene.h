// Scenes that together need every stage.
#pragma once

#include "src/scene/description/description.h"

namespace lanelight {

/// All shapes, lights of several kinds, many materials, a texture, bumps.
inline constexpr const char* kAllStagesScene = R"(
LookAt 0 2 -6  0 0.8 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 32 "integer yresolution" 32
PixelFilter "gaussian"
Integrator "path" "integer maxdepth" 6
WorldBegin
LightSource "infinite" "rgb L" [ 0.2 0.3 0.4 ]
LightSource "point" "point3 from" [ 2 4 -2 ] "rgb I" [ 9 9 9 ]
LightSource "distant" "rgb L" [ 0.5 0.5 0.5 ]
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 6 5 4 ]
  Translate -2 3 0
  Shape "sphere" "float radius" 0.3
AttributeEnd
LightSource "spot" "point3 from" [ -2 4 -2 ] "point3 to" [ 0 0 0 ] "rgb I" [ 9 9 9 ]
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 3 3 3 ]
  Translate 2 2 -1
  Shape "disk" "float radius" 0.3
AttributeEnd
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 3 3 3 ]
  Shape "trianglemesh" "point3 P" [ 1 3 1  2 3 1  2 3 2 ] "integer indices" [ 0 2 1 ]
AttributeEnd
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 2 3 3 ]
  Shape "trianglemesh" "point3 P" [ -1 3 1  0 3 1  0 3 2  -1 3 2 ]
    "integer indices" [ 0 2 1 0 3 2 ]
AttributeEnd
Texture "checks" "spectrum" "checkerboard" "rgb tex1" [ 0.8 0.2 0.1 ] "rgb tex2" [ 0.1 0.2 0.3 ]
Texture "steps" "float" "checkerboard" "float tex1" 0.01
Material "diffuse" "texture reflectance" "checks" "texture displacement" "steps"
Shape "trianglemesh" "point3 P" [ -5 0 -5  5 0 -5  5 0 5  -5 0 5 ]
  "point2 uv" [ 0 0 4 0 4 4 0 4 ] "integer indices" [ 0 2 1 0 3 2 ]
Material "dielectric" "float eta" 1.5
AttributeBegin
  Translate -0.8 0.7 -1
  Shape "sphere" "float radius" 0.7
AttributeEnd
Material "conductor" "float roughness" 0.2
AttributeBegin
  Translate 0.9 0.8 0
  Shape "sphere" "float radius" 0.8
AttributeEnd
Material "coateddiffuse" "rgb reflectance" [ 0.1 0.3 0.6 ] "float roughness" 0.1
Shape "disk" "float height" 3 "float radius" 2
Material "conductor" "float roughness" 0
AttributeBegin
  Translate 0 0.3 -2
  Shape "sphere" "float radius" 0.3
AttributeEnd
Material "dielectric" "float roughness" 0.3
AttributeBegin
  Translate -2 0.4 -1
  Shape "sphere" "float radius" 0.4
AttributeEnd
Material "coateddiffuse" "float roughness" 0
AttributeBegin
  Translate 2 0.4 -1
  Shape "sphere" "float radius" 0.4
AttributeEnd
Material "coatedconductor"
AttributeBegin
  Translate 1 0.3 -2
  Shape "sphere" "float radius" 0.3
AttributeEnd
Material "thindielectric"
AttributeBegin
  Translate 0 1.6 -1
  Shape "sphere" "float radius" 0.3
AttributeEnd
Material "diffuse" "rgb reflectance" [ 0.5 0.5 0.5 ]
AttributeBegin
  Translate 0 -1 0
  Rotate -90 1 0 0
  Shape "plane"
AttributeEnd
Material "diffusetransmission"
Shape "trianglemesh" "point3 P" [ -3 0 2  3 0 2  3 3 2.5  -3 3 2.5 ]
  "integer indices" [ 0 1 2 0 2 3 ]
)";

// Materials that all become diffuse.
inline constexpr const char* kForcedScene = R"(
Option "forcediffuse" true
LookAt 0 0 -4  0 0 0  0 1 0
Camera "perspective" "float fov" 50
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
WorldBegin
LightSource "infinite" "rgb L" [ 0.6 0.5 0.4 ]
LightSource "point" "point3 from" [ 0 3 -3 ]
Texture "spots" "spectrum" "checkerboard" "rgb tex1" [ 0.8 0.1 0.1 ]
Material "coateddiffuse" "texture reflectance" "spots" "float roughness" 0.2
Shape "sphere" "float radius" 0.7
Material "coatedconductor" "float interface.roughness" 0.1
Translate 1 0 0
Shape "sphere" "float radius" 0.6
Material "dielectric" "float uroughness" 0.3
Translate -2 0 0
Shape "trianglemesh" "integer indices" [ 0 1 2 ] "point3 P" [ -1 -1 0  1 -1 0  0 1 1 ]
)";

/// The features that the other scene lacks: images of lights (sky.pfm) and environments,
/// one behind a portal, mixed materials, the other diffuse models. Also a normal map (the
/// same file), a lens, instances, a cut-out, a lamp with holes, and a sphere far larger
/// than its distance.
inline constexpr const char* kOtherStagesScene = R"(
LookAt 0 2 -6  0 0.8 0  0 1 0
Camera "orthographic" "float screenwindow" [ -3 3 -3 3 ] "float lensradius" 0.05 "float focaldistance" 6
Film "rgb" "integer xresolution" 32 "integer yresolution" 32
PixelFilter "mitchell"
Integrator "path" "integer maxdepth" 6
WorldBegin
LightSource "infinite" "string filename" "sky.pfm"
LightSource "infinite" "string filename" "sky.pfm"
  "point3 portal" [ -2 4 -2  2 4 -2  2 4 2  -2 4 2 ]
LightSource "goniometric" "string filename" "sky.pfm" "rgb I" [ 5 5 5 ]
LightSource "projection" "string filename" "sky.pfm"
Texture "slots" "float" "checkerboard" "float tex1" 1 "float tex2" 0 "float uscale" 8
AttributeBegin
  AreaLightSource "diffuse" "string filename" "sky.pfm"
  Translate 2 2 -1
  Shape "sphere" "float radius" 0.3 "texture alpha" "slots"
AttributeEnd
LightSource "point" "point3 from" [ 2 4 -2 ] "rgb I" [ 9 9 9 ]
MakeNamedMaterial "even" "string type" "diffuse" "string scattering" "uniform"
  "string normalmap" "sky.pfm"
MakeNamedMaterial "narrow" "string type" "diffuse" "string scattering" "insphere"
MakeNamedMaterial "both" "string type" "mix" "string materials" [ "even" "narrow" ]
Texture "holes" "float" "checkerboard" "float tex1" 1 "float tex2" 0
ObjectBegin "roof"
  NamedMaterial "narrow"
  Shape "trianglemesh" "point3 P" [ -1 2 0  1 2 0  0 3 1 ] "integer indices" [ 0 2 1 ]
    "normal N" [ 0 0.9 -0.4  0.3 0.9 -0.3  0 0.8 -0.6 ]
ObjectEnd
ObjectInstance "roof"
AttributeBegin
  Translate 1 -0.5 1
  ObjectInstance "roof"
AttributeEnd
NamedMaterial "both"
Shape "trianglemesh" "point3 P" [ -5 0 -5  5 0 -5  5 0 5  -5 0 5 ]
  "point2 uv" [ 0 0 9 0 9 9 0 9 ] "integer indices" [ 0 2 1 0 3 2 ] "texture alpha" "holes"
NamedMaterial "narrow"
AttributeBegin
  Translate 0 -1 0
  Rotate -90 1 0 0
  Shape "plane"
AttributeEnd
NamedMaterial "even"
AttributeBegin
  Translate 0 -1000.8 0
  Shape "sphere" "float radius" 1000
AttributeEnd
AttributeBegin
  Translate -0.8 0.7 -1
  Shape "sphere" "float radius" 0.7
AttributeEnd
)";
/// The cameras that the others lack; the lenses are in lenses.dat.
/// A camera, a shape with bumps and an instance that move.
inline constexpr const char* kMovingScene = R"(
LookAt 0 2 -6  0 0.8 0  0 1 0
ActiveTransform EndTime
Translate 0.3 0.1 0
ActiveTransform All
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 32 "integer yresolution" 32
WorldBegin
LightSource "infinite" "rgb L" [ 0.2 0.3 0.4 ]
LightSource "point" "point3 from" [ 2 4 -2 ] "rgb I" [ 9 9 9 ]
Texture "steps" "float" "checkerboard" "float tex1" 0.01
Material "diffuse" "texture displacement" "steps"
Shape "trianglemesh" "point3 P" [ -5 0 -5  5 0 -5  5 0 5  -5 0 5 ]
  "point2 uv" [ 0 0 4 0 4 4 0 4 ] "integer indices" [ 0 2 1 0 3 2 ]
ObjectBegin "ball"
  Shape "sphere" "float radius" 0.5
ObjectEnd
Translate -0.5 0.8 0
ObjectInstance "ball"
ActiveTransform EndTime
Translate 0.3 0.1 0.2
Rotate 40 0 1 0
ActiveTransform All
ObjectInstance "ball"
Shape "cylinder" "float radius" 0.3
)";

inline constexpr const char* kSphericalScene = R"(
Camera "spherical"
Film "rgb" "integer xresolution" 32 "integer yresolution" 32
WorldBegin
LightSource "infinite" "rgb L" [ 1 1 1 ]
Shape "sphere" "float radius" 3
)";
inline constexpr const char* kLensesScene = R"(
Camera "realistic" "string lensfile" "lenses.dat" "float aperturediameter" 20
Film "rgb" "integer xresolution" 32 "integer yresolution" 32
PixelFilter "mitchell"
WorldBegin
LightSource "infinite" "rgb L" [ 1 1 1 ]
Translate 0 0 10
Shape "sphere" "float radius" 3
)";

/// Media of both kinds behind interfaces and inside glass, which emit.
inline constexpr const char* kMediaScene = R"(
MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_s" [ 0.1 0.2 0.3 ]
  "rgb sigma_a" [ 0.01 0.02 0.03 ] "float g" 0.4
MakeNamedMedium "smoke" "string type" "uniformgrid" "integer nx" 2 "float density" [ 1 4 ]
  "point3 p0" [ -2 -2 -2 ] "point3 p1" [ 2 2 2 ] "rgb Le" [ 0.1 0.2 0.3 ]
MediumInterface "" "fog"
LookAt 0 1 -6  0 0.8 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 8 "integer yresolution" 8
Integrator "path" "integer maxdepth" 6
WorldBegin
LightSource "point" "point3 from" [ 2 4 -2 ] "rgb I" [ 9 9 9 ]
MediumInterface "smoke" "fog"
Material "interface"
Shape "sphere"
MediumInterface "fog"
Material "diffuse"
Shape "trianglemesh" "point3 P" [ -3 -1 -3  3 -1 -3  3 -1 3  -3 -1 3 ]
  "integer indices" [ 0 1 2 0 2 3 ]
Material "coateddiffuse" "rgb albedo" [ 0.9 0.8 0.7 ] "float thickness" 0.5
AttributeBegin
  Translate 1 0.5 -2
  Shape "sphere" "float radius" 0.6
AttributeEnd
Material "coatedconductor" "rgb albedo" [ 0.9 0.8 0.7 ] "float thickness" 0.5
AttributeBegin
  Translate -1 0.5 -2
  Shape "sphere" "float radius" 0.6
AttributeEnd
)";

/// A medium without a boundary.
inline constexpr const char* kFogScene = R"(
MakeNamedMedium "fog" "string type" "homogeneous" "float scale" 0.01
MediumInterface "" "fog"
LookAt 0 1 -6  0 0.8 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 8 "integer yresolution" 8
WorldBegin
LightSource "point" "point3 from" [ 2 4 -2 ] "rgb I" [ 9 9 9 ]
Shape "sphere"
)";

/// Surfaces that are rougher behind a bounce that is not specular.
inline constexpr const char* kRegularScene = R"(
LookAt 0 1 -6  0 0.8 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
Integrator "path" "bool regularize" true
WorldBegin
LightSource "infinite" "rgb L" [ 0.3 0.4 0.5 ]
Shape "disk" "float radius" 3
Material "dielectric"
Shape "sphere"
)";

/// The insides of materials, with and without a texture.
inline constexpr const char* kInsideScene = R"(
LookAt 0 1 -6  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
Integrator "path" "integer maxdepth" 2
WorldBegin
LightSource "infinite" "rgb L" [ 0.5 0.5 0.5 ]
Texture "checks" "spectrum" "checkerboard" "float uscale" 5 "rgb tex1" [ 0.8 0.2 0.1 ]
Material "subsurface" "texture reflectance" "checks" "float roughness" 0.2
  "rgb mfp" [ 0.2 0.3 0.4 ]
Shape "sphere"
Material "subsurface" "string name" "Skin1" "float scale" 3
AttributeBegin
  Translate 1.6 0 -1
  Shape "sphere" "float radius" 0.5
AttributeEnd
Material "diffuse"
Shape "trianglemesh" "point3 P" [ -3 -1 -3  3 -1 -3  3 -1 3  -3 -1 3 ]
  "integer indices" [ 0 1 2 0 2 3 ]
)";

/// Curves, one of them an instance, of hair and of other materials.
inline constexpr const char* kCurvesScene = R"(
LookAt 0 1 -6  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
WorldBegin
LightSource "infinite" "rgb L" [ 0.5 0.5 0.5 ]
AttributeBegin
  Translate 0 3 -2
  AreaLightSource "diffuse" "rgb L" [ 6 6 6 ]
  Shape "sphere" "float radius" 0.5
AttributeEnd
Material "hair" "rgb sigma_a" [ 0.1 0.3 0.8 ]
Shape "curve" "point3 P" [ -1 -1 0  -0.5 1 0  0.5 -1 0  1 1 0 ] "float width" 0.5
Material "diffuse"
Shape "curve" "string type" "ribbon" "normal N" [ 0 0 -1  0 1 -1 ] "float width" 0.6
  "point3 P" [ -1 1 1  -0.5 -1 1  0.5 1 1  1 -1 1 ]
ObjectBegin "strand"
  Shape "curve" "string type" "cylinder" "point3 P" [ 0 -2 0  0 -1 0  0 1 0  0 2 0 ]
    "float width" 0.3
ObjectEnd
Rotate 30 0 0 1
ObjectInstance "strand"
Shape "trianglemesh" "point3 P" [ -3 -1 -3  3 -1 -3  3 -1 3  -3 -1 3 ]
  "integer indices" [ 0 1 2 0 2 3 ]
)";

/// Measured reflectance, of the file measured.bsdf.
inline constexpr const char* kMeasuredScene = R"(
LookAt 0 1 -6  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
WorldBegin
LightSource "infinite" "rgb L" [ 0.5 0.5 0.5 ]
Material "measured" "string filename" "measured.bsdf"
Shape "sphere"
)";

/// Paths that carry wavelengths: textures, metals, glass that disperses.
inline constexpr const char* kSpectralScene = R"(
LookAt 0 2 -6  0 0.8 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 32 "integer yresolution" 32
Integrator "path" "integer maxdepth" 6 "string transport" "spectral"
WorldBegin
LightSource "infinite" "rgb L" [ 0.2 0.3 0.4 ]
LightSource "point" "point3 from" [ 2 4 -2 ] "blackbody I" 3000
Texture "t" "spectrum" "checkerboard" "rgb tex1" [ 0.8 0.2 0.1 ] "rgb tex2" [ 0.1 0.2 0.8 ]
Material "diffuse" "texture reflectance" "t"
Shape "plane"
Material "conductor" "texture reflectance" "t" "float roughness" 0.3
AttributeBegin
  Translate -1 0.8 0
  Shape "sphere" "float radius" 0.7
AttributeEnd
Material "dielectric" "spectrum eta" "glass-F11"
AttributeBegin
  Translate 0.7 0.8 0
  Shape "sphere" "float radius" 0.7
AttributeEnd
)";

/// The same without textures.
inline constexpr const char* kPlainSpectralScene = R"(
LookAt 0 2 -6  0 0.8 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 32 "integer yresolution" 32
Integrator "path" "integer maxdepth" 6 "string transport" "spectral"
WorldBegin
LightSource "distant" "rgb L" [ 2 2 1 ]
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 6 5 4 ]
  Translate -2 3 0
  Shape "sphere" "float radius" 0.3
AttributeEnd
Material "coateddiffuse" "rgb reflectance" [ 0.7 0.3 0.1 ] "rgb albedo" [ 0.5 0.5 0.5 ]
Shape "sphere" "float radius" 1
Material "conductor"
AttributeBegin
  Translate 1.2 0.8 0
  Shape "sphere" "float radius" 0.7
AttributeEnd
)";

}  // namespace lanelight

// Kinds of what a scene has, which the parser names and kernels choose by.
#pragma once

#include <cstdint>

namespace lanelight {

enum class TextureKind {
  kConstant,
  kScale,
  kMix,
  kCheckerboard,
  kImage,
  kDirectionMix,
  kDots,
  kFbm,
  kWrinkled,
  kWindy,
  kMarble,
  kBilinear,
  // Not of a file; made of other textures when materials are compiled:
  kMetalExtinction,  // k of a metal of index 1 whose reflectance head-on is tex1, times
                     // amount
  kCoatedBase,       // colour of tex1 below a coat (src/scene/compile/coat.h); amount:
                     // its internal reflectance, octaves: bounces off the base
  kRegularAlpha  // alpha of the roughness tex1, or where amount is not 0 of its root, as
                 // Integrator::regularize has it
};
enum class WrapMode { kRepeat, kClamp, kBlack, kOctahedralSphere };

/// The source of texture coordinates: the surface, or the position.
enum class MappingKind { kUv, kSpherical, kCylindrical, kPlanar };
enum class ImageFilter { kPoint, kBilinear, kTrilinear, kEwa };

/// Shapes of curves: kFlat faces each ray; kCylinder too, with normals of a tube; kRibbon
/// lies across a normal of its own.
enum class CurveType : std::uint8_t { kFlat, kCylinder, kRibbon };

/// Diffuse scattering models of the founding paper (docs/scenes.md).
/// kLambertian: density cos/pi. kUniform: directions uniform over the hemisphere,
/// path weight = albedo. kInSphere: normal + point inside the unit sphere, density
/// proportional to cos^3 (2 cos^3 / pi), path weight = albedo.
enum class Scattering { kLambertian, kUniform, kInSphere };

enum class CameraKind { kPerspective, kOrthographic, kSpherical, kRealistic };
enum class SphericalMapping { kEqualArea, kEquirectangular };

/// Film "gbuffer", or --gbuffer: where the first hits are too, and in which space.
enum class Gbuffer : std::uint8_t { kNone, kCamera, kWorld };

/// The content of the three colour columns of a path: red, green and blue, or three
/// wavelengths (src/scene/compiled/spectra.h).
enum class Transport : std::uint8_t { kRgb, kSpectral };

enum class BuildQuality {
  kHigh,
  kFast,  // splits along one axis, no cuts: for previews and huge scenes
};

/// Maximum number of triangles in a leaf of a BVH.
inline constexpr int kLeafTriangles = 16;

}  // namespace lanelight

// Lights of the reference tracer: what a surface emits, what the environment sends, and
// two ways to gather light at a point (delta lights exactly, all others by area).
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tests/reference/geometry.h"
#include "tests/reference/texture.h"

namespace lanelight::reference {

/// Radiance of the environment image of light `light` from the unit direction `toward`,
/// in light space.
using EnvironmentLookup = std::function<Rgb(Index light, Vec3d toward)>;

/// A sampled or exact connection: `radiance` is radiance over density per solid angle
/// (delta lights: irradiance on a surface facing the light).
struct LightConnection {
  Vec3d toward;
  double distance = kInfinity;
  Rgb radiance;
};

/// A point of an emitting shape, and the normal of the side that emits.
struct EmittedPoint {
  int primitive = kNone;
  Vec3d p, n;
};

/// Where a goniometric map is looked up, (s, t) in [0, 1]^2, for a direction d of the
/// light, which pbrt-v4 does not normalise: under a transform that scales, d is longer or
/// shorter than 1, and all that counts of its y is how far that is from 1.
std::array<double, 2> GoniometricPlace(Vec3d d);

class Lights {
 public:
  Lights(const SceneDescription& scene, const Geometry& geometry,
         EnvironmentLookup environment);

  /// Radiance that the primitive emits at `at` towards `toward` (unit).
  Rgb Emitted(int primitive, const SurfacePoint& at, Vec3d toward) const;
  /// Radiance of all environments that arrives at p from direction `toward`.
  Rgb Environment(Vec3d p, Vec3d toward) const;
  /// One connection per light without a shape that is no environment, dark ones left out.
  std::vector<LightConnection> DeltaLights(Vec3d p) const;
  /// One random point, uniform by area, on every emitter, and one uniform direction to
  /// every environment; points that face away are left out.
  std::vector<LightConnection> AreaLights(Vec3d p, Random& random) const;
  /// The same of emitters alone that no ray meets (alpha 0): what they show is as if they
  /// were whole.
  std::vector<LightConnection> UnseenLights(Vec3d p, Random& random) const;

  /// Returns a point from which a light subpath starts: of a shape chosen by power,
  /// uniform over its area, and of either side. Empty if the shape has an image, or if
  /// there is none.
  std::optional<EmittedPoint> SampleEmission(Random& random) const;
  /// Returns the density of SampleEmission, by area, on this primitive.
  double EmissionDensity(int primitive) const;
  /// Returns the number of sides of a light that emit.
  int Sides(int primitive) const;

 private:
  struct Emitter {
    int primitive = kNone;
    double area = 0;
    Rgb radiance;
    bool two_sided = false;
    Index image = kNone;
  };
  LightConnection SampleEmitter(const Emitter& emitter, Vec3d p, Random& random) const;
  Rgb InfiniteRadiance(Index light, Vec3d p, Vec3d toward) const;
  Rgb PortalRadiance(const Light& light, Index image, Vec3d p, Vec3d toward) const;
  Rgb PointIntensity(Index light, Vec3d away) const;
  double PowerOf(const Emitter& emitter) const;
  bool IsUnseen(const Emitter& emitter) const;
  bool IsEven(const Emitter& emitter) const;
  Rgb RadianceAt(const Emitter& emitter, const Ray& ray, double distance) const;
  Rgb EmittedAt(const Emitter& emitter, double u, double v) const;
  Index AddImage(const std::string& path, WrapMode wrap, bool bilinear);

  const SceneDescription& scene_;
  const Geometry& geometry_;
  EnvironmentLookup environment_;
  std::vector<Emitter> emitters_;
  std::vector<int> emitter_of_;  // per primitive, kNone = dark
  std::vector<Index> infinite_;
  std::vector<Texture> images_;
  std::vector<Index> light_images_;     // of each light, kNone = none
  std::unique_ptr<Textures> textures_;  // of images_
};

/// World-space area. Throws CheckFailure for a plane or a non-uniformly scaled shape.
double PrimitiveArea(const Primitive& primitive);

}  // namespace lanelight::reference

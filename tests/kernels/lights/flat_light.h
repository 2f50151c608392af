// A single triangle or rectangle that emits, above, beside or around a receiver at the
// origin: what the kernels sample there, and its solid angle in double precision.
#pragma once

#include <cstdint>
#include <vector>

#include "src/base/core/vec.h"
#include "tests/support/wave_fixture.h"

namespace lanelight::test {

inline constexpr float kPmf = 0.75f;            // of the light's selection
inline constexpr double kMinSolidAngle = 1e-7;  // as in kernels/warp/solid_angle-inl.h

/// A light from `corner` along two sides, which for a rectangle are at right angles.
struct Flat {
  const char* name;
  Vec3d corner, x, y;
  bool rectangle;

  Vec3d At(double u, double v) const { return corner + x * u + y * v; }
  Vec3d Normal() const { return Normalize(Cross(x, y)); }
  double Area() const { return Length(Cross(x, y)) / (rectangle ? 1 : 2); }
};

double TriangleAngle(Vec3d a, Vec3d b, Vec3d c);
/// Returns the solid angle of the parallelogram between two corners, in the sides'
/// coordinates.
double PartAngle(const Flat& f, double u0, double v0, double u1, double v1);
double AngleOf(const Flat& f);

/// Returns lights from grazing to frontal: from 1.2e-4 rad (by area) and 5e-4 rad (by
/// solid angle) to 1000 times the distance, and from beside the light to 1e-3 of its size
/// above it.
std::vector<Flat> FlatLights();
/// What the kernels see: positions and edges are floats.
Flat Rounded(Flat f);

/// Light samples of the receiver.
struct Draw {
  const Flat& light;
  CompiledScene scene;
  LightChances chances;
  WaveFixture fixture;

  /// normal: of the receiver; paths come from that side, and see either side of the
  /// surface's own.
  Draw(const Flat& f, std::uint32_t count, const FeatureSet& features = Angle(),
       bool two_sided = true, Vec3d normal = {0, 0, 1});
  static FeatureSet Angle() { return {Feature::kSolidAngleLights}; }

  /// Where on the light, in units of its sides. Shadow rays end a little in front of it.
  Vec3d Where(std::uint32_t i) const;
  /// Scattered rays along the light samples, with their density: by the balance heuristic
  /// half of the radiance is theirs.
  void Hit(std::uint32_t count, const FeatureSet& features);
};

}  // namespace lanelight::test

// Light samples on pictured shapes from one place, and what rays to them see.
#pragma once

#include <cstdint>
#include <vector>

#include "src/scene/prepare/prepared_scene.h"
#include "tests/kernels/lights/pictured_shapes.h"
#include "tests/support/wave_fixture.h"

namespace lanelight::test {

inline constexpr std::uint32_t kPictureSamples = 1 << 14;

/// kPictureSamples samples of the pictured shape, with its image, from one place of the
/// world. `power` of the random numbers: 1 for uniform ones.
class PictureSamples {
 public:
  PictureSamples(const PicturedShape& shape, Vec3d place, double power = 1);

  const PreparedScene& scene() const { return scene_; }
  Vec3d from() const { return from_; }
  /// Probability of choosing the shape's light.
  double Pmf() const;
  std::vector<Vec3d> Directions() const;  // unit
  /// Of sample i, per solid angle; the choice of the light included.
  double Pdf(std::uint32_t i) const { return fixture_.wave.path.ls_pdf[i]; }
  /// That sample i connects to.
  Rgb Radiance(std::uint32_t i) const;

 private:
  PreparedScene scene_;
  Vec3d from_;
  WaveFixture fixture_;
};

/// What rays from a place of the world along the directions add to their paths, weighted
/// against light samples; `bsdf_pdf`: density of the material that chose them.
std::vector<Rgb> SeenAlong(const PreparedScene& scene, Vec3d from,
                           const std::vector<Vec3d>& directions, float bsdf_pdf);

/// A density of materials by which rays have all weight.
inline constexpr float kLargePdf = 1e15f;

/// Densities of light samples along the directions that rays know, by their weight; 0
/// beside the light.
std::vector<double> DensitiesAlong(const PreparedScene& scene, Vec3d from,
                                   const std::vector<Vec3d>& directions);

}  // namespace lanelight::test

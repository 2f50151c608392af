// Scenes and comparisons for tests of control variates.
#pragma once

#include <numbers>

#include "tests/agreement/agreement.h"

namespace lanelight::test {

/// All pixels look at (almost) the same point, the origin of a large plane of this
/// material with normal +z, so that nothing but random numbers varies f.
inline SceneBuilder PointReceiver(const Material& material, int size = 4) {
  SceneBuilder b(size, size);
  b.Depth(1).Orthographic({0, 0, 0.5}, {0, 0, 0}, {0, 1, 0}, 1e-5);
  b.AddDisk({0, 0, 0}, {0, 0, 1}, 0.05, b.AddMaterial(material));
  return b;
}

inline Material Lambert(Rgb albedo) {
  Material m;
  m.reflectance.constant = albedo;
  return m;
}
inline Material Leaf(Rgb reflectance, Rgb transmittance) {
  Material m;
  m.kind = MaterialKind::kDiffuseTransmission;
  m.reflectance.constant = reflectance;
  m.transmittance.constant = transmittance;
  return m;
}

inline Rendered RenderWith(const SceneDescription& scene, const std::string& strategy,
                           std::uint64_t spp, std::uint64_t seed = 1) {
  TestRender options;
  options.spp = spp;
  options.seed = seed;
  options.strategy = strategy;
  Rendered render = RenderDescription(scene, options);
  CHECK(render.result.health.Total() == 0);
  return render;
}

/// Mean of the pixels' variances, of all channels.
inline double MeanVariance(const Rendered& render) {
  const stat::ImageEstimate e = Estimate(render);
  double sum = 0;
  for (Rgb v : e.variance) sum += v.x + v.y + v.z;
  return sum / double(e.variance.size());
}

inline stat::ImageTestResult Compare(const Rendered& a, const Rendered& b,
                                     double tolerance = kFloatTolerance) {
  return stat::CompareMeans(Estimate(a), Estimate(b), {4, 1e-6, tolerance, 1e-7});
}

/// Pixels are bit-identical.
inline bool Identical(const Rendered& a, const Rendered& b) {
  const stat::ImageEstimate x = Estimate(a), y = Estimate(b);
  return x.mean == y.mean && x.variance == y.variance;
}

/// The image does not depend on threads and wavefront.
inline void CheckDeterminism(const SceneDescription& scene, const std::string& strategy,
                             std::uint64_t spp) {
  TestRender options;
  options.spp = spp;
  options.strategy = strategy;
  options.threads = 1;
  options.wavefront = 1000;
  const Rendered base = RenderDescription(scene, options);
  for (std::uint32_t wavefront : {64u, 8192u}) {
    options.threads = 2;
    options.wavefront = wavefront;
    INFO(strategy << ", wavefront " << wavefront);
    CHECK(Identical(RenderDescription(scene, options), base));
  }
}

}  // namespace lanelight::test

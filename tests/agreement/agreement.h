// Compares the wavefront with the scalar reference and with closed forms.
#pragma once

#include <catch2/catch.hpp>

#include "tests/reference/compare.h"
#include "tests/reference/scenes.h"
#include "tests/reference/texture.h"
#include "tests/render/run/render_fixture.h"
#include "tests/support/test_target.h"

namespace lanelight::test {

/// Single precision: relative error of converged means that is rounding, not bias.
inline constexpr double kFloatTolerance = 1e-4;

inline stat::ImageEstimate Estimate(const Rendered& render) {
  const FilmAccumulator& film = render.film;
  stat::ImageEstimate out = {film.width(), film.height(), 0, {}, {}};
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x) {
      out.mean.push_back(film.Mean(film.x0() + x, film.y0() + y));
      out.variance.push_back(film.Variance(film.x0() + x, film.y0() + y));
    }
  }
  out.observations = static_cast<double>(film.Observations(film.x0(), film.y0()));
  return out;
}

/// Renders with the independent sampler, unless `strategy` says otherwise, and requires
/// that no sample was bad.
inline stat::ImageEstimate RenderWavefront(const SceneDescription& scene,
                                           std::uint64_t spp,
                                           const std::string& strategy = "") {
  TestRender options;
  options.spp = spp;
  if (!strategy.empty()) options.strategy = strategy;
  const Rendered render = RenderDescription(scene, options);
  CHECK(render.result.health.Total() == 0);
  return Estimate(render);
}

/// Options of the reference with a scene's textures.
inline TwinOptions TexturedOptions(const reference::Textures& textures,
                                   ReferenceEstimator estimator, int samples) {
  TwinOptions options = Options(estimator, samples);
  options.texture = [&](Index index, const reference::TexturePoint& at) {
    return textures.Eval(index, at);
  };
  options.normal_map = [](const std::string& path, double u, double v) {
    return reference::NormalMap(path, u, v);
  };
  return options;
}

/// Wavefront against reference. `tolerance` is relative, on top of the noise.
inline stat::ImageTestResult CompareWithReference(const SceneDescription& scene,
                                                  std::uint64_t wavefront_spp,
                                                  int reference_spp,
                                                  double tolerance = kFloatTolerance,
                                                  const std::string& strategy = "") {
  const reference::Textures textures(scene.textures);
  const TwinOptions options =
      TexturedOptions(textures, ReferenceEstimator::kLightSampling, reference_spp);
  return stat::CompareMeans(RenderWavefront(scene, wavefront_spp, strategy),
                            Estimate(RenderReference(scene, options)),
                            {4, 1e-6, tolerance, 1e-7});
}

/// No difference, where one of `power` (relative) would have been seen.
inline void CheckAgreement(const SceneDescription& scene, std::uint64_t spp,
                           int reference_spp, double power) {
  stat::CheckSame(CompareWithReference(scene, spp, reference_spp), power);
}

/// The same on every SIMD target, without a power.
inline void CheckAgreementOnTargets(const SceneDescription& scene, std::uint64_t spp,
                                    int reference_spp) {
  const auto reference = Estimate(
      RenderReference(scene, Options(ReferenceEstimator::kLightSampling, reference_spp)));
  for (const std::string& target : AvailableTargets()) {
    ForceTarget(target);
    stat::CheckSame(stat::CompareMeans(RenderWavefront(scene, spp), reference,
                                       {4, 1e-6, kFloatTolerance, 1e-7}),
                    target);
  }
  ForceTarget("");
}

}  // namespace lanelight::test

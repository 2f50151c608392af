#include "src/scene/compile/camera.h"

#include <catch2/catch.hpp>

#include <cmath>

#include "tests/scene/compile/testing.h"

namespace lanelight {
namespace {

// Mean of g over the signed distribution that the tables stand for: what a renderer's
// filtered image converges to when g is the image along one axis.
template <typename G>
double TableMean(const AlignedVector<float>& cdf, const AlignedVector<float>& sign,
                 double radius, const G& g) {
  constexpr int kSteps = 200;
  double sum = 0, norm = 0;
  for (int i = 0; i < CompiledFilter::kSize; ++i) {
    const double mass = double(cdf[i + 1]) - cdf[i];
    norm += mass * sign[i];
    for (int s = 0; s < kSteps; ++s) {
      const double t = (i + (s + 0.5) / kSteps) / CompiledFilter::kSize;
      sum += mass * sign[i] * g(radius * (2 * t - 1)) / kSteps;
    }
  }
  return sum / norm;
}

template <typename G>
double ExactMean(const Filter& filter, double radius, const G& g) {
  constexpr int kSteps = 20000;
  double sum = 0, norm = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double x = radius * (2 * (i + 0.5) / kSteps - 1);
    const double f = EvaluateFilter(filter, radius, x);
    sum += f * g(x);
    norm += f;
  }
  return sum / norm;
}

Filter Make(FilterKind kind, double x_radius, double y_radius) {
  Filter filter;
  filter.kind = kind;
  filter.x_radius = x_radius;
  filter.y_radius = y_radius;
  return filter;
}

TEST_CASE("compile: box filter has no tables", "[scene][compile]") {
  const CompiledFilter f = CompileFilter(Make(FilterKind::kBox, 0.5, 2));
  CHECK(f.is_box);
  CHECK(f.x_cdf.empty());
  CHECK(f.x_radius == 0.5f);
  CHECK(f.y_radius == 2.0f);
  CHECK(f.weight == 1);
}

TEST_CASE("compile: filter tables integrate like the filter", "[scene][compile]") {
  for (FilterKind kind : {FilterKind::kTriangle, FilterKind::kGaussian,
                          FilterKind::kMitchell, FilterKind::kLanczos}) {
    INFO("filter " << static_cast<int>(kind));
    const Filter filter = Make(kind, 2, 3.5);
    const CompiledFilter f = CompileFilter(filter);
    CHECK_FALSE(f.is_box);
    REQUIRE(f.x_cdf.size() == 65);
    REQUIRE(f.y_sign.size() == 64);
    CHECK(f.x_cdf.front() == 0);
    CHECK(f.x_cdf.back() == 1);
    for (int i = 0; i < 64; ++i) CHECK(f.y_cdf[i + 1] >= f.y_cdf[i]);
    // An edge at a bin boundary, a slope, a curve; the last two within the bin width.
    const auto step = [](double x) { return x < 0.5 ? 0.0 : 1.0; };
    const auto square = [](double x) { return x * x; };
    const auto slope = [](double x) { return x; };
    CHECK(TableMean(f.x_cdf, f.x_sign, 2, step) ==
          Approx(ExactMean(filter, 2, step)).margin(1e-4));
    CHECK(TableMean(f.x_cdf, f.x_sign, 2, slope) == Approx(0).margin(1e-6));
    CHECK(TableMean(f.x_cdf, f.x_sign, 2, square) ==
          Approx(ExactMean(filter, 2, square)).margin(2e-3));
    CHECK(TableMean(f.y_cdf, f.y_sign, 3.5, square) ==
          Approx(ExactMean(filter, 3.5, square)).margin(6e-3));
    // weight = integral |f| / integral f, so that the mean of sign * weight is 1.
    const auto total = [](const AlignedVector<float>& cdf,
                          const AlignedVector<float>& s) {
      double sum = 0;
      for (int i = 0; i < 64; ++i) sum += (double(cdf[i + 1]) - cdf[i]) * s[i];
      return sum;
    };
    CHECK(f.weight * total(f.x_cdf, f.x_sign) * total(f.y_cdf, f.y_sign) ==
          Approx(1).epsilon(1e-5));
  }
}

TEST_CASE("compile: filter values as pbrt defines them", "[scene][compile]") {
  CHECK(EvaluateFilter(Make(FilterKind::kTriangle, 2, 2), 2, 0.5) == 1.5);
  CHECK(EvaluateFilter(Make(FilterKind::kTriangle, 2, 2), 2, -2.1) == 0);
  Filter gaussian = Make(FilterKind::kGaussian, 1.5, 1.5);
  CHECK(EvaluateFilter(gaussian, 1.5, 1.5) == 0);
  // 1 / (0.5 sqrt(2 pi)) (1 - exp(-4.5))
  CHECK(EvaluateFilter(gaussian, 1.5, 0) == Approx(0.797884561 - 0.008863697));
  const Filter mitchell = Make(FilterKind::kMitchell, 2, 2);
  CHECK(EvaluateFilter(mitchell, 2, 0) == Approx(16. / 18));
  CHECK(EvaluateFilter(mitchell, 2, 1) == Approx(1. / 18));
  CHECK(EvaluateFilter(mitchell, 2, 2) == Approx(0).margin(1e-15));
  CHECK(EvaluateFilter(mitchell, 2, 1.5) < 0);
  const Filter lanczos = Make(FilterKind::kLanczos, 4, 4);
  CHECK(EvaluateFilter(lanczos, 4, 0) == 1);
  CHECK(EvaluateFilter(lanczos, 4, 1) == Approx(0).margin(1e-15));
  // sinc(1.5) sinc(0.5) = (-2/(3 pi)) (2/pi)
  CHECK(EvaluateFilter(lanczos, 4, 1.5) == Approx(-0.135094911));
}

TEST_CASE("compile: signs only where a filter is negative", "[scene][compile]") {
  SceneDescription d = SquareScene();
  d.filter = Make(FilterKind::kTriangle, 2, 2);
  CHECK_FALSE(CompileScene(d).features.Has(Feature::kSignedFilter));
  CHECK(CompileScene(d).filter.weight == 1);
  d.filter = Make(FilterKind::kGaussian, 1.5, 1.5);
  CHECK_FALSE(CompileScene(d).features.Has(Feature::kSignedFilter));
  d.filter = Make(FilterKind::kMitchell, 2, 2);
  const CompiledScene scene = CompileScene(d);
  CHECK(scene.features.Has(Feature::kSignedFilter));
  CHECK(scene.filter.weight > 1);
  CHECK(scene.filter.x_sign[4] == -1);
  CHECK(scene.filter.x_sign[32] == 1);
  d.filter = Make(FilterKind::kMitchell, 2, 2);
  d.filter.b = 1;  // a B-spline: positive
  d.filter.c = 0;
  CHECK_FALSE(CompileScene(d).features.Has(Feature::kSignedFilter));
}

TEST_CASE("compile: impossible filters are refused", "[scene][compile]") {
  SceneDescription d = SquareScene();
  d.filter = Make(FilterKind::kTriangle, 0, 1);
  CHECK(CompileError(d).find("radius of the pixel filter is 0") != std::string::npos);
  d.filter = Make(FilterKind::kGaussian, 1, 1);
  d.filter.sigma = 0;
  CHECK(CompileError(d).find("positive integral") != std::string::npos);
}

}  // namespace
}  // namespace lanelight

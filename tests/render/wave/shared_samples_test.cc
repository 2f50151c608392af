// pixel-samples=shared: means are those of own samples, for every filter and at the
// borders of tiles; less noise; and errors no more alike than the film states.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "src/base/core/error.h"
#include "src/render/wave/shared_samples.h"
#include "src/render/wave/tiles.h"
#include "src/scene/compile/camera.h"
#include "tests/kernels/reuse/same_light.h"
#include "tests/reference/scenes.h"
#include "tests/render/run/correlations.h"
#include "tests/render/run/render_fixture.h"

namespace lanelight::test {
namespace {

Filter FilterOf(FilterKind kind, double x_radius, double y_radius) {
  Filter filter;
  filter.kind = kind;
  filter.x_radius = x_radius;
  filter.y_radius = y_radius;
  return filter;
}

const Filter kFilters[] = {
    FilterOf(FilterKind::kGaussian, 1.5, 1.5), FilterOf(FilterKind::kTriangle, 2, 1),
    FilterOf(FilterKind::kBox, 1, 0.5),        FilterOf(FilterKind::kMitchell, 2, 2),
    FilterOf(FilterKind::kLanczos, 4, 4),      FilterOf(FilterKind::kGaussian, 0.4, 1.2)};

// Places along an axis: two in each bin.
constexpr std::uint32_t kSteps = 2 * CompiledFilter::kSize;

// Density of samples at a place, in bins, over that of the grid.
double DensityAt(bool is_box, const AlignedVector<float>& cdf, float place) {
  if (is_box) return 1;
  const auto bin = std::size_t(place);
  return double(cdf[bin + 1] - cdf[bin]) * CompiledFilter::kSize;
}

// Samples of a tile at all places of a grid.
struct Grid {
  PixelRect tile = {16, 32, 24, 38};
  std::vector<std::uint32_t> pixels;
  std::vector<float> places, values;
  TilePlanes planes;

  Grid() : places(2 * kSteps * kSteps), planes{tile, pixels} {
    TilePixels(tile, 100, &pixels);
    constexpr std::uint32_t kCount = kSteps * kSteps;
    for (std::uint32_t i = 0; i < kCount; ++i) {
      places[i] = (float(i % kSteps) + 0.5f) / 2;
      places[kCount + i] = (float(i / kSteps) + 0.5f) / 2;
    }
    values.resize(3 * pixels.size() * kCount);
    planes.count = kCount;
    planes.values = values.data();
    planes.stride = pixels.size() * kCount;
  }
  // Sets all samples to a function of their position on the film, times the filter's
  // weight, and times the density of samples.
  template <class Function>
  void Fill(const CompiledFilter& filter, const Function& f) {
    const auto offset = [](float place, float radius) {
      return double(place) * 2 * double(radius) / CompiledFilter::kSize - double(radius);
    };
    for (std::size_t p = 0; p < pixels.size(); ++p) {
      for (std::uint32_t i = 0; i < planes.count; ++i) {
        const float x = places[i], y = places[planes.count + i];
        double weight = double(filter.weight) *
                        DensityAt(filter.is_box, filter.x_cdf, x) *
                        DensityAt(filter.is_box, filter.y_cdf, y);
        if (!filter.is_box) {
          weight *= double(filter.x_sign[std::size_t(x)] * filter.y_sign[std::size_t(y)]);
        }
        const double value =
            weight * f(pixels[p] % 100 + offset(x, filter.x_radius),
                       double(pixels[p] / 100) + offset(y, filter.y_radius));
        for (std::size_t c = 0; c < 3; ++c) {
          values[c * planes.stride + p * planes.count + i] = float(value * double(c + 1));
        }
      }
    }
  }
  std::vector<double> Means(std::size_t plane) const {
    std::vector<double> means;
    for (std::size_t p = 0; p < pixels.size(); ++p) {
      const auto first = values.begin() + long(plane * planes.stride + p * planes.count);
      means.push_back(std::accumulate(first, first + planes.count, 0.0) / planes.count);
    }
    return means;
  }
};

double Wavy(double x, double y) { return 2 + 0.1 * x + std::sin(0.8 * x + 0.5 * y); }

// A room of diffuse walls with a lamp in view, whose edges are integrated apart, or
// behind the camera.
SceneDescription LampInRoom(const Filter& filter, bool in_view = true) {
  SceneBuilder b(24, 24);
  b.Depth(4).Perspective({0, -3.5, 1}, {0, 0, 1}, {0, 0, 1}, 40);
  const Index grey = b.AddDiffuse(Grey(0.6));
  b.AddQuad({-2, -4, 0}, {4, 0, 0}, {0, 6, 0}, grey);
  b.AddQuad({-2, 2, 0}, {4, 0, 0}, {0, 0, 3}, b.AddDiffuse({0.7, 0.4, 0.2}));
  b.AddQuad({-0.3, in_view ? 1.5 : -3.9, 1.1}, {0.7, 0.1, 0}, {0.1, 0, 0.5},
            b.AddDiffuse(Grey(0)), b.AddEmission(Grey(30), true));
  SceneDescription scene = b.Build();
  scene.filter = filter;
  return scene;
}

Rendered RenderLampInRoom(const Filter& filter, const std::string& strategy,
                          std::uint64_t spp) {
  TestRender t;
  t.spp = spp;
  t.strategy = strategy;
  return RenderDescription(LampInRoom(filter), t);
}

}  // namespace

TEST_CASE("shared samples have the mean of own samples, for every filter and pixel",
          "[shared-samples]") {
  for (const Filter& description : kFilters) {
    const CompiledFilter filter = CompileFilter(description);
    Grid grid;
    grid.Fill(filter, Wavy);
    const std::vector<double> own = grid.Means(0);
    SampleSharing(filter).Share(grid.planes, grid.places.data());
    const std::vector<double> shared = grid.Means(0), third = grid.Means(2);
    for (std::size_t p = 0; p < own.size(); ++p) {
      INFO(int(description.kind) << ", pixel " << p);
      CHECK(shared[p] == Approx(own[p]).epsilon(2e-3));
      CHECK(third[p] == Approx(3 * shared[p]).epsilon(1e-5));
    }
  }
}

TEST_CASE("what is added later has the weights of shared samples", "[shared-samples]") {
  for (const Filter& description : kFilters) {
    const CompiledFilter filter = CompileFilter(description);
    Grid shared, added;
    // Only every 37th sample has light.
    shared.Fill(filter, Wavy);
    for (std::size_t i = 0; i < shared.values.size(); ++i) {
      if (i % 37 != 0) shared.values[i] = 0;
    }
    const std::vector<float> before = shared.values;
    SampleSharing sharing(filter);
    sharing.Share(added.planes, added.places.data());  // zeros
    const std::uint32_t count = added.planes.count;
    for (std::size_t at = 0; at < added.planes.stride; ++at) {
      const std::array<double, 3> light = {double(before[at]),
                                           double(before[at + added.planes.stride]),
                                           double(before[at + 2 * added.planes.stride])};
      const auto i = std::uint32_t(at % count);
      sharing.Add(added.planes, {at / count, i}, added.places[i], added.places[count + i],
                  light);
    }
    sharing.Share(shared.planes, shared.places.data());
    double largest = 0;
    for (std::size_t i = 0; i < shared.values.size(); ++i) {
      largest = std::max(largest, double(std::abs(shared.values[i] - added.values[i])));
    }
    CHECK(largest < 1e-4);
  }
}

TEST_CASE("inside a tile the weights of each sample index add up to 1",
          "[shared-samples]") {
  const CompiledFilter filter = CompileFilter(kFilters[0]);
  Grid grid;
  std::ranges::fill(grid.values, 1.0f);
  SampleSharing(filter).Share(grid.planes, grid.places.data());
  for (std::size_t p = 0; p < grid.pixels.size(); ++p) {
    const int x = int(grid.pixels[p] % 100), y = int(grid.pixels[p] / 100);
    if (x < grid.tile.x0 + 2 || x >= grid.tile.x1 - 2) continue;
    if (y < grid.tile.y0 + 2 || y >= grid.tile.y1 - 2) continue;
    for (std::uint32_t i = 0; i < grid.planes.count; i += 7) {
      REQUIRE(grid.values[p * grid.planes.count + i] == Approx(1).epsilon(1e-5));
    }
  }
}

TEST_CASE("shared samples: edges of lamps, path reuse and light subpaths keep the image",
          "[shared-samples]") {
  for (const Filter& filter : {kFilters[0], kFilters[3]}) {
    ReuseScene scene = {LampInRoom(filter)};
    for (const char* other :
         {"points=sobol", "points=sobol,seen-lights=paths",
          "points=independent,pairs=antithetic", "points=halton,reuse=block:16",
          "light-paths=splats:2", "points=sobol,roulette=adjoint"}) {
      CheckSame(scene, other, "pixel-samples=shared");
    }
  }
}

TEST_CASE("shared samples leave less noise", "[shared-samples]") {
  const auto noise = [](const std::string& choice) {
    double sum = 0;
    const Rendered r = RenderLampInRoom(kFilters[0], "pixel-samples=" + choice, 256);
    ForEachPixel(r.film, [&](int x, int y) { sum += r.film.Variance(x, y).y; });
    return sum;
  };
  CHECK(noise("shared") < 0.6 * noise("own"));
}

TEST_CASE("shared samples: errors of pixels are no more alike than the film states",
          "[shared-samples]") {
  for (const char* other : {"reuse=none", "reuse=block:64"}) {
    std::vector<std::vector<double>> renders;
    double dependents = 0;
    for (std::uint64_t seed = 1; seed <= 256; ++seed) {
      TestRender t;
      // With fewer, what all samples of a tile miss of a gradient shows.
      t.spp = 128;
      t.seed = seed;
      t.strategy = std::string("points=sobol,pixel-samples=shared,") + other;
      const Rendered r = RenderDescription(LampInRoom(kFilters[0], false), t);
      dependents = r.film.groups().dependents;
      renders.emplace_back();
      ForEachPixel(r.film,
                   [&](int x, int y) { renders.back().push_back(r.film.Mean(x, y).y); });
    }
    const double measured = SquaredCorrelations(renders);
    INFO(other << ": " << measured << " of " << dependents);
    CHECK(measured < dependents);
    CHECK(measured > dependents / 6);
  }
}

TEST_CASE("shared samples are refused or without effect where they cannot help",
          "[shared-samples]") {
  const Filter box = FilterOf(FilterKind::kBox, 0.5, 0.5);
  const Rendered own = RenderLampInRoom(box, "pixel-samples=own", 8);
  const Rendered shared = RenderLampInRoom(box, "pixel-samples=shared", 8);
  CHECK_FALSE(shared.plan.features.Has(Feature::kSharedPixelSamples));
  CHECK(Identical(own.film, shared.film));
  CHECK(shared.plan.notes.size() == own.plan.notes.size() + 1);
  CHECK_THROWS_AS(
      RenderLampInRoom(kFilters[0], "pixel-samples=shared,control=regression", 8),
      InputError);
}

}  // namespace lanelight::test

// Participating media: optical depths, phase functions, units, grids, shells of glass.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>

#include "src/base/core/pi.h"
#include "tests/extremes/check_points.h"

namespace lanelight::stress {
namespace {

// Every path is its material's and phase function's own: nothing is chosen by chance that
// changes what a path weighs.
const char* kPlainPaths = "directions=bsdf,roulette=none,points=independent";

std::string Homogeneous(const std::string& name, double sigma_a, double sigma_s,
                        double g = 0, double emission = 0) {
  return fmt::format("MakeNamedMedium \"{}\" \"string type\" \"homogeneous\"", name) +
         Grey("sigma_a", sigma_a) + Grey("sigma_s", sigma_s) + Grey("Le", emission) +
         fmt::format(" \"float g\" {:.17g}\n", g);
}

// The medium between z = -unit and 0, as wide as 100 units, behind interfaces.
std::string Slab(const std::string& medium, double unit = 1) {
  MeshText block;
  const double w = 50 * unit, d = -unit;
  block.AddQuad({-w, -w, 0}, {w, -w, 0}, {w, w, 0}, {-w, w, 0});
  block.AddQuad({-w, -w, d}, {-w, w, d}, {w, w, d}, {w, -w, d});
  block.AddQuad({-w, -w, d}, {w, -w, d}, {w, -w, 0}, {-w, -w, 0});
  block.AddQuad({-w, w, 0}, {w, w, 0}, {w, w, d}, {-w, w, d});
  block.AddQuad({-w, -w, 0}, {-w, w, 0}, {-w, w, d}, {-w, -w, d});
  block.AddQuad({w, -w, d}, {w, w, d}, {w, w, 0}, {w, -w, 0});
  return Block(
      fmt::format("MediumInterface \"{}\" \"\"\nMaterial \"interface\"\n", medium) +
      block.Text());
}

std::string ViewOfSlab(double unit = 1) {
  return CameraText({0, 0, 3 * unit}, {0, 0, 0}, 0.01) + "WorldBegin\n";
}

std::string Ball(const std::string& medium, const std::string& outside, double radius,
                 const std::string& material) {
  return Block(fmt::format("MediumInterface \"{}\" \"{}\"\n", medium, outside) +
               Sphere({}, radius, material));
}

std::string ViewOfBall() { return ViewFrom({0, 0, 5}, 20); }

// A slab that only absorbs, and one that emits too: products, without noise.
std::vector<Point> SlabByDepth(double depth, const Effort& effort) {
  Point dimmed = Expect(std::exp(-depth),
                        ViewOfSlab() + Homogeneous("m", depth, 0) + Slab("m") + Sky(1),
                        {4, 64}, effort);
  dimmed.scale = 1;
  dimmed.tolerance += 0x1p-126;  // below it float32 has fewer digits, or none
  Point glow = Expect(-std::expm1(-depth),
                      ViewOfSlab() + Homogeneous("m", depth, 0, 0, 1) + Slab("m"),
                      {4, 64}, effort);
  return {Named("absorbs", dimmed), Named("emits", glow)};
}

// Light of a distant lamp that a slab scatters once: (sigma_s / sigma_t) p L times an
// integral of exponentials. `from` is +1 for a lamp on the camera's side.
Point ScatteredOnce(double g, double unit, int from, const Effort& effort) {
  const double absorbed = 0.3, scattered = 0.7, mu = 0.8;
  const double cosine = from > 0 ? -mu : mu;  // of the angle of scattering
  const double phase =
      (1 - g * g) / (4 * kPi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
  // The slab is one deep: t along the view, t / mu or (1 - t) / mu along the light.
  const double rate = from > 0 ? 1 + 1 / mu : 1 - 1 / mu;
  const double sum = (from > 0 ? 1 : std::exp(-1 / mu)) * -std::expm1(-rate) / rate;
  const std::string light = fmt::format(
      "LightSource \"distant\" \"point3 from\" [0.6 0 {}] \"point3 to\" "
      "[0 0 0] \"rgb L\" [1 1 1]\n",
      0.8 * from);
  Quality quality = {256, 4096, 1};
  return Expect(scattered * phase * sum,
                ViewOfSlab(unit) +
                    Homogeneous("m", absorbed / unit, scattered / unit, g) +
                    Slab("m", unit) + light,
                quality, effort);
}

std::vector<Point> ByUnit(double unit, const Effort& effort) {
  return {Named("lit from the front", ScatteredOnce(0, unit, 1, effort)),
          Named("lit from behind", ScatteredOnce(0, unit, -1, effort))};
}

// A ball that scatters all light cannot be told from the sky around it. Its paths have
// 2/3 of its optical depth as many events on average, and all weigh 1.
std::vector<Point> BallInSky(double depth, double g, const Effort& effort) {
  const std::string text = ViewOfBall() + Homogeneous("m", 0, depth / 2, g) +
                           Ball("m", "", 1, "\"interface\"") + Sky(1);
  Quality plain = {4, 64, 1 << 20, 4};
  plain.strategy = kPlainPaths;
  Point weights = Expect(1, text, plain, effort);
  // Each event rounds the weight once.
  weights.tolerance += 0x1p-24 * depth;
  std::vector<Point> points = {Named("plain paths", weights)};
  if (depth > 10) return points;  // depth 1000 below is to lose nothing
  points.push_back(Named("default", Expect(1, text, {256, 4096, 1000}, effort)));
  return points;
}

std::vector<Point> ByDepthOfBall(double depth, const Effort& effort) {
  return BallInSky(depth, 0, effort);
}

std::vector<Point> ByPhase(double missing, const Effort& effort) {
  std::vector<Point> points;
  for (const double sign : {1.0, -1.0}) {
    const double g = sign * (1 - missing);
    const std::string name = sign > 0 ? "forward, " : "backward, ";
    for (Point& point : BallInSky(2, g, effort)) {
      points.push_back(Named(name + point.series, point));
    }
    points.push_back(Named(name + "lit from the front", ScatteredOnce(g, 1, 1, effort)));
    points.push_back(Named(name + "lit from behind", ScatteredOnce(g, 1, -1, effort)));
  }
  return points;
}

// A grid whose layers across the view have density 1 but for one that is denser: optical
// depth 1 in all. Between the middles of cells densities are interpolated, and they are 0
// beyond the grid: so an outer layer counts for 7/8 of an inner one.
std::vector<Point> ByContrast(double contrast, const Effort& effort) {
  const int layers = 16, dense = 5;
  std::string values;
  for (int i = 0; i < layers; ++i) {
    for (int k = 0; k < 4; ++k) {
      values += fmt::format("{:.9g} ", i == dense ? contrast : 1.0);
    }
  }
  const double mean = (layers - 3 + 2 * 0.875 + contrast) / layers;
  const std::string grid = fmt::format(
      "MakeNamedMedium \"m\" \"string type\" \"uniformgrid\" \"integer nx\" 2 \"integer "
      "ny\" 2 \"integer nz\" {} \"point3 p0\" [-50 -50 -1] \"point3 p1\" [50 50 0]{}{} "
      "\"float density\" [{}]\n",
      layers, Grey("sigma_a", 1 / mean), Grey("sigma_s", 0), values);
  return {Expect(std::exp(-1), ViewOfSlab() + grid + Slab("m") + Sky(1), {256, 4096},
                 effort)};
}

// Shells of glass of two indices around each other, all filled with white media.
std::vector<Point> ByShells(double shells, const Effort& effort) {
  const int count = static_cast<int>(shells);
  std::string text =
      ViewOfBall() + Homogeneous("0", 0, 1, 0.5) + Homogeneous("1", 0, 4, -0.3) + Sky(1);
  for (int i = 0; i < count; ++i) {
    text += Ball(std::to_string(i % 2), i == 0 ? "" : std::to_string((i + 1) % 2),
                 1 - i / shells, Glass(i % 2 == 0 ? 1.5 : 0.8));
  }
  Quality quality = {4, 64, 1000000, 4};
  quality.strategy = kPlainPaths;
  Point point = Expect(1, text, quality, effort);
  point.tolerance += 0x1p-24 * 40 * shells;  // some forty events in a shell
  return {point};
}

}  // namespace

TEST_CASE("extremes: slabs of optical depth 1e-6 to 1e6") {
  CheckPoints({1e-6, 1e-4, 0.01, 1, 10, 80, 1e3, 1e6}, SlabByDepth);
}
TEST_CASE("extremes: a slab lit by a lamp, in units of 1e-12 to 1e12") {
  CheckPoints(Decades(-12, 12, 6), ByUnit);
}
TEST_CASE(
    "extremes: a white ball of optical depth up to 1000 is invisible under a uniform "
    "sky") {
  CheckPoints({1e-6, 1e-3, 1, 10, 100, 1000}, ByDepthOfBall);
}
TEST_CASE("extremes: asymmetries of scattering up to 1 - 1e-3 either way") {
  CheckPoints({1e-3, 0.01, 0.1, 1}, ByPhase);
}
TEST_CASE("extremes: a grid with a layer 1e-6 to 1e6 times as dense as the others") {
  CheckPoints(Decades(-6, 6, 3), ByContrast);
}
TEST_CASE("extremes: up to 32 shells of glass of two indices, filled with media") {
  CheckPoints({1, 2, 8, 32}, ByShells);
}

}  // namespace lanelight::stress

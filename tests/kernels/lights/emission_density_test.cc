// Emitting shapes with images. Chi-square tests compare samples with the density that
// rays to the same shape know, and that density with its integral. What samples and rays
// see of the image is compared with the reference's surfaces.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "src/base/core/pi.h"
#include "src/base/stat/hypothesis.h"
#include "tests/base/stat/chi2.h"
#include "tests/kernels/lights/pictured_samples.h"
#include "tests/support/each_target.h"

namespace lanelight::test {
namespace {

constexpr int kAcross = 10, kWithin = 16;  // cells along each side; parts along one's

// Directions around the shape: a cone that holds it, cut into cells of one solid angle.
struct Cone {
  Vec3d axis, x, y;
  double versine;  // 1 - cos of its half angle

  Cone(const PicturedShape& shape, Vec3d from) : axis(Normalize(shape.middle - from)) {
    x = Normalize(Cross(axis, std::abs(axis.x) > 0.5 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0}));
    y = Cross(axis, x);
    const double sine = shape.radius / Length(shape.middle - from);
    versine = sine < 1 ? 1 - std::sqrt(1 - sine * sine) : 2;
  }
  // s, t in [0, 1].
  Vec3d At(double s, double t) const {
    const double z = 1 - versine * s, r = std::sqrt(std::max(0.0, 1 - z * z));
    return axis * z + x * (r * std::cos(2 * kPi * t)) + y * (r * std::sin(2 * kPi * t));
  }
  std::size_t CellOf(Vec3d d) const {
    const auto cell = [](double v) {
      return std::size_t(std::clamp(int(v * kAcross), 0, kAcross - 1));
    };
    const double turn = std::atan2(Dot(d, y), Dot(d, x)) / (2 * kPi);
    return cell((1 - Dot(d, axis)) / versine) * kAcross + cell(turn - std::floor(turn));
  }
};

// Integrals of the density over the cells, by midpoints.
std::vector<double> Probabilities(const PictureSamples& samples, const Cone& cone) {
  constexpr int kSide = kAcross * kWithin;
  std::vector<Vec3d> directions;
  for (int k = 0; k < kSide * kSide; ++k) {
    directions.push_back(cone.At((k / kSide + 0.5) / kSide, (k % kSide + 0.5) / kSide));
  }
  const auto pdf = DensitiesAlong(samples.scene(), samples.from(), directions);
  const double part = 2 * kPi * cone.versine / (kSide * kSide);
  std::vector<double> cells(kAcross * kAcross, 0);
  for (std::size_t k = 0; k < pdf.size(); ++k) {
    cells[cone.CellOf(directions[k])] += pdf[k] * part;
  }
  return cells;
}

double DensityPValue(const PicturedShape& shape, Vec3d from, double power = 1) {
  const PictureSamples samples(shape, from, power);
  const Cone cone(shape, from);
  std::vector<double> expected = Probabilities(samples, cone);
  std::vector<double> counts(expected.size(), 0);
  double sum = 0, counted = 0;
  for (const double e : expected) sum += e;
  // What midpoints at the outline are off by, and no more.
  CHECK(sum == Approx(samples.Pmf()).epsilon(0.005));
  for (const Vec3d d : samples.Directions()) {
    // Not in a cell of which the shape has a sliver between the midpoints.
    const std::size_t cell = cone.CellOf(d);
    if (expected[cell] > 0) ++counts[cell], ++counted;
  }
  CHECK(counted > 0.999 * kPictureSamples);
  for (double& e : expected) e *= counted / sum;
  return stat::ChiSquareTest(counts, expected).p;
}

}  // namespace

// The family of all shapes, places and targets raises a false alarm with probability
// 1e-6.
TEST_CASE("densities of samples on textured lights equal those computed by hits",
          "[lights][stat]") {
  const std::vector<PicturedShape> shapes = PicturedShapes();
  const double level =
      stat::SidakLevel(1e-6, int(2 * shapes.size() * AvailableTargets().size()));
  const EachTarget target;
  for (const PicturedShape& shape : shapes) {
    CAPTURE(shape.name);
    REQUIRE(shape.places.size() == 2);
    for (const Vec3d from : shape.places) CHECK(DensityPValue(shape, from) > level);
    // Another density is rejected.
    CHECK(DensityPValue(shape, shape.places[0], 1.15) < 1e-6);
  }
}

TEST_CASE("a sample on a textured light and the ray to it agree", "[lights]") {
  const EachTarget target;
  for (const PicturedShape& shape : PicturedShapes()) {
    for (const Vec3d from : shape.places) {
      CAPTURE(shape.name, from.x, from.y, from.z);
      const PictureSamples samples(shape, from);
      const std::vector<Vec3d> directions = samples.Directions();
      const auto pdf = DensitiesAlong(samples.scene(), from, directions);
      const auto seen = SeenAlong(samples.scene(), from, directions, kLargePdf);
      const PictureTruth truth(shape);
      int off = 0;  // at the outline, where one sees what the other does not
      for (std::uint32_t i = 0; i < kPictureSamples; ++i) {
        const Rgb sampled = samples.Radiance(i);
        const Rgb want = truth.Along(from, directions[i]);
        const auto is = [](double a, double b) { return a == Approx(b).epsilon(2e-3); };
        bool same = is(samples.Pdf(i), pdf[i]);
        for (int c = 0; c < 3; ++c) {
          same &= is(sampled[c], want[c]) && is(seen[i][c], want[c]);
        }
        off += !same;
      }
      CHECK(off < int(kPictureSamples) / 200);
    }
  }
}

}  // namespace lanelight::test

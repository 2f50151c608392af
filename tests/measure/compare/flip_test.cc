// FLIP of colours whose distance can be computed by hand, and what must hold of any
// images.
#include "src/measure/compare/flip.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

namespace lanelight {
namespace {

LinearImage Flat(int width, int height, double r, double g, double b) {
  LinearImage out = {width, height, {}};
  const double color[] = {r, g, b};
  for (int c = 0; c < 3; ++c) {
    out.planes[c].assign(out.pixels(), static_cast<float>(color[c]));
  }
  return out;
}

// Smooth, with an edge, a bright point and a little noise.
LinearImage Pattern(int width, int height, std::uint32_t seed, double gain = 1) {
  LinearImage out = Flat(width, height, 0, 0, 0);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> noise(0, 0.3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) {
        double v = 0.2 + 0.15 * std::sin(0.3 * (x + 2 * c)) + (x > width / 2 ? 0.3 : 0);
        if (x == 5 && y == 7) v += 3;
        out.planes[c][y * width + x] = static_cast<float>(gain * (v + noise(random)));
      }
    }
  }
  return out;
}

double MeanOf(const Plane& map) { return SummaryOf(map).mean; }

}  // namespace

TEST_CASE("FLIP of black and white is that of the distance of their lightness",
          "[flip]") {
  // Without chroma HyAB is the difference of L*: 100. Green and blue are 308.11 apart
  // after Hunt's effect, so that (100^0.7 - knee) / (largest - knee) of the last
  // twentieth is left, with largest = 308.11^0.7 and knee = 0.4 largest: 0.967.
  const Plane map = LdrFlip(Flat(8, 6, 0, 0, 0), Flat(8, 6, 1, 1, 1));
  for (float value : map) CHECK(value == Approx(0.967).margin(1e-3));
  // The largest there is.
  CHECK(MeanOf(LdrFlip(Flat(8, 6, 0, 1, 0), Flat(8, 6, 0, 0, 1))) ==
        Approx(1).margin(1e-5));
}

TEST_CASE("FLIP of flat colours is the same from any distance", "[flip]") {
  const double colors[][3] = {{0.2, 0.5, 0.1}, {0.21, 0.5, 0.1}, {0.001, 0, 0}};
  for (const auto& a : colors) {
    for (const auto& b : colors) {
      const auto flip = [&](double ppd) {
        return MeanOf(
            LdrFlip(Flat(5, 4, a[0], a[1], a[2]), Flat(5, 4, b[0], b[1], b[2]), ppd));
      };
      CHECK(flip(20) == Approx(flip(kFlipPixelsPerDegree)).margin(1e-4));
    }
  }
}

TEST_CASE("FLIP of equal images is zero, and it is symmetric", "[flip]") {
  const LinearImage a = Pattern(40, 30, 1), b = Pattern(40, 30, 2);
  CHECK(SummaryOf(LdrFlip(a, a)).max == 0);
  CHECK(LdrFlip(a, b) == LdrFlip(b, a));
  const FlipExposures exposures = ExposuresOf(a);
  CHECK(SummaryOf(HdrFlip(a, a, exposures)).max == 0);
  CHECK(HdrFlip(a, b, exposures) == HdrFlip(b, a, exposures));
}

TEST_CASE("FLIP sees less of noise from farther away", "[flip]") {
  const LinearImage a = Pattern(60, 60, 1), b = Pattern(60, 60, 2);
  CHECK(MeanOf(LdrFlip(a, b, 100)) < 0.8 * MeanOf(LdrFlip(a, b, 20)));
}

TEST_CASE("exposures of HDR-FLIP follow the reference's light", "[flip]") {
  const LinearImage one = Pattern(20, 20, 3), brighter = Pattern(20, 20, 3, 8);
  const FlipExposures a = ExposuresOf(one), b = ExposuresOf(brighter);
  CHECK(a.start - b.start == Approx(3).margin(1e-5));
  CHECK(a.stop - b.stop == Approx(3).margin(1e-5));
  CHECK(a.count == b.count);
  CHECK(a.count == static_cast<int>(std::ceil(a.stop - a.start)));
  // So light that is brighter in both images changes nothing.
  const LinearImage other = Pattern(20, 20, 4), brighter_other = Pattern(20, 20, 4, 8);
  CHECK(MeanOf(HdrFlip(one, other, a)) ==
        Approx(MeanOf(HdrFlip(brighter, brighter_other, b))).epsilon(1e-4));
  // The curve brings the brightest to 0.85: of a flat image both ends are there.
  const FlipExposures flat = ExposuresOf(Flat(4, 4, 1, 1, 1));
  CHECK(flat.start == Approx(flat.stop).margin(1e-6));
  CHECK(flat.count == 2);
  const double x = std::exp2(flat.start);
  CHECK(0.6 * x * (0.6 * 2.51 * x + 0.03) / (0.6 * x * (0.6 * 2.43 * x + 0.59) + 0.14) ==
        Approx(0.85));
}

TEST_CASE("HDR-FLIP detects differences beyond the clamp of a screen", "[flip]") {
  LinearImage a = Flat(24, 24, 20, 20, 20), b = a;
  for (int c = 0; c < 3; ++c) b.planes[c][300] = 40;
  CHECK(MeanOf(LdrFlip(a, b)) == 0);
  CHECK(SummaryOf(HdrFlip(a, b, ExposuresOf(a))).max > 0.02);
}

TEST_CASE("FLIP counts invalid values as black or as bright as can be", "[flip]") {
  LinearImage bad = Flat(9, 9, 0.5, 0.5, 0.5);
  bad.planes[0][40] = std::numeric_limits<float>::quiet_NaN();
  bad.planes[1][41] = std::numeric_limits<float>::infinity();
  bad.planes[2][42] = -std::numeric_limits<float>::infinity();
  const LinearImage good = Flat(9, 9, 0.5, 0.5, 0.5);
  for (const Plane& map : {LdrFlip(good, bad), HdrFlip(good, bad, ExposuresOf(good)),
                           HdrFlip(bad, good, ExposuresOf(bad))}) {
    const FlipSummary s = SummaryOf(map);
    CHECK(s.mean > 0);
    CHECK(s.max <= 1);
  }
  const LinearImage black = Flat(4, 4, 0, 0, 0);
  CHECK(ExposuresOf(black).count == 2);
  CHECK(MeanOf(HdrFlip(black, Flat(4, 4, 1, 1, 1), ExposuresOf(black))) > 0.8);
}

TEST_CASE("quartiles of a map are weighted by the errors themselves", "[flip]") {
  // Sum 10: up to 1: 1, 2: 3, 3: 6, 4: 10.
  const FlipSummary s = SummaryOf({4, 1, 0, 3, 2});
  CHECK(s.mean == 2);
  CHECK(s.first_quartile == 2);
  CHECK(s.median == 3);
  CHECK(s.third_quartile == 4);
  CHECK(s.max == 4);
  CHECK(SummaryOf({0, 0}).median == 0);
}

}  // namespace lanelight

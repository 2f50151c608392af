// The fraction of a guide: with records whose second moments are known.
#include <catch2/catch.hpp>
#include <random>

#include "src/prepare/guide_fraction.h"

namespace lanelight {
namespace {

// Two directions, one of which brings all the light: the material finds it with
// probability p, the guide with g; records are of a pass with fraction c.
FractionSums TwoDirections(double p, double g, double c, int records, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform;
  FractionSums sums;
  const double q = c * g + (1 - c) * p;
  for (int i = 0; i < records; ++i) {
    const bool bright = uniform(engine) < q;
    const double mine = bright ? p : 1 - p, guides = bright ? g : 1 - g;
    const double density = c * guides + (1 - c) * mine;
    GuideRecord r;
    r.radiance = bright ? 1 : 0;
    r.material = static_cast<float>(mine / density);
    r.guide = static_cast<float>(guides / density);
    sums.Add(r);
  }
  return sums;
}

}  // namespace

TEST_CASE("a guide proposes as often as it pays", "[guide]") {
  // All light from one direction: second moment p^2 / (c g + (1 - c) p), so the best
  // fraction is the largest where g > p, and none where g < p.
  const auto good = TwoDirections(0.05, 0.8, 0.5, 2000, 1).Blend({}).Best(100);
  CHECK(good.fraction == Approx(0.5));
  CHECK(good.gain == Approx(0.05 / (0.5 * 0.8 + 0.5 * 0.05)).epsilon(1e-4));
  const auto bad = TwoDirections(0.5, 0.2, 0.5, 2000, 2).Blend({}).Best(100);
  CHECK(bad.fraction == 0);
  CHECK(bad.gain == 1);
  // No better than the material by a twentieth: not worth its time.
  CHECK(TwoDirections(0.5, 0.51, 0.5, 2000, 3).Blend({}).Best(100).fraction == 0);
}

TEST_CASE("a fraction does not depend on that of the pass it is learned from",
          "[guide]") {
  // Light from both directions, 3 : 1. With m of each the second moment is
  // sum (p L)^2 / (c g + (1 - c) p); here by sums over both directions.
  const double p = 0.2, g = 0.75, light[] = {3, 1};
  std::array<double, FractionSums::kFractions> truth{};
  for (int i = 0; i < FractionSums::kFractions; ++i) {
    const double c = i / 10.0;
    const double a = p * light[0], b = (1 - p) * light[1];
    truth[static_cast<std::size_t>(i)] =
        a * a / (c * g + (1 - c) * p) + b * b / (c * (1 - g) + (1 - c) * (1 - p));
  }
  const auto best = std::min_element(truth.begin(), truth.end());
  for (const double c : {0.1, 0.5, 0.9}) {
    std::mt19937 engine(4);
    std::uniform_real_distribution<double> uniform;
    FractionSums sums;
    for (int i = 0; i < 40'000; ++i) {
      const bool first = uniform(engine) < c * g + (1 - c) * p;
      const double mine = first ? p : 1 - p, guides = first ? g : 1 - g;
      const double q = c * guides + (1 - c) * mine;
      GuideRecord r;
      r.radiance = static_cast<float>(light[first ? 0 : 1]);
      r.material = static_cast<float>(mine / q), r.guide = static_cast<float>(guides / q);
      sums.Add(r);
    }
    const auto choice = sums.Blend({}).Best(100);
    CHECK(choice.fraction == Approx(double(best - truth.begin()) / 10).margin(0.1001));
    // Standard error below 1 %: false alarms at 5 sigma, 6e-7 each.
    CHECK(choice.gain == Approx(*best / truth[0]).epsilon(0.05));
  }
}

TEST_CASE("few records borrow their fraction from the cell around", "[guide]") {
  const FractionSums around = TwoDirections(0.05, 0.8, 0.5, 2000, 1).Blend({});
  const FractionSums none;
  CHECK(none.Blend(around).Best(0).fraction == Approx(0.5));
  CHECK(none.Best(0).fraction == 0);
  CHECK(none.Best(1e9).fraction == Approx(0.5));
  CHECK(TwoDirections(0.5, 0.2, 0.5, 2000, 2).Blend(around).Best(100).fraction == 0);
}

}  // namespace lanelight

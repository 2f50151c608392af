// Where light subpaths from infinity start: tables, and what they learn.
#include "src/scene/prepare/emission_guide.h"

#include <catch2/catch.hpp>
#include <cstring>
#include <numeric>

namespace lanelight {
namespace {

LightTable TableOf(std::initializer_list<LightShape> shapes) {
  LightTable table;
  for (const LightShape shape : shapes) {
    LightRecord light;
    std::memset(&light, 0, sizeof(light));
    light.shape = std::uint32_t(shape);
    table.lights.push_back(light);
  }
  return table;
}

// A lamp, two suns, and a sky of two lights, one of which starts no subpaths.
struct Sky {
  LightTable table =
      TableOf({LightShape::kRectangle, LightShape::kDistant, LightShape::kDistant,
               LightShape::kInfiniteConstant, LightShape::kInfiniteImage});
  LightEmission emission;
  EmissionGuide guide = MakeEmissionGuide(table);

  Sky() { emission.pmf = {0.4f, 0.2f, 0.1f, 0.3f, 0}; }
  std::vector<double> Nothing() const {
    return std::vector<double>(guide.num_cells + table.lights.size(), 0.0);
  }
  void LearnFrom(const std::vector<double>& light) {
    Learn(LearnedEmissionWeights(table, guide, emission, light), guide);
  }
};

constexpr std::uint32_t kSide = EmissionGuide::kSunSide, kSun = kSide * kSide;
constexpr std::uint32_t kBins = EmissionGuide::kSkyBins * EmissionGuide::kSkyBins;
constexpr std::uint32_t kBin = EmissionGuide::kSkySide * EmissionGuide::kSkySide;

double SumOf(const AlignedVector<float>& values, std::size_t first, std::size_t count) {
  return std::accumulate(values.begin() + std::ptrdiff_t(first),
                         values.begin() + std::ptrdiff_t(first + count), 0.0);
}

void CheckSquares(const EmissionGuide& guide) {
  CHECK(SumOf(guide.lights.pmf, 0, guide.lights.pmf.size()) == Approx(1));
  for (std::uint32_t i = 0; i < 2; ++i)
    CHECK(SumOf(guide.pmf, i * kSun, kSun) == Approx(1));
  for (std::uint32_t i = 0; i < kBins; ++i) {
    CHECK(SumOf(guide.pmf, 2 * kSun + i * kBin, kBin) == Approx(1).epsilon(1e-5));
  }
}

}  // namespace

TEST_CASE("lights at infinity have cells of their own, those of the sky together",
          "[light_paths]") {
  const Sky sky;
  CHECK(sky.guide.distant == AlignedVector<std::int32_t>{-1, 0, kSun, -1, -1});
  CHECK(sky.guide.sky == std::int32_t(2 * kSun));
  CHECK(sky.guide.num_cells == 2 * kSun + kBins * kBin);
  CHECK_FALSE(sky.guide.has_learned());
}

// Half by power, half alike for the lamp, each sun and the sky.
constexpr double kPlain[] = {0.325, 0.225, 0.175, 0.275, 0};

TEST_CASE("without light all cells are alike, and so are groups of lights in part",
          "[light_paths]") {
  Sky sky;
  sky.LearnFrom(sky.Nothing());
  CheckSquares(sky.guide);
  CHECK(sky.guide.pmf[17] == Approx(1.0 / kSun));
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(double(sky.guide.lights.pmf[i]) == Approx(kPlain[i]));
  }
}

TEST_CASE("of many distant lights the first have cells", "[light_paths]") {
  Sky sky;
  sky.table.lights.assign(66, sky.table.lights[1]);
  sky.emission.pmf = AlignedVector<float>(66, 1.0f / 66);
  sky.guide = MakeEmissionGuide(sky.table);
  CHECK(sky.guide.num_cells == 64 * kSun);
  CHECK(sky.guide.distant[63] == std::int32_t(63 * kSun));
  CHECK(sky.guide.distant[64] == -1);
  std::vector<double> light = sky.Nothing();
  light[3] = 1;                         // of the first
  light[sky.guide.num_cells + 65] = 3;  // of the last, which has none
  sky.LearnFrom(light);
  CHECK(double(sky.guide.lights.pmf[0]) == Approx(0.1 / 66 + 0.9 / 4));
  CHECK(double(sky.guide.lights.pmf[65]) == Approx(0.1 / 66 + 0.9 * 3 / 4));
}

TEST_CASE("cells that bring light are likely, and so are their neighbours",
          "[light_paths]") {
  Sky sky;
  std::vector<double> light = sky.Nothing();
  light[5 * kSide + 7] = 2;             // of the first sun, inside its square
  light[kSun] = 2;                      // of the second, in a corner
  light[2 * kSun + 3 * kBin + 20] = 4;  // of the sky
  light[sky.guide.num_cells] = 2;       // of the lamp
  sky.LearnFrom(light);
  CheckSquares(sky.guide);
  const AlignedVector<float>& pmf = sky.guide.pmf;
  CHECK(pmf[5 * kSide + 7] == Approx(4.0 / 12));
  CHECK(pmf[4 * kSide + 6] == Approx(1.0 / 12));
  CHECK(pmf[6 * kSide + 7] == Approx(1.0 / 12));
  CHECK(pmf[7 * kSide + 7] == 0);
  CHECK(pmf[kSun] == Approx(4.0 / 7));
  CHECK(pmf[kSun + kSide] == Approx(1.0 / 7));
  CHECK(pmf[2 * kSun - kSide] == 0);  // the other side of the square
  CHECK(pmf[2 * kSun + 3 * kBin + 20] == Approx(4.0 / 12));
  CHECK(pmf[2 * kSun + 4 * kBin + 20] ==
        Approx(1.0 / kBin));  // of which nothing is known
  // Nine tenths by what they bring: 2, 2, 2, 4 and 0.
  const double brought[] = {0.2, 0.2, 0.2, 0.4, 0};
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(double(sky.guide.lights.pmf[i]) == Approx(0.1 * kPlain[i] + 0.9 * brought[i]));
  }
}

}  // namespace lanelight

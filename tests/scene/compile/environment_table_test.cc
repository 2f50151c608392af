// Tables of environment images, plain and compensated for what scattered rays find.
#include "src/scene/compile/environment.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numeric>

#include "src/base/core/vec.h"

namespace lanelight {
namespace {

// Radiance by texel and channel; without tables.
template <class F>
Environment TableOf(int size, F&& radiance) {
  Environment e;
  e.size = size;
  for (int i = 0; i < size * size; ++i) {
    for (int c = 0; c < 3; ++c) e.rgb.push_back(radiance(i, c));
  }
  return e;
}

double LuminanceOf(const Environment& e, std::size_t i) {
  return Luminance({e.rgb[3 * i], e.rgb[3 * i + 1], e.rgb[3 * i + 2]});
}

bool SameTables(const EnvironmentTable& a, const EnvironmentTable& b) {
  return a.row_cdf == b.row_cdf && a.column_cdf == b.column_cdf &&
         a.probability == b.probability && a.guide_bits == b.guide_bits &&
         a.row_guide == b.row_guide && a.column_guide == b.column_guide;
}

}  // namespace

TEST_CASE("environment table: compensated texels keep the part above the mean",
          "[scene][compile]") {
  for (float sun : {0.5f, 5.0f, 500.0f}) {
    const Environment e = TableOf(16, [&](int i, int c) {
      return 1 + 0.02f * static_cast<float>(i % 7 - 3) + (i == 77 ? sun + float(c) : 0);
    });
    const auto table = MakeEnvironmentTable(true, e);
    double mean = 0, above = 0, total = 0;
    for (std::size_t i = 0; i < 256; ++i) mean += LuminanceOf(e, i) / 256;
    for (std::size_t i = 0; i < 256; ++i)
      above += std::max(0.0, LuminanceOf(e, i) - mean);
    int zeros = 0;
    for (std::size_t i = 0; i < 256; ++i) {
      const double p = std::max(0.0, LuminanceOf(e, i) - mean) / above;
      INFO(sun << ", texel " << i);
      // Each of two cumulative distributions is rounded to 2^-24.
      CHECK(double(table->probability[i]) == Approx(p).epsilon(1e-4).margin(2e-7));
      if (p == 0) CHECK(table->probability[i] == 0);
      zeros += p == 0;
      total += double(table->probability[i]);
    }
    CHECK(zeros > 64);
    // The density over solid angle is P texels / (4 pi), texels fill 4 pi / texels each.
    CHECK(total == Approx(1).epsilon(1e-6));
  }
}

TEST_CASE("environment table: an image without contrast keeps its plain table",
          "[scene][compile]") {
  for (float noise : {0.0f, 1e-7f}) {
    const Environment e =
        TableOf(8, [&](int i, int) { return 0.3f * (1 + (i % 3 == 0 ? noise : 0.0f)); });
    const auto plain = MakeEnvironmentTable(false, e);
    CHECK(SameTables(*plain, *MakeEnvironmentTable(true, e)));
    CHECK(plain->probability[5] == Approx(1.0 / 64));
  }
  // A thousandth of contrast is contrast.
  const Environment weak = TableOf(8, [](int i, int) { return i < 32 ? 1.001f : 1.0f; });
  const auto table = MakeEnvironmentTable(true, weak);
  CHECK(table->probability[0] == Approx(1.0 / 32).epsilon(1e-3));
  CHECK(table->probability[63] == 0);
}

TEST_CASE("environment table: a black image has none", "[scene][compile]") {
  for (bool compensated : {false, true}) {
    const Environment e = TableOf(4, [](int, int) { return 0.0f; });
    CHECK(MakeEnvironmentTable(compensated, e)->probability.empty());
  }
}

}  // namespace lanelight

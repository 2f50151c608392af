// FLIP beside the numbers of its authors' algorithm: that of the program of Andersson,
// Nilsson and Akenine-Moller (github.com/NVlabs/flip; filters and colours of version 1.1,
// 2021, in numpy; median and exposures of version 1.7, 2025, in C++), followed step by
// step in double precision outside of this project, on images that formulas make. Their
// single precision changes these numbers by up to 2e-6.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>

#include "src/measure/compare/flip.h"

namespace lanelight {
namespace {

constexpr double kPpd = kFlipPixelsPerDegree;

enum AuthorsCase { kGradient, kEdges, kNoise, kRamp, kLamps, kDim };

struct AuthorsRow {
  AuthorsCase images;
  int width, height;
  double pixels_per_degree;
  FlipSummary expected;
  FlipExposures exposures = {};
};

// 0 to 1, by a hash.
double HashOf(int x, int y, int c, std::uint32_t seed) {
  std::uint32_t k = static_cast<std::uint32_t>(x) * 1597334677u ^
                    static_cast<std::uint32_t>(y) * 3812015801u ^
                    static_cast<std::uint32_t>(c + 1) * 2798796415u ^ seed * 1979697957u;
  k ^= k >> 16;
  k *= 0x7feb352du;
  k ^= k >> 15;
  k *= 0x846ca68bu;
  k ^= k >> 16;
  return k / 4294967296.0;
}

template <class Value>
LinearImage ImageBy(int width, int height, const Value& value) {
  LinearImage out = {width, height, {}};
  for (int c = 0; c < 3; ++c) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        out.planes[c].push_back(static_cast<float>(value(x, y, c)));
      }
    }
  }
  return out;
}

double StripesAt(int x, int y, int c) {
  constexpr double kColors[3][3] = {{0.8, 0.1, 0.05}, {0.1, 0.6, 0.2}, {0.05, 0.1, 0.7}};
  return kColors[(x / 7 + y / 11) % 3][c];
}

struct ImagePair {
  LinearImage reference, test;
};

template <class Reference, class Test>
ImagePair PairBy(const AuthorsRow& row, const Reference& reference, const Test& test) {
  return {ImageBy(row.width, row.height, reference),
          ImageBy(row.width, row.height, test)};
}

ImagePair ImagesOf(const AuthorsRow& row) {
  const double w = row.width - 1, h = row.height - 1;
  const auto gradient = [=](int x, int y, int c) {
    const double u = x / w, v = y / h;
    return c == 0 ? u : c == 1 ? v : 0.5 * (u + v) * (1 - 0.5 * u);
  };
  const auto ramp = [=](int x, int y, int c) {
    const double tint[] = {0.4 + 0.6 * y / h, 0.7, 1 - 0.6 * y / h};
    return std::exp2(12 * x / w - 6) * tint[c];
  };
  // One pixel in a hundred, `channel` says which, is a lamp.
  const auto lamp = [](int x, int y, int channel) {
    return HashOf(x, y, channel, 5) > 0.99 ? 40 * HashOf(x, y, 1, 5) : 0;
  };
  switch (row.images) {
    case kGradient:
      return PairBy(row, gradient, [=](int x, int y, int c) {
        return gradient(x, y, c) + 0.2 * (HashOf(x, y, c, 1) - 0.5);
      });
    case kEdges:
      return PairBy(row, StripesAt,
                    [](int x, int y, int c) { return StripesAt(x + 2, y, c); });
    case kNoise:
      return PairBy(
          row, [](int x, int y, int c) { return HashOf(x, y, c, 2); },
          [](int x, int y, int c) { return HashOf(x, y, c, 3); });
    case kRamp:
      return PairBy(row, ramp, [=](int x, int y, int c) {
        return ramp(x, y, c) * (0.5 + HashOf(x, y, c, 4));
      });
    case kLamps:
      return PairBy(
          row, [=](int x, int y, int) { return 0.02 + lamp(x, y, 0); },
          [=](int x, int y, int c) {
            return 0.02 * (0.5 + HashOf(x, y, c, 6)) + lamp(x, y, 2);
          });
    case kDim:
      break;
  }
  return PairBy(
      row, [](int x, int y, int c) { return 0.001 * StripesAt(x, y, c); },
      [](int x, int y, int c) {
        return 0.001 * StripesAt(x, y, c) * (0.7 + 0.6 * HashOf(x, y, c, 7));
      });
}

void CheckSummary(const FlipSummary& got, const FlipSummary& expected) {
  CHECK(got.mean == Approx(expected.mean).margin(2e-5));
  CHECK(got.max == Approx(expected.max).margin(2e-5));
  // Values of single pixels, with gaps to the next.
  CHECK(got.first_quartile == Approx(expected.first_quartile).margin(1e-4));
  CHECK(got.median == Approx(expected.median).margin(1e-4));
  CHECK(got.third_quartile == Approx(expected.third_quartile).margin(1e-4));
}

}  // namespace

TEST_CASE("LDR-FLIP equals the authors' values", "[flip]") {
  // Mean, weighted quartiles, largest.
  const AuthorsRow rows[] = {
      {kGradient, 48, 32, kPpd, {0.116752, 0.097121, 0.127268, 0.167933, 0.336246}},
      {kEdges, 48, 32, kPpd, {0.515381, 0.440768, 0.617421, 0.901790, 0.974482}},
      {kNoise, 48, 32, kPpd, {0.403909, 0.347621, 0.437232, 0.535004, 0.927143}},
      {kGradient, 97, 61, kPpd, {0.112824, 0.094425, 0.122092, 0.158223, 0.389864}},
      {kEdges, 97, 61, kPpd, {0.511412, 0.429144, 0.608645, 0.873382, 0.975796}},
      {kNoise, 97, 61, kPpd, {0.392832, 0.341168, 0.425285, 0.522582, 0.968792}},
      {kGradient, 160, 112, kPpd, {0.112124, 0.093989, 0.121070, 0.155616, 0.439149}},
      {kEdges, 160, 112, kPpd, {0.509739, 0.421015, 0.604447, 0.872125, 0.975796}},
      {kNoise, 160, 112, kPpd, {0.392028, 0.339026, 0.425780, 0.524495, 0.966227}},
      {kGradient, 97, 61, 20, {0.276656, 0.240921, 0.301458, 0.365412, 0.659661}},
      {kEdges, 97, 61, 20, {0.413731, 0.618402, 0.963495, 0.975105, 0.982599}},
      {kNoise, 97, 61, 20, {0.805513, 0.744470, 0.892890, 0.968624, 0.987268}},
  };
  for (const AuthorsRow& row : rows) {
    CAPTURE(row.images, row.width, row.height, row.pixels_per_degree);
    const ImagePair pair = ImagesOf(row);
    CheckSummary(SummaryOf(LdrFlip(pair.reference, pair.test, row.pixels_per_degree)),
                 row.expected);
  }
}

TEST_CASE("HDR-FLIP equals the authors' values and exposures", "[flip]") {
  const AuthorsRow rows[] = {
      {kRamp,
       48,
       32,
       kPpd,
       {0.150595, 0.128869, 0.165347, 0.213252, 0.452214},
       {-4.486428, 1.559741, 7}},
      {kLamps,
       48,
       32,
       kPpd,
       {0.284000, 0.203334, 0.348180, 0.650102, 0.974299},
       {-4.129489, 6.727153, 11}},
      {kDim,
       48,
       32,
       kPpd,
       {0.092938, 0.077406, 0.101240, 0.132289, 0.257668},
       {12.154337, 13.076991, 2}},
      {kRamp,
       97,
       61,
       kPpd,
       {0.152629, 0.130944, 0.171105, 0.219085, 0.436939},
       {-4.486428, 1.597870, 7}},
      {kLamps,
       97,
       61,
       kPpd,
       {0.302278, 0.214688, 0.380436, 0.649249, 0.974307},
       {-4.236232, 6.727153, 11}},
      {kDim,
       97,
       61,
       kPpd,
       {0.093503, 0.077659, 0.102216, 0.133623, 0.319018},
       {12.154337, 13.076991, 2}},
      {kRamp,
       160,
       112,
       kPpd,
       {0.152268, 0.131656, 0.170933, 0.219375, 0.514035},
       {-4.486428, 1.597785, 7}},
      {kLamps,
       160,
       112,
       kPpd,
       {0.300805, 0.210955, 0.384677, 0.647908, 0.974307},
       {-4.236232, 6.727153, 11}},
      {kDim,
       160,
       112,
       kPpd,
       {0.091446, 0.076032, 0.100157, 0.130504, 0.306374},
       {12.154337, 13.076991, 2}},
      {kRamp,
       97,
       61,
       20,
       {0.367199, 0.326595, 0.420974, 0.519134, 0.740130},
       {-4.486428, 1.597870, 7}},
      {kLamps,
       97,
       61,
       20,
       {0.452683, 0.397464, 0.483975, 0.574282, 0.991289},
       {-4.236232, 6.727153, 11}},
      {kDim,
       97,
       61,
       20,
       {0.240158, 0.204496, 0.266536, 0.337737, 0.497739},
       {12.154337, 13.076991, 2}},
  };
  for (const AuthorsRow& row : rows) {
    CAPTURE(row.images, row.width, row.height, row.pixels_per_degree);
    const ImagePair pair = ImagesOf(row);
    const FlipExposures exposures = ExposuresOf(pair.reference);
    CHECK(exposures.start == Approx(row.exposures.start).margin(1e-5));
    CHECK(exposures.stop == Approx(row.exposures.stop).margin(1e-5));
    CHECK(exposures.count == row.exposures.count);
    CheckSummary(
        SummaryOf(HdrFlip(pair.reference, pair.test, exposures, row.pixels_per_degree)),
        row.expected);
  }
}

}  // namespace lanelight

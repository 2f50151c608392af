// Metrics against numbers worked out by hand, and z-scores against noise of known
// variance.
#include "src/measure/compare/metrics.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <nlohmann/json.hpp>

#include "src/base/core/error.h"

namespace lanelight {
namespace {

Image Rgb2x1(const std::vector<float>& values) {
  Image image = MakeImage(2, 1, {"R", "G", "B"});
  std::copy(values.begin(), values.end(), image.pixels.begin());
  return image;
}

// Constant 1 plus normal noise of standard deviation `sigma`, claiming `claimed` for it.
Image Noisy(int side, double sigma, double claimed, std::uint32_t seed, double bias = 0) {
  Image image =
      MakeImage(side, side, {"R", "G", "B", "variance.R", "variance.G", "variance.B"});
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      for (int c = 0; c < 3; ++c) {
        image.At(x, y, c) = static_cast<float>(1 + bias + sigma * normal(random));
        image.At(x, y, c + 3) = static_cast<float>(claimed * claimed);
      }
    }
  }
  return image;
}

}  // namespace

TEST_CASE("metrics of two pixels by hand", "[metrics]") {
  const Image test = Rgb2x1({1, 2, 3, 4, 5, 6});
  const Image reference = Rgb2x1({1, 1, 1, 2, 5, 10});
  // Differences 0 1 2, 2 0 -4.
  const CompareResult r = CompareImages(test, reference);
  CHECK(r.samples == 6);
  CHECK(r.mse == Approx((0 + 1 + 4 + 4 + 0 + 16) / 6.0));
  CHECK(r.rmse == Approx(std::sqrt(25 / 6.0)));
  CHECK(r.mae == Approx(9 / 6.0));
  CHECK(r.relmse == Approx((1 / 1.01 + 4 / 1.01 + 4 / 4.01 + 16 / 100.01) / 6));
  // All squares hold both pixels.
  for (double filtered : r.relmse_filtered) {
    CHECK(filtered == Approx((1 / 2.26 + 0.25 / 9.01 + 1 / 30.26) / 3));
  }
  CHECK(r.mape == Approx((1 / 1.01 + 2 / 1.01 + 2 / 2.01 + 4 / 10.01) / 6));
  CHECK(r.psnr == Approx(10 * std::log10(100 / (25 / 6.0))));
  CHECK(r.mean_test == std::vector<double>{2.5, 3.5, 4.5});
  CHECK(r.mean_reference == std::vector<double>{1.5, 3, 5.5});
  CHECK(r.mean_ratio[0] == Approx(5 / 3.0));
  CHECK(r.channels == std::vector<std::string>{"R", "G", "B"});
  CHECK_FALSE(r.z.available);
  // One tile: squared difference of the means, per channel.
  CHECK(r.tile_relmse_median == Approx(1 / 30.26));  // of 1/2.26, 0.25/9.01, 1/30.26
  CHECK(r.tile_relmse_max == Approx(1 / 2.26));
}

TEST_CASE("equal images have no error and infinite PSNR", "[metrics]") {
  const Image image = Noisy(8, 0.1, 0.1, 1);
  const CompareResult r = CompareImages(image, image);
  CHECK(r.mse == 0);
  CHECK(r.relmse == 0);
  CHECK(std::isinf(r.psnr));
  CHECK(r.mean_ratio == std::vector<double>{1, 1, 1});
  CHECK(ToJson(r)["psnr"].dump() == "null");
  CHECK(ToJson(r)["z"]["count"] == 192);
}

TEST_CASE("the trimmed metric ignores fireflies, the plain metric does not",
          "[metrics]") {
  const Image reference = Noisy(64, 0, 0, 1);
  Image test = Noisy(64, 0.1, 0.1, 2);
  const CompareResult clean = CompareImages(test, reference);
  CHECK(clean.relmse == Approx(0.01 / 1.01).epsilon(0.05));
  for (int i = 0; i < 10; ++i) test.At(6 * i, 5 * i, i % 3) = 1e4f;
  const CompareResult fireflies = CompareImages(test, reference);
  CHECK(fireflies.relmse > 1000);
  CHECK(fireflies.relmse_trimmed == Approx(clean.relmse_trimmed).epsilon(0.01));
  CHECK(fireflies.relmse_trimmed < clean.relmse);
  CHECK(fireflies.tile_relmse_median < 1e-3);
  CHECK(fireflies.tile_relmse_max > 100);
}

TEST_CASE("NaN and infinity are counted and left out", "[metrics]") {
  const float nan = std::nanf(""), inf = std::numeric_limits<float>::infinity();
  const CompareResult r =
      CompareImages(Rgb2x1({nan, 2, 3, 4, inf, 6}), Rgb2x1({1, 2, nan, 4, 5, 7}));
  CHECK(r.invalid_test == 2);
  CHECK(r.invalid_reference == 1);
  CHECK(r.samples == 3);
  CHECK(r.mse == Approx(1 / 3.0));
  const CompareResult none =
      CompareImages(Rgb2x1({nan, nan, nan, nan, nan, nan}), Rgb2x1({1, 1, 1, 1, 1, 1}));
  CHECK(none.samples == 0);
  CHECK_FALSE(none.relmse <= 1e9);  // no limit is met
  CHECK(ToJson(none)["relmse"].dump() == "null");
}

TEST_CASE("z-scores of correct variances are standard normal", "[metrics]") {
  const int side = 128;
  const double n = 3.0 * side * side;
  const ZScores z = CompareImages(Noisy(side, 0.2, 0.2, 1), Noisy(side, 0.1, 0.1, 2)).z;
  REQUIRE(z.available);
  CHECK(z.count == 3u * side * side);
  CHECK(std::abs(z.mean) < 5 / std::sqrt(n));
  CHECK(std::abs(z.standard_deviation - 1) < 5 / std::sqrt(2 * n));
  CHECK(std::abs(z.beyond_2 - 0.0455) < 5 * std::sqrt(0.0455 / n));
  CHECK(std::abs(z.beyond_3 - 0.0027) < 5 * std::sqrt(0.0027 / n));
  CHECK(z.ks_distance < 2.2 / std::sqrt(n));  // exceeded with probability 1e-4
}

TEST_CASE("z-scores expose bias and wrong variances", "[metrics]") {
  const int side = 128;
  const double n = 3.0 * side * side;
  const Image reference = Noisy(side, 0.1, 0.1, 2);
  const ZScores biased = CompareImages(Noisy(side, 0.1, 0.1, 1, 0.01), reference).z;
  CHECK(biased.mean > 10 / std::sqrt(n));
  CHECK(biased.ks_distance > 2.2 / std::sqrt(n));
  const ZScores boasting = CompareImages(Noisy(side, 0.2, 0.1, 1), reference).z;
  CHECK(boasting.standard_deviation > 1.5);
  CHECK(boasting.beyond_3 > 0.02);
  const ZScores one_sided =
      CompareImages(Noisy(side, 0.1, 0.1, 1), Noisy(side, 0, 0, 3)).z;
  CHECK(one_sided.standard_deviation == Approx(1).epsilon(0.02));
}

TEST_CASE("samples without variance are reported separately", "[metrics]") {
  Image test = Noisy(2, 0, 0, 1), reference = Noisy(2, 0, 0, 1);
  test.At(0, 0, 0) = 2;
  test.At(1, 0, 3) = -1;
  test.At(1, 0, 4) = std::nanf("");
  test.At(1, 1, 5) = 0.25f;
  const ZScores z = CompareImages(test, reference).z;
  CHECK(z.mismatched == 1);
  CHECK(z.invalid == 2);
  CHECK(z.count == 1);
  CHECK(z.exact == 8);
  CHECK(z.mean == 0);
}

TEST_CASE("images that cannot be compared are refused with the reason", "[metrics]") {
  CHECK_THROWS_WITH(CompareImages(MakeImage(4, 3, {"Y"}), MakeImage(5, 2, {"Y"})),
                    Catch::Contains("4 x 3 and 5 x 2"));
  CHECK_THROWS_AS(CompareImages(MakeImage(4, 3, {"Y"}), MakeImage(5, 2, {"Y"})),
                  InputError);
  CHECK_THROWS_WITH(
      CompareImages(MakeImage(1, 1, {"depth"}), MakeImage(1, 1, {"R", "G", "B"})),
      Catch::Contains("depth") && Catch::Contains("R, G, B"));
}

TEST_CASE("grey and 8-bit images compare as well", "[metrics]") {
  Image grey = MakeImage(1, 1, {"Y"});
  grey.At(0, 0, 0) = 0.25f;
  Image bytes;
  bytes.width = bytes.height = bytes.channels = 1;
  bytes.names = {"Y"};
  bytes.bytes = {255};
  const CompareResult r = CompareImages(bytes, grey);
  CHECK(r.channels == std::vector<std::string>{"Y"});
  CHECK(r.mse == Approx(0.75 * 0.75));
  CHECK(r.mean_ratio[0] == Approx(4));
}

}  // namespace lanelight

// What is said of two images, the maps and tiles of their errors, and the page's data.
#include "src/measure/compare/comparison.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "src/base/core/error.h"
#include "src/measure/compare/linear_image.h"

namespace lanelight {
namespace {

using Catch::Contains;
using Catch::EndsWith;

constexpr int kSide = 96;

// A ramp with noise of a known variance; `gain` in a square at (60, 12).
NamedImage Render(const std::string& name, std::uint32_t seed, double deviation,
                  double gain = 1) {
  NamedImage out = {
      name,
      MakeImage(kSide, kSide, {"R", "G", "B", "variance.R", "variance.G", "variance.B"})};
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, deviation);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const bool inside = x >= 60 && x < 76 && y >= 12 && y < 28;
      for (int c = 0; c < 3; ++c) {
        const double light = (0.2 + 0.005 * x + 0.1 * c) * (inside ? gain : 1);
        out.image.At(x, y, c) = static_cast<float>(light + normal(random));
        out.image.At(x, y, c + 3) = static_cast<float>(deviation * deviation);
      }
    }
  }
  return out;
}

}  // namespace

TEST_CASE("a verdict is one sentence with the findings", "[compare]") {
  const NamedImage reference = Render("ref", 1, 0.002);
  const auto verdict = [&](const NamedImage& image, ComparisonOptions options = {}) {
    return Compare(image, reference, options).verdict;
  };
  CHECK(verdict(reference) == "ref equals ref in every value");
  CHECK_THAT(verdict(Render("noisy", 2, 0.05)),
             Contains("noisy differs from ref by ") &&
                 EndsWith("; the difference is not significant"));
  CHECK_THAT(verdict(Render("other", 3, 0.05, 1.3)),
             Contains("the difference is significant (p "));
  NamedImage plain = Render("plain", 4, 0.05);
  plain.image.names[3] = "spread";
  CHECK_THAT(verdict(plain),
             EndsWith("significance unknown: the first image has no variances"));
  CHECK_THAT(verdict(plain, {.flip = true}), Contains("; FLIP 0."));
  NamedImage invalid = {"bad", MakeImage(kSide, kSide, {"R", "G", "B"})};
  for (float& v : invalid.image.pixels) v = std::nanf("");
  CHECK_THAT(verdict(invalid), Contains("no pixel with a valid value"));
}

TEST_CASE("the worst tiles are where the difference is", "[compare]") {
  const NamedImage reference = Render("ref", 1, 0);
  const ImageComparison c = Compare(Render("a", 1, 0, 1.5), reference, {});
  REQUIRE_FALSE(c.worst.empty());
  double share = 0;
  for (const ErrorTile& tile : c.worst) {
    CHECK(tile.x + tile.width > 60);
    CHECK(tile.x < 76);
    CHECK(tile.y + tile.height > 12);
    CHECK(tile.y < 28);
    share += tile.share;
  }
  CHECK(share <= 1 + 1e-12);
  CHECK(share > 0.5);
  for (std::size_t i = 1; i < c.worst.size(); ++i) {
    CHECK(c.worst[i].share <= c.worst[i - 1].share);
  }
  CHECK(Compare(reference, reference, {}).worst.empty());
}

TEST_CASE("maps of errors by hand, and scales that fit them", "[compare]") {
  const LinearImage a = {2, 1, {Plane{1, 0}, Plane{2, 0}, Plane{6, 0}}};
  const LinearImage b = {2, 1, {Plane{1, 0}, Plane{1, 0}, Plane{1, 0}}};
  const ErrorMaps maps = ErrorMapsOf(a, b);
  CHECK(maps.difference[0] == Approx(2 / std::sqrt(1.01)));
  CHECK(maps.relative[0] == Approx(std::sqrt((0 + 1 + 25) / 1.01 / 3)));
  CHECK(maps.absolute[0] == Approx(std::sqrt(26 / 3.0)));
  CHECK(maps.difference[1] == 0);
  CHECK(ScaleOf({0.013f, -0.04f}) == Approx(0.02));
  CHECK(ScaleOf({0, 0}) == 1);
  Plane outlier(1000, -0.003f);
  outlier[7] = 100;
  CHECK(ScaleOf(outlier) == Approx(0.005));
  CHECK(ScaleOf({std::nanf(""), 0.3f}) == Approx(0.5));
  // Most are equal: then of those that are not.
  Plane rare(1000, 0.0f);
  rare[3] = 0.04f;
  CHECK(ScaleOf(rare) == Approx(0.05));
}

TEST_CASE("JSON has all printed results", "[compare]") {
  const ImageComparison c = Compare(Render("a", 2, 0.05, 1.3), Render("b", 1, 0.01),
                                    {.flip = true, .pixels_per_degree = 40});
  const nlohmann::json json = ToJson(c);
  CHECK(json.at("verdict") == c.verdict);
  CHECK(json.at("relmse").get<double>() == Approx(c.metrics.relmse));
  CHECK(json.at("agreement").at("verdict") == "differ");
  CHECK(json.at("agreement").at("false_alarm") == 1e-3);
  const auto& tiles = json.at("agreement").at("tiles");
  CHECK(tiles.at("z").size() == tiles.at("rows"));
  CHECK(tiles.at("z")[0].size() == tiles.at("columns"));
  CHECK_FALSE(tiles.at("failed").empty());
  CHECK(json.at("flip").at("pixels_per_degree") == 40);
  CHECK(json.at("flip").at("hdr").at("mean").get<double>() > 0);
  CHECK(json.at("flip").at("exposures").at("count") == c.flip->exposures.count);
  CHECK(json.at("worst_tiles").size() == c.worst.size());
  CHECK(ToJson(Compare(Render("a", 2, 0.05), Render("b", 1, 0.01), {})).at("flip") ==
        nullptr);
}

TEST_CASE("8-bit images have LDR-FLIP only", "[compare]") {
  NamedImage a = {"a.png", Image{8, 8, 3, {"R", "G", "B"}, {}, {}, {}}};
  a.image.bytes.assign(8 * 8 * 3, 90);
  NamedImage b = a;
  b.image.bytes.assign(8 * 8 * 3, 120);
  const ImageComparison c = Compare(a, b, {.flip = true});
  CHECK(c.flip->hdr.empty());
  CHECK(c.flip->summary().mean > 0.05);
}

TEST_CASE("a sheet has a row for each image, and states its scales", "[compare]") {
  const NamedImage reference = Render("ref", 1, 0.001);
  const NamedImage tests[] = {Render("a", 2, 0.001), Render("b", 3, 0.001, 1.4)};
  std::vector<ImageComparison> comparisons;
  std::vector<SheetRow> rows;
  for (const NamedImage& test : tests) {
    comparisons.push_back(Compare(test, reference, {.flip = true}));
  }
  for (int i = 0; i < 2; ++i) rows.push_back({tests[i], reference, comparisons[i]});
  const ComparisonSheet sheet = SheetOf(rows);
  CHECK(sheet.image.width == 4 * kSide + 12);
  CHECK(sheet.image.height == 2 * kSide + 4);
  CHECK(sheet.image.At(3, 5, 1) == tests[0].image.At(3, 5, 1));
  CHECK(sheet.image.At(kSide + 4 + 3, kSide + 4 + 5, 2) == reference.image.At(3, 5, 2));
  // Brighter than the reference is red, where b is.
  const int x = 2 * (kSide + 4) + 68, y = kSide + 4 + 20;
  CHECK(sheet.image.At(x, y, 0) > 2 * sheet.image.At(x, y, 2));
  CHECK_THAT(SheetText(sheet),
             Contains(fmt::format("red +{:.3g} %", 100 * sheet.difference_scale)));
}

TEST_CASE("images of other sizes or channels are refused", "[compare]") {
  const NamedImage a = Render("a", 1, 0.1);
  CHECK_THROWS_AS(Compare(a, {"b", MakeImage(4, 4, {"R", "G", "B"})}, {}), InputError);
  CHECK_THROWS_AS(Compare(a, {"b", MakeImage(kSide, kSide, {"Y"})}, {}), InputError);
}

TEST_CASE("The synthetic comparison can be written", "[compare]") {
  const char* path = std::getenv("LANELIGHT_SYNTHETIC_COMPARE");
  const NamedImage reference = Render("</script><b>ref</b>.exr", 1, 0.0005);
  const std::vector<NamedImage> tests = {Render("noisy \"&\".exr", 2, 0.02),
                                         Render("brighter.exr", 3, 0.01, 1.2)};
  std::vector<ImageComparison> comparisons;
  for (const NamedImage& test : tests) {
    comparisons.push_back(Compare(test, reference, {.flip = true}));
  }
  const std::string page = ComparisonPage(tests, reference, comparisons);
  CHECK(page.size() > 300'000);
  CHECK_THAT(page, !Contains("<b>ref"));
  if (path == nullptr) return;
  std::ofstream file(path, std::ios::binary);
  file << page;
  REQUIRE(file.flush().good());
}

}  // namespace lanelight

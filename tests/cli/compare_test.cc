// `lanelight compare` of several images, its page and picture; `lanelight info IMAGE`.
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "src/base/image/exr.h"
#include "src/base/image/image.h"
#include "src/cli/exit_codes.h"
#include "tests/cli/process.h"

namespace lanelight {
namespace {

using Catch::Contains;

std::string WriteGrey(const std::string& path, float value) {
  std::vector<ExrPlane> planes;
  for (const char* name : {"R", "G", "B"}) {
    planes.push_back({name, std::vector<float>(24 * 16, value)});
  }
  WriteExr(path, 24, 16, planes);
  return path;
}

std::string ContentOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_CASE("several images are compared with the last", "[cli]") {
  TempDirectory directory;
  const std::string a = WriteGrey(directory / "a.exr", 1.1f);
  const std::string b = WriteGrey(directory / "b.exr", 1.5f);
  const std::string c = WriteGrey(directory / "c.exr", 1);
  const ProcessResult r = RunLanelight({"compare", a, b, c, "--json"});
  REQUIRE(r.exit_code == kExitGood);
  const auto json = nlohmann::json::parse(r.out);
  REQUIRE(json.at("comparisons").size() == 2);
  CHECK(json.at("comparisons")[0].at("test") == a);
  CHECK(json.at("comparisons")[1].at("reference") == c);
  CHECK(json.at("comparisons")[1].at("rmse").get<double>() == Approx(0.5));
  CHECK(json.at("comparisons")[1].at("flip") == nullptr);

  const ProcessResult over = RunLanelight({"compare", a, b, c, "--max-relmse", "0.02"});
  CHECK(over.exit_code == kExitOverLimit);
  CHECK_THAT(over.err, Contains("b.exr: over the limit") && !Contains("a.exr: over"));
  CHECK_THAT(over.out, Contains(a + " against " + c));

  // Two say what they said, and more.
  const auto two = nlohmann::json::parse(RunLanelight({"compare", a, c, "--json"}).out);
  CHECK(two.at("rmse").get<double>() == Approx(0.1).epsilon(1e-4));
  CHECK(two.at("over_limit") == false);
  CHECK(two.at("agreement").at("verdict") == "cannot tell");
  CHECK_THAT(RunLanelight({"compare", a, c, "--flip"}).out,
             Contains("\nFLIP ") && Contains("\nverdict "));
}

TEST_CASE("compare reports differences beyond noise in percent", "[cli]") {
  TempDirectory directory;
  const auto write = [&](const char* name, float value) {
    std::vector<ExrPlane> planes;
    for (const char* channel : {"R", "G", "B"}) {
      planes.push_back({channel, std::vector<float>(24 * 16, value)});
      planes.push_back(
          {std::string("variance.") + channel, std::vector<float>(24 * 16, 1e-6f), true});
    }
    WriteExr(directory / name, 24, 16, planes);
    return directory / name;
  };
  const std::string a = write("a.exr", 1), b = write("b.exr", 1.5f);
  const std::string differs = RunLanelight({"compare", a, b}).out;
  CHECK_THAT(differs, Contains("100 % of 1152 values differ by more than 2 standard "
                               "errors (noise alone: 4.55 %)") &&
                          Contains("significant difference in") &&
                          Contains("false-alarm rate 0.1 %"));
  CHECK_THAT(differs, !Contains("z-score") && !Contains("deviation"));
  CHECK_THAT(RunLanelight({"compare", a, a}).out, Contains("no significant difference"));
}

TEST_CASE("compare writes a page and a picture", "[cli]") {
  TempDirectory directory;
  const std::string a = WriteGrey(directory / "a.exr", 1.1f);
  const std::string b = WriteGrey(directory / "b.exr", 1);
  const std::string html = directory / "page.html", png = directory / "sheet.png";
  const ProcessResult r =
      RunLanelight({"compare", a, b, "--html", html, "--png", png, "--ppd", "40"});
  REQUIRE(r.exit_code == kExitGood);
  CHECK_THAT(r.out, Contains("from left to right") && Contains("40 pixels a degree"));
  CHECK_THAT(ContentOf(html), Contains("Lanelight <span>compare</span>") &&
                                  Contains("\"pixels_per_degree\":40.0"));
  const Image sheet = ReadImage(png);
  CHECK(sheet.width == 4 * 24 + 12);
  CHECK(sheet.height == 16);

  // No image is written over, were it named twice or swallowed by a flag.
  const std::string before = ContentOf(a);
  CHECK(RunLanelight({"compare", a, b, "--html", a}).exit_code == kExitUsage);
  CHECK(RunLanelight({"compare", b, sheet.names.empty() ? b : png, "--png", png})
            .exit_code == kExitBadInput);
  CHECK(ContentOf(a) == before);
  CHECK(RunLanelight({"compare", a, b, "--html", directory / "no/page.html"}).exit_code ==
        kExitBadInput);
  CHECK(RunLanelight({"compare", a, b, "--ppd", "0"}).exit_code == kExitUsage);
}

TEST_CASE("info prints the metadata of an image", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory), exr = directory / "out.exr";
  REQUIRE(RunLanelight({"render", scene, "-o", exr, "--seed", "7", "--crop", "4,2,20,18",
                        "--depth", "half"})
              .exit_code == kExitGood);
  const ProcessResult text = RunLanelight({"info", exr});
  CHECK(text.exit_code == kExitGood);
  CHECK_THAT(text.out, Contains("16x16, pixels 4,2 to 19,17 of a picture of 32x24") &&
                           Contains("R G B (half)") && Contains("16 per pixel") &&
                           Contains("% [") && Contains("directions=mis") &&
                           Contains("seed           7\n"));
  const auto json = nlohmann::json::parse(RunLanelight({"info", exr, "--json"}).out);
  const auto& part = json.at("parts").at(0);
  CHECK(part.at("attributes").at("spp") == 16);
  CHECK(part.at("attributes").at("observations").get<int>() >= 4);
  CHECK_FALSE(part.at("attributes").at("machine").get<std::string>().empty());
  const auto settings =
      nlohmann::json::parse(part.at("attributes").at("settings").get<std::string>());
  CHECK(settings.at("max_depth").is_number());
  const auto& error = part.at("error");
  CHECK(error.at("low") <= error.at("value"));
  CHECK(error.at("value").get<double>() < 1);

  // Of others: what is there.
  const std::string foreign = WriteGrey(directory / "foreign.exr", 1);
  CHECK_THAT(RunLanelight({"info", foreign}).out,
             Contains("24x16") && Contains("it says none"));
  std::ofstream(directory / "no.exr") << "not an image";
  const ProcessResult bad = RunLanelight({"info", directory / "no.exr"});
  CHECK(bad.exit_code == kExitBadInput);
  CHECK_THAT(bad.err, Contains("no.exr") && Contains("not an EXR file"));
  CHECK(RunLanelight({"info", directory / "none.exr"}).exit_code == kExitBadInput);
}

}  // namespace lanelight

// EXR files keep names, values, windows and attributes; damaged ones are refused.
#include "src/base/image/exr.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "src/base/core/error.h"
#include "src/base/core/input_file.h"
#include "src/base/core/parallel.h"
#include "tests/base/image/temporary_folder.h"

namespace lanelight {
namespace {

std::vector<ExrPlane> SomePlanes(int width, int height) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(0, 4);
  std::vector<ExrPlane> planes = {
      {"R", {}}, {"G", {}}, {"B", {}}, {"variance.R", {}}, {"samples", {}, true}};
  for (ExrPlane& plane : planes) {
    for (int i = 0; i < width * height; ++i) plane.values.push_back(uniform(random));
  }
  planes[4].values[0] = 1e6f;
  return planes;
}

}  // namespace

TEST_CASE("an EXR file round-trips", "[image][exr]") {
  const TemporaryFolder folder;
  const std::string path = folder.File("a.exr");
  const int width = 37, height = 21;
  const auto planes = SomePlanes(width, height);
  ExrOptions options;
  options.half = GENERATE(false, true);
  options.x0 = 5, options.y0 = 7, options.full_width = 100, options.full_height = 80;
  options.attributes = {{"strategy", "owen sobol"},
                        {"spp", 64},
                        {"seconds", 1.5},
                        {"seed", "1844674407370955"}};
  WriteExr(path, width, height, planes, options);
  CHECK(folder.Count() == 1);

  const Image image = ReadExr(path);
  CHECK(image.width == width);
  CHECK(image.height == height);
  CHECK(image.names == std::vector<std::string>{"R", "G", "B", "samples", "variance.R"});
  CHECK(std::get<std::string>(image.attributes.at("strategy")) == "owen sobol");
  CHECK(std::get<int>(image.attributes.at("spp")) == 64);
  CHECK(std::get<double>(image.attributes.at("seconds")) == 1.5);
  for (const ExrPlane& plane : planes) {
    const int c = image.FindChannel(plane.name);
    REQUIRE(c >= 0);
    const float tolerance = options.half && !plane.always_float ? 1.0f / 2048 : 0.0f;
    bool equal = true;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const float want = plane.values[y * width + x];
        equal &= std::abs(image.At(x, y, c) - want) <= tolerance * want;
      }
    }
    INFO(plane.name);
    CHECK(equal);
  }
}

TEST_CASE("an EXR file is bit-identical for any number of threads", "[image][exr]") {
  const TemporaryFolder folder;
  const auto write = [&](int threads) {
    const ThreadLimit limit(threads);
    const std::string path = folder.File(std::to_string(threads) + ".exr");
    WriteExr(path, 701, 509, SomePlanes(701, 509));
    return ReadWholeFile(path);
  };
  CHECK(write(1) == write(2));
}

TEST_CASE("named channels are returned in the requested order", "[image][exr]") {
  const TemporaryFolder folder;
  const std::string path = folder.File("a.exr");
  const auto planes = SomePlanes(3, 2);
  WriteExr(path, 3, 2, planes);
  const Image image = ReadExr(path, {"samples", "G"});
  CHECK(image.channels == 2);
  CHECK(image.At(0, 0, 0) == 1e6f);
  CHECK(image.At(2, 1, 1) == planes[1].values[5]);
  CHECK_THROWS_WITH(ReadExr(path, {"R", "depth"}),
                    Catch::Contains("no channel \"depth\"") &&
                        Catch::Contains("R, G, B, samples, variance.R"));
}

TEST_CASE("half files saturate instead of becoming infinite", "[image][exr]") {
  const TemporaryFolder folder;
  const std::string path = folder.File("a.exr");
  const float inf = std::numeric_limits<float>::infinity();
  WriteExr(path, 3, 1, {{"R", {1e6f, -1e6f, inf}}}, {.half = true, .attributes = {}});
  const Image image = ReadExr(path);
  CHECK(image.At(0, 0, 0) == 65504.0f);
  CHECK(image.At(1, 0, 0) == -65504.0f);
  CHECK(image.At(2, 0, 0) == inf);
}

TEST_CASE("every truncation of an EXR file is an input error", "[image][exr]") {
  const TemporaryFolder folder;
  const std::string path = folder.File("a.exr");
  WriteExr(path, 16, 40, SomePlanes(16, 40));
  const std::string whole = ReadWholeFile(path);
  for (std::size_t keep = 0; keep < whole.size(); keep += 1 + keep / 20) {
    INFO(keep << " of " << whole.size() << " bytes");
    const std::string cut = folder.Write("cut.exr", whole.substr(0, keep));
    CHECK_THROWS_WITH(ReadExr(cut), Catch::Contains("cut.exr"));
    CHECK_THROWS_AS(ReadExr(cut), InputError);
  }
  CHECK_THROWS_WITH(
      ReadExr(folder.Write("text.exr", "not an image at all, but long enough")),
      Catch::Contains("text.exr"));
  CHECK_THROWS_WITH(ReadExr(folder.File("absent.exr")), Catch::Contains("No such file"));
}

TEST_CASE("an EXR header that claims an absurd size is refused", "[image][exr]") {
  const TemporaryFolder folder;
  const std::string path = folder.File("a.exr");
  WriteExr(path, 2, 2, {{"R", {1, 2, 3, 4}}});
  std::string bytes = ReadWholeFile(path);
  const std::size_t at = bytes.find("dataWindow");
  REQUIRE(at != std::string::npos);
  // "dataWindow\0box2i\0", size, xMin, yMin, xMax, yMax
  const std::size_t x_max = at + 11 + 6 + 4 + 8;
  const int huge = 40000;
  for (int side = 0; side < 2; ++side) {
    bytes.replace(x_max + 4 * side, 4, reinterpret_cast<const char*>(&huge), 4);
  }
  CHECK_THROWS_AS(ReadExr(folder.Write("huge.exr", bytes)), InputError);
}

TEST_CASE("deep EXR files are refused before their samples are read", "[image][exr]") {
  const TemporaryFolder folder;
  const std::string path = folder.File("a.exr");
  WriteExr(path, 2, 2, {{"R", {1, 2, 3, 4}}});
  std::string bytes = ReadWholeFile(path);
  const std::string type("type\0string\0\x0c\0\0\0deepscanline", 28);
  bytes.insert(8, type);  // before the other attributes
  CHECK_THROWS_WITH(ReadExr(folder.Write("deep.exr", bytes)),
                    Catch::Contains("deep images are not read"));
}

TEST_CASE("failing to write an EXR reports the reason", "[image][exr]") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(WriteExr(folder.File("no/a.exr"), 1, 1, {{"R", {1}}}),
                    Catch::Contains("No such file or directory"));
  CHECK_THROWS_WITH(WriteExr("/dev/full", 1, 1, {{"R", {1}}}),
                    Catch::Contains("No space left"));
  CHECK(folder.Count() == 0);
}

}  // namespace lanelight

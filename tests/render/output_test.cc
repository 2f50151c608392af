// What of a film ends up in the file, where files may go, and what a scene hash covers.
#include "src/render/output.h"
#include "src/render/saving.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>

#include "src/core/error.h"
#include "tests/cli/process.h"

namespace lanelight {
namespace {

using Catch::Contains;

// Two pixels at (3, 4): the first with samples 1 and 3, the second with one sample.
FilmAccumulator SmallFilm(bool aov) {
  FilmAccumulator film(3, 4, 2, 1, {1, false}, aov);
  float values[10][2];
  const float* planes[10];
  for (int p = 0; p < 10; ++p) {
    values[p][0] = 1.0f + static_cast<float>(p);
    values[p][1] = 3.0f + static_cast<float>(p);
    planes[p] = values[p];
  }
  film.AddSamples(3, 4, planes, 2);
  film.AddSamples(4, 4, planes, 1);
  return film;
}

const ExrPlane& Find(const std::vector<ExrPlane>& planes, const std::string& name) {
  for (const ExrPlane& plane : planes) {
    if (plane.name == name) return plane;
  }
  FAIL("no plane " << name);
  return planes.front();
}

}  // namespace

TEST_CASE("planes hold means, variances of the mean and counts", "[render]") {
  const auto planes = FilmPlanes(SmallFilm(false), 4);
  CHECK(planes.size() == 7);
  CHECK(Find(planes, "R").values == std::vector<float>{2, 1});
  CHECK(Find(planes, "B").values == std::vector<float>{4, 3});
  // Samples 1 and 3: variance 2, of their mean 1.
  CHECK(Find(planes, "variance.G").values[0] == Approx(1));
  CHECK(std::isnan(Find(planes, "variance.G").values[1]));
  CHECK(Find(planes, "samples").values == std::vector<float>{2, 1});
  CHECK(Find(planes, "variance.R").always_float);
}

TEST_CASE("depth is written in units of the scene file", "[render]") {
  const auto planes = FilmPlanes(SmallFilm(true), 4);
  CHECK(planes.size() == 14);
  CHECK(Find(planes, "albedo.R").values[0] == Approx(5));
  CHECK(Find(planes, "depth.Z").values[0] == Approx(11 / 4.0));
  CHECK(Find(planes, "depth.Z").always_float);
}

TEST_CASE("the PNG shows the means", "[render]") {
  const Image image = FilmImage(SmallFilm(false));
  CHECK(image.width == 2);
  CHECK(image.At(0, 0, 0) == 2);
  CHECK(image.At(1, 0, 2) == 3);
}

TEST_CASE("outputs that cannot be files are refused", "[render]") {
  TempDirectory directory;
  CHECK_NOTHROW(CheckWritable(directory / "new.exr"));
  CHECK(directory.Files().empty());
  CHECK_THROWS_WITH(CheckWritable(directory.path()), Contains("directory"));
  CHECK_THROWS_WITH(CheckWritable(directory / "no/new.exr"), Contains("no directory"));
  CHECK_THROWS_WITH(CheckWritable("/dev/null"), Contains("not a regular file"));
  const std::string existing = WriteText(directory / "old.exr", "x");
  CHECK_NOTHROW(CheckWritable(existing));
}

TEST_CASE("the scene hash covers every file that the scene names", "[render]") {
  TempDirectory directory;
  std::filesystem::create_directory(directory / "m");
  const std::string scene = WriteText(
      directory / "a.pbrt", "# a \"lonely quote\nInclude \"m/b.pbrt\" Shape \"sphere\"");
  WriteText(directory / "m/b.pbrt", "Shape \"plymesh\" \"string filename\" \"m/c.ply\"");
  WriteText(directory / "m/c.ply", "ply 1");
  const std::uint64_t first = HashSceneFiles(scene);
  CHECK(HashSceneFiles(scene) == first);
  WriteText(directory / "m/c.ply", "ply 2");
  const std::uint64_t second = HashSceneFiles(scene);
  CHECK(second != first);
  WriteText(directory / "unrelated.ply", "ply");
  CHECK(HashSceneFiles(scene) == second);
  CHECK_NOTHROW(HashSceneFiles(directory / "missing.pbrt"));
}

}  // namespace lanelight

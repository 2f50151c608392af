// What of a film ends up in the file, where files may go, and what a scene hash covers.
#include "src/base/core/input_file.h"
#include "src/render/job/output.h"
#include "src/render/job/saving.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>

#include "src/base/core/error.h"
#include "src/base/image/atomic_file.h"
#include "src/base/image/exr.h"
#include "src/base/image/image.h"
#include "tests/cli/process.h"

namespace lanelight {
namespace {

using Catch::Contains;

// Two pixels at (3, 4): the first with samples 1 and 3, the second with one sample.
FilmAccumulator SmallFilm(Auxiliary auxiliary) {
  FilmAccumulator film(3, 4, 2, 1, {1, false}, auxiliary);
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
  const auto planes = FilmPlanes(SmallFilm(Auxiliary::kNone), 4);
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
  const auto planes = FilmPlanes(SmallFilm(Auxiliary::kAov), 4);
  CHECK(planes.size() == 14);
  CHECK(Find(planes, "albedo.R").values[0] == Approx(5));
  CHECK(Find(planes, "depth.Z").values[0] == Approx(11 / 4.0));
  CHECK(Find(planes, "depth.Z").always_float);
}

TEST_CASE("the PNG shows the means", "[render]") {
  const Image image = FilmImage(SmallFilm(Auxiliary::kNone));
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

TEST_CASE("names at and beyond the length limit are distinguished", "[render]") {
  TempDirectory directory;
  const std::string longest = directory / (std::string(251, 'a') + ".exr");
  CHECK_NOTHROW(CheckWritable(longest));
  WriteFileAtomically(longest, "whole");
  CHECK(ReadWholeFile(longest) == "whole");
  CHECK(directory.Files().size() == 1);
  CHECK_THROWS_WITH(CheckWritable(directory / (std::string(252, 'a') + ".exr")),
                    Contains("cannot write") && Contains("too long"));
  // Cut between characters.
  std::string umlauts;
  while (umlauts.size() < 250) umlauts += "ä";
  const std::string start = TemporaryStart(umlauts);
  CHECK(start.size() == 220);
  CHECK(TemporaryStart("x" + umlauts).size() == 219);
  CHECK(TemporaryStart("a/" + umlauts).size() == 222);
  CHECK(TemporaryStart("a/b.exr") == "a/b.exr");
  CHECK(std::filesystem::path(FallbackPath(longest)).filename().string().size() < 240);
  CHECK(FallbackPath(longest).ends_with("a.exr"));
}

TEST_CASE("outputs never overwrite inputs, even through links", "[render]") {
  TempDirectory directory;
  namespace fs = std::filesystem;
  const std::string input = WriteText(directory / "in.png", "x");
  fs::create_directory(directory / "sub");
  fs::create_symlink(input, directory / "soft.png");
  fs::create_hard_link(input, directory / "hard.png");
  fs::create_directory_symlink(directory.path(), directory / "sub/up");
  for (const char* path :
       {"in.png", "soft.png", "hard.png", "sub/../in.png", "sub/up/in.png"}) {
    INFO(path);
    CHECK_THROWS_WITH(CheckOutputPaths({{directory / path}}, {input}),
                      Contains("would overwrite") && Contains("in.png"));
    CHECK_THROWS_WITH(
        CheckOutputPaths({{directory / "other.exr", input, directory / path}}, {}),
        Contains("two outputs"));
  }
  // Neither is there yet.
  CHECK_THROWS_WITH(
      CheckOutputPaths({{directory / "new.exr", directory / "sub/up/new.exr"}}, {input}),
      Contains("two outputs"));
  CHECK_NOTHROW(CheckOutputPaths({{directory / "new.exr", "", "-", "-"}}, {input}));
  CHECK_NOTHROW(CheckOutputPaths({{directory / "a.exr", directory / "b.exr"}}, {input}));
  // A folder takes in what lies in it, itself there or not.
  for (const char* folder : {"", "sub/up", "sub/..", "."}) {
    CHECK_THROWS_WITH(CheckOutputPaths({{}, {directory / folder}}, {input}),
                      Contains("in.png', which is an input, lies in"));
  }
  CHECK_NOTHROW(CheckOutputPaths({{}, {directory / "sub", directory / "in"}}, {input}));
}

TEST_CASE("the scene hash excludes the film's file name", "[render]") {
  TempDirectory directory;
  const std::string scene = WriteText(directory / "a.pbrt", R"(
Film "rgb" # "rgb.txt"
  "string filename" [ "out.exr" ] "integer xresolution" 4
LightSource "infinite" "string filename" "sky.exr")");
  const std::uint64_t first = HashSceneFiles(scene);
  WriteText(directory / "out.exr", "an image of before");
  WriteText(directory / "rgb.txt", "only in a comment");
  CHECK(HashSceneFiles(scene) == first);
  WriteText(directory / "sky.exr", "another sky");
  CHECK(HashSceneFiles(scene) != first);
}

TEST_CASE("variances beyond 32 bits are written in another unit", "[render]") {
  TempDirectory directory;
  for (const double size : {1.0, 1e-9, 1e12, 1e15, 1e30, 1e-20, 1e-30}) {
    CAPTURE(size);
    FilmAccumulator film(0, 0, 2, 1, SampleGroups{}, Auxiliary::kNone);
    const float dim = static_cast<float>(size * 1e-6), bright = static_cast<float>(size);
    const float dims[2] = {dim, 3 * dim}, brights[2] = {bright, 3 * bright};
    const float zeros[2] = {0, 0};
    const float* const first[3] = {dims, zeros, brights};
    const float* const second[3] = {brights, brights, dims};
    film.AddSamples(0, 0, first, 2);
    film.AddSamples(1, 0, second, 2);
    const std::string path = directory / "variance.exr";
    ExrOptions options;
    NoteVarianceUnit(film, options);
    WriteExr(path, 2, 1, FilmPlanes(film, 1), options);
    const Image image = ReadExr(path);
    const double unit = VarianceUnit(image);
    const bool ordinary = size > 1e-10 && size < 1e18;
    CHECK((unit == 1) == ordinary);
    CHECK(image.attributes.contains(kVarianceExponent) != ordinary);
    for (int x = 0; x < 2; ++x) {
      for (int c = 0; c < 3; ++c) {
        const int channel = image.FindChannel(std::string("variance.") + "RGB"[c]);
        CHECK(unit * double(image.At(x, 0, channel)) ==
              Approx(film.Variance(x, 0)[c]).epsilon(1e-6));
      }
    }
  }
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

// What a study keeps on disk, and references from files.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "src/base/core/error.h"
#include "src/base/core/input_file.h"
#include "src/measure/report/page.h"
#include "src/measure/study/study.h"
#include "src/render/films/colors.h"
#include "src/render/wave/profile.h"
#include "tests/base/image/temporary_folder.h"
#include "tests/measure/study/simulated.h"

namespace lanelight {
namespace {

using Catch::Contains;
using reference::Random;

Cells SomeCells(int repetitions) {
  Random random(2);
  const Reference r = NoisyReference(4, 3, 0.1, random);
  Cells cells = Simulate(r, repetitions, 0.1, random);
  StageProfile stage;
  stage.name = "generate";
  stage.items = 12;
  stage.seconds = 0.25;
  AddStages({stage}, cells.stages);
  AddStages({stage}, cells.stages);
  return cells;
}

}  // namespace

TEST_CASE("finished renders round-trip through the disk", "[study]") {
  const TemporaryFolder folder;
  const CellStore store(folder.File("cells"), {3, 1, 7, 4});
  Cells cells = SomeCells(3);
  CHECK(store.Load("a strategy", 16).repetitions.empty());
  cells.repetitions[1].machine.processor = "a processor";
  cells.repetitions[1].machine.load = 0.25;
  store.Save("a strategy", 16, cells);
  const Cells back = store.Load("a strategy", 16);
  REQUIRE(back.repetitions.size() == 3);
  CHECK(CsvRow(back.repetitions[2]) == CsvRow(cells.repetitions[2]));
  CHECK(MachineText(back.repetitions[0].machine) == MachineText({}));
  CHECK(back.repetitions[1].machine.processor == "a processor");
  CHECK(back.repetitions[1].machine.load == 0.25);
  for (std::size_t i = 0; i < 12; ++i) {
    CHECK(back.moments.Mean(i) == cells.moments.Mean(i));
    CHECK(back.moments.Variance(i) == cells.moments.Variance(i));
    CHECK(back.moments.GreyVariance(i) == cells.moments.GreyVariance(i));
  }
  CHECK(back.moments.count() == 3);
  CHECK(back.first == cells.first);
  REQUIRE(back.stages.size() == 1);
  CHECK(back.stages[0].seconds == 0.5);
  CHECK(back.stages[0].items == 24);
  CHECK(store.Load("a strategy", 32).repetitions.empty());
  CHECK(store.Load("another", 16).repetitions.empty());
}

TEST_CASE("damaged files of finished renders are refused by name", "[study]") {
  const TemporaryFolder folder;
  const CellStore store(folder.File("cells"), {3, 1, 7, 4});
  store.Save("s", 4, SomeCells(2));
  const std::string path =
      std::filesystem::directory_iterator(folder.File("cells"))->path().string();
  SECTION("cut off") { std::filesystem::resize_file(path, 600); }
  SECTION("cut off in the header") { std::filesystem::resize_file(path, 20); }
  SECTION("empty") { std::filesystem::resize_file(path, 0); }
  SECTION("something else") { std::ofstream(path) << "hello\nworld"; }
  SECTION("a bit flipped") {
    std::string bytes = ReadWholeFile(path);
    bytes[bytes.size() / 2] ^= 1;
    std::ofstream(path) << bytes;
  }
  SECTION("of another strategy") {
    const CellStore others(folder.File("others"), {3, 1, 7, 4});
    others.Save("t", 4, SomeCells(2));
    const std::filesystem::directory_iterator other(folder.File("others"));
    std::filesystem::copy_file(other->path(), path,
                               std::filesystem::copy_options::overwrite_existing);
  }
  SECTION("of an image of another size") {
    const CellStore other(folder.File("cells"), {0, 0, 13, 1});
    CHECK_THROWS_WITH(other.Load("s", 4), Contains(path) && Contains("size"));
    return;
  }
  CHECK_THROWS_WITH(store.Load("s", 4), Contains(path) && Contains("remove it"));
}

TEST_CASE("references are read for the window that is rendered", "[study]") {
  const TemporaryFolder folder;
  const std::vector<Rgb> image = Truth(4 * 3);
  const std::string path = folder.File("r.exr");
  WriteColors(path, 4, 3, {{"", &image}});
  SECTION("whole") {
    const Reference r = ReadReference({path}, {0, 0, 4, 3}, 4, 3);
    CHECK(r.mean[5].y == Approx(image[5].y));
    CHECK_FALSE(r.has_variance());
    CHECK_FALSE(r.note.empty());
    CHECK(r.OwnRelMse() == 0);
  }
  SECTION("a crop of the whole") {
    const Reference r = ReadReference({path}, {1, 1, 3, 3}, 4, 3);
    REQUIRE(r.mean.size() == 4);
    CHECK(r.mean[0].x == Approx(image[1 * 4 + 1].x));
    CHECK(r.mean[3].x == Approx(image[2 * 4 + 2].x));
  }
  SECTION("the crop alone") {
    CHECK(ReadReference({path}, {10, 10, 14, 13}, 64, 64).mean.size() == 12);
  }
  SECTION("of another size") {
    CHECK_THROWS_WITH(ReadReference({path}, {0, 0, 5, 3}, 5, 3),
                      Contains(path) && Contains("4x3") && Contains("5x3"));
  }
  SECTION("not finite") {
    std::vector<Rgb> bad = image;
    bad[7].z = std::nan("");
    WriteColors(path, 4, 3, {{"", &bad}});
    CHECK_THROWS_WITH(ReadReference({path}, {0, 0, 4, 3}, 4, 3),
                      Contains("1 of 12 pixels"));
  }
  SECTION("without colour") {
    WriteColors(path, 4, 3, {{"normal.", &image}});
    CHECK_THROWS_WITH(ReadReference({path}, {0, 0, 4, 3}, 4, 3),
                      Contains(path) && Contains("normal.B, normal.G, normal.R"));
  }
  SECTION("with its variance") {
    const std::vector<Rgb> variance(12, Rgb{0.01, 0.02, 0.03});
    WriteColors(path, 4, 3, {{"", &image}, {"variance.", &variance}});
    const Reference r = ReadReference({path}, {0, 0, 4, 3}, 4, 3);
    CHECK(r.Variance(3).z == Approx(0.03));
    CHECK(r.OwnMse() == Approx(0.02));
  }
  SECTION("two of them measure their noise") {
    const std::string second = folder.File("b.exr");
    std::vector<Rgb> other = image;
    other[2] += Rgb{0.2, 0, 0};
    WriteColors(second, 4, 3, {{"", &other}});
    const Reference r = ReadReference({path, second}, {0, 0, 4, 3}, 4, 3);
    CHECK(r.mean[2].x == Approx(image[2].x + 0.1));
    CHECK(r.Variance(2).x == Approx(0.01));  // (0.2 / 2)^2
    CHECK(r.Variance(3).x == 0);
  }
}

TEST_CASE("images of a large study are shrunk for the report", "[study]") {
  std::vector<ReportImage> images = {{"a", 3, 2, 1, {1, 2, 6, 3, 4, 8}}};
  CHECK(ShrinkImages(images, 6) == 1);
  CHECK(images[0].values.size() == 6);
  CHECK(ShrinkImages(images, 5) == 2);
  CHECK(images[0].width == 2);
  CHECK(images[0].height == 1);
  CHECK(images[0].values == std::vector<float>{2.5f, 7.0f});
}

TEST_CASE("file names are derived from strategy names", "[study]") {
  CHECK(Slug("paper-plain") == "paper-plain");
  CHECK(Slug("points=sobol,reuse=block:8:random") == "points-sobol-reuse-block-8-random");
  CHECK(Slug("../../etc") == "etc");
  CHECK(Slug("=") == "strategy");
  CHECK(Slug(std::string(200, 'x')).size() <= 60);
}

}  // namespace lanelight

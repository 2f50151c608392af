// Tiles, and what copies, files and readers of a state take of memory and of the disk.
#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <thread>
#include <utility>

#include "src/base/state/tiles.h"
#include "tests/base/image/temporary_folder.h"
#include "tests/base/state/random_film.h"

namespace lanelight {
namespace {

using Catch::Contains;

// Kilobytes of a line of /proc/self/status.
long Status(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind(key + ":", 0) == 0) return std::stol(line.substr(key.size() + 1));
  }
  return -1;
}

}  // namespace

TEST_CASE("invalid tiles are detected", "[state]") {
  const PixelRect film = {0, 0, 10, 10};
  CHECK(TileProblem({}, film).empty());
  CHECK(TileProblem({{0, 0, 5, 5}, {5, 0, 10, 5}, {0, 5, 10, 10}}, film).empty());
  CHECK_THAT(TileProblem({{3, 3, 3, 4}}, film), Contains("no pixels"));
  CHECK_THAT(TileProblem({{3, 3, 4, 11}}, film), Contains("[3, 4) x [3, 11)"));
  CHECK_THAT(TileProblem({{-1, 0, 4, 4}}, film), Contains("not inside"));

  // Against all pairs of pixels.
  std::mt19937 random(3);
  const auto upto = [&](int n) { return static_cast<int>(random() % unsigned(n)); };
  int overlaps = 0;
  for (int k = 0; k < 3000; ++k) {
    std::vector<PixelRect> tiles;
    std::vector<int> covered(100);
    for (int i = 0; i < 4; ++i) {
      const int x = upto(9), y = upto(9);
      tiles.push_back(
          {x, y, std::min(10, x + 1 + upto(4)), std::min(10, y + 1 + upto(4))});
      for (int v = tiles[i].y0; v < tiles[i].y1; ++v) {
        for (int u = tiles[i].x0; u < tiles[i].x1; ++u) ++covered[v * 10 + u];
      }
    }
    const bool overlap = *std::max_element(covered.begin(), covered.end()) > 1;
    overlaps += overlap;
    REQUIRE(TileProblem(tiles, film).empty() != overlap);
  }
  CHECK(overlaps > 500);
  CHECK(overlaps < 2900);
}

TEST_CASE("a copy is independent of the state and can be written while that is read",
          "[state]") {
  const TemporaryFolder folder;
  const PixelRect window = {0, 0, 70, 50};
  RandomFilm film = RandomFilm::Make(window, 1);
  const RandomFilm before = film;
  WriteState(film.Content({window}), folder.File("old"));
  const StateCopy copy(film.Content({window}));
  film = RandomFilm(window);
  std::thread writer([&] {
    for (int i = 0; i < 20; ++i) copy.Write(folder.File("state"));
  });
  int wrong = 0;
  for (int i = 0; i < 20; ++i) {
    RandomFilm read(window);
    StateFile(folder.File("old")).ReadPixels(read.Columns(), window);
    wrong += !HoldsTiles(read, before, {window});
  }
  writer.join();
  CHECK(wrong == 0);
  RandomFilm read(window);
  StateFile(folder.File("state")).ReadPixels(read.Columns(), window);
  CHECK(HoldsTiles(read, before, {window}));
  CHECK(HoldsTiles(film, before, {}));
}

TEST_CASE("compressible columns take little disk space", "[state]") {
  std::mt19937_64 random(1);
  // A sixteenth of the bits, and three quarters of the values zero.
  std::vector<double> sums(12 * 10000);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (i % 12 < 3) sums[i] = static_cast<double>(random() % 16);
  }
  const std::vector<std::uint64_t> samples(10000, 64);
  StateContent content;
  content.window = {0, 0, 100, 100};
  content.tiles = {content.window};
  content.pixels = {MakeStateColumn<double>("sums", "", std::as_const(sums), {4, 3}),
                    MakeStateColumn<std::uint64_t>("samples", "", samples)};
  CHECK(StateBytes(content).size() < 10000 * (12 + 1) * 8 / 20);
  content.compress = false;
  CHECK(StateBytes(content).size() > 10000 * (12 + 1) * 8);
}

TEST_CASE("memory for reading does not grow with the state", "[state]") {
  const TemporaryFolder folder;
  std::vector<std::uint64_t> table(6u << 20), read(table.size());  // 48 MiB
  std::mt19937_64 random(1);
  for (std::uint64_t& n : table) n = random();
  StateContent content;
  content.tables = {MakeStateColumn<std::uint64_t>("table", "", table)};
  WriteState(content, folder.File("state"));
  std::fill(read.begin(), read.end(), 1);
  std::ofstream("/proc/self/clear_refs") << "5";  // the peak begins here
  const long before = Status("VmHWM");
  const StateFile file(folder.File("state"));
  file.ReadTable(MakeStateColumn<std::uint64_t>("table", "", read));
  const long grown = Status("VmHWM") - before;
  CHECK(read == table);
  REQUIRE(before > 0);
  CHECK(grown < 4096);
}

}  // namespace lanelight

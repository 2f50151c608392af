// What ranks exchange and how work is dealt out, without ranks; with them:
// tests/ranks/ranks_test.py.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "src/core/check.h"
#include "src/wavefront/crew_start.h"
#include "src/wavefront/hand_out.h"
#include "src/wavefront/tile_columns.h"

namespace lanelight {
namespace {

constexpr PixelRect kWindow = {3, 5, 13, 11};

// Two columns of the window's pixels, of 1 and of 3 values each.
struct Columns {
  std::vector<std::uint64_t> ones;
  std::vector<double> threes;
  explicit Columns(double first) : ones(kWindow.pixels()), threes(3 * kWindow.pixels()) {
    std::iota(ones.begin(), ones.end(), static_cast<std::uint64_t>(first));
    std::iota(threes.begin(), threes.end(), first);
  }
  TileColumns Rows() {
    return {{MakeStateColumn<std::uint64_t>("ones", "", ones),
             MakeStateColumn<double>("threes", "", threes, {3})},
            kWindow};
  }
};

TEST_CASE("a tile's rows go into other columns, and nothing else does", "[crew]") {
  Columns from(1), to(1000);
  const PixelRect tile = {4, 6, 7, 8};
  std::string bytes = "before";
  from.Rows().Append(tile, bytes);
  const std::string_view rows = std::string_view(bytes).substr(6);
  REQUIRE(rows.size() == from.Rows().BytesOf(tile));
  REQUIRE(rows.size() == 6 * (8 + 24));
  to.Rows().Put(tile, rows);
  const Columns old(1000);
  for (int y = kWindow.y0; y < kWindow.y1; ++y) {
    for (int x = kWindow.x0; x < kWindow.x1; ++x) {
      const std::size_t i = static_cast<std::size_t>((y - 5) * 10 + x - 3);
      const bool inside = x >= 4 && x < 7 && y >= 6 && y < 8;
      CAPTURE(x, y);
      CHECK(to.ones[i] == (inside ? from : old).ones[i]);
      CHECK(to.threes[3 * i + 2] == (inside ? from : old).threes[3 * i + 2]);
    }
  }
  CHECK_THROWS_AS(to.Rows().Put(tile, rows.substr(1)), CheckFailure);
  CHECK_THROWS_AS(to.Rows().Append({0, 6, 7, 8}, bytes), CheckFailure);
}

std::vector<TileRange> Tiles(std::uint32_t count) {
  std::vector<TileRange> ranges;
  for (std::uint32_t i = 0; i < count; ++i) ranges.push_back({i, 0, 32, 8192});
  return ranges;
}

TEST_CASE("every tile is given away once, in smaller batches at the end", "[crew]") {
  constexpr double kCost = 1e-6;  // seconds of a sample
  HandOut queue(Tiles(1000), 8, kCost);
  std::set<std::uint32_t> seen;
  std::vector<std::size_t> sizes;
  while (queue.left() > 0) {
    const std::vector<TileRange> batch =
        sizes.size() % 2 == 0 ? queue.Next(4) : queue.NextOne();
    REQUIRE(!batch.empty());
    for (const TileRange& range : batch) CHECK(seen.insert(range.tile).second);
    if (sizes.size() % 2 == 0) CHECK(batch.size() * 8192 * kCost / 4 <= 0.2);
    sizes.push_back(batch.size());
  }
  CHECK(seen.size() == 1000);
  CHECK(sizes.front() == 96);
  CHECK(sizes.back() == 1);
  CHECK(queue.Next(4).empty());
  CHECK(queue.NextOne().empty());
}

TEST_CASE("batches follow what samples cost", "[crew]") {
  HandOut queue(Tiles(100000), 2, 0);
  CHECK(queue.Next(2).size() == 2);  // nothing is known yet
  queue.Took(2 * 8192, 0.01, 2);
  CHECK(queue.cost() == Approx(0.02 / 16384));
  CHECK(queue.LongestSeconds() == Approx(0.01));
  CHECK(queue.Next(2).size() == 2 * 20);
  for (int i = 0; i < 100; ++i) queue.Took(8192, 10, 1);
  CHECK(queue.Next(2).size() == 2);  // a tile of 10 seconds
}

TEST_CASE("what the leader shares arrives bit by bit", "[crew]") {
  CrewStart start;
  start.tiles = {{0, 0, 16, 16}, {16, 0, 20, 7}};
  start.restored = start.trained = true;
  start.changes = "roulette=efficiency";
  start.planned_samples = std::uint64_t{1} << 60;
  const double tiny = std::numeric_limits<double>::denorm_min();
  start.tables = {{"one", "meaning", {0.1, -0.0, tiny, INFINITY}}, {"none", "", {}}};
  const CrewStart there = CrewStartFromBytes(ToBytes(start));
  REQUIRE(there.tiles.size() == 2);
  CHECK(there.tiles[1].x1 == 20);
  CHECK(there.tiles[1].y1 == 7);
  CHECK((there.restored && there.trained));
  CHECK(there.changes == start.changes);
  CHECK(there.planned_samples == start.planned_samples);
  REQUIRE(there.tables.size() == 2);
  CHECK(there.tables[0].name == "one");
  CHECK(Fingerprint({}, there.tables) == Fingerprint({}, start.tables));
  start.tables[0].values[1] = 0.0;  // the sign is lost
  CHECK(Fingerprint({}, there.tables) != Fingerprint({}, start.tables));
  CHECK(CrewStartFromBytes(ToBytes({})).changes.empty());
  TrainingOutcome decided;
  decided.changes = "decide=none";
  CHECK(Fingerprint(decided, {}) != Fingerprint({}, {}));
}

}  // namespace
}  // namespace lanelight

// Guides of synthetic records, whose radiance is known.
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "src/prepare/guide_build.h"
#include "src/prepare/guide_cell.h"
#include "src/prepare/guide_space.h"
#include "src/prepare/guide_square.h"

namespace lanelight {
namespace {

using Radiance = std::function<double(Vec3d point, Vec3d direction)>;

std::uint16_t Fixed(double unit) {
  return static_cast<std::uint16_t>(std::min(unit * 65536, 65535.0));
}

// Rays from a floor of side `size`, by the cosine, as an unguided pass would record them.
std::vector<GuideRecord> FloorRecords(int n, double size, const Radiance& radiance,
                                      unsigned seed = 5) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform;
  std::vector<GuideRecord> records;
  for (int i = 0; i < n; ++i) {
    const double phi = 2 * std::numbers::pi * uniform(engine), u = uniform(engine);
    const double r = std::sqrt(u);
    const Vec3d d = {r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u)};
    const Vec3d p = {size * uniform(engine), size * uniform(engine), 0};
    GuideRecord record;
    record.from = VecCast<float>(p);
    record.normal = {0, 0, 1};
    const GuideSquarePoint at = ToGuideSquare({0, 0, 1}, d);
    record.u = Fixed(at.u), record.v = Fixed(at.v);
    record.radiance = static_cast<float>(radiance(p, d));
    records.push_back(record);
  }
  return records;
}

Vec3d Middle(std::size_t square) {
  return FromGuideSquare({0, 0, 1}, (double(square % kGuideGrid) + 0.5) / kGuideGrid,
                         (double(square / kGuideGrid) + 0.5) / kGuideGrid);
}

// Probability of a square of directions, of the cell at a point of the floor.
double Share(const Guide& guide, Vec3f point, std::size_t square) {
  const std::uint32_t cell = GuideCellAt(guide, point, {0, 0, 1});
  const auto u = static_cast<std::uint16_t>((square % kGuideGrid) << 12);
  const auto v = static_cast<std::uint16_t>((square / kGuideGrid) << 12);
  return double{GuideDensity(guide, cell, u, v)} * 4 / kGuideSquares;
}

// Half the sum of the differences to what is proportional to cosine times radiance, by
// the middle of each square: 0 = the same, 1 = nothing in common.
double Distance(const Guide& guide, Vec3f point, const Radiance& radiance) {
  std::vector<double> truth(kGuideSquares);
  double sum = 0, distance = 0;
  for (std::size_t s = 0; s < kGuideSquares; ++s) {
    const Vec3d d = Middle(s);
    truth[s] = CosineMasses()[s] * radiance(VecCast<double>(point), d);
    sum += truth[s];
  }
  for (std::size_t s = 0; s < kGuideSquares; ++s) {
    distance += std::abs(Share(guide, point, s) - truth[s] / sum) / 2;
  }
  return distance;
}

constexpr GuideSettings kLargeCells = {4000, 1000, 0.05, 24};

// A lamp of 15 degrees, high on the left for the right half of the floor, and the other
// way round.
double TwoLamps(Vec3d p, Vec3d d) {
  const Vec3d lamp = Normalize(Vec3d{p.x < 0.5 ? 1.0 : -1.0, 0, 1});
  return Dot(d, lamp) > std::cos(15 * std::numbers::pi / 180) ? 20 : 0.5;
}

}  // namespace

TEST_CASE("a guide has learned a known radiance", "[guide]") {
  std::vector<GuideRecord> records = FloorRecords(100'000, 1, TwoLamps);
  GuideSummary summary;
  const Guide guide = BuildGuide(records, kLargeCells, &summary);
  CHECK(summary.records == 100'000);
  CHECK(summary.cells == guide.cells());
  CHECK(summary.cells > 100'000 / 4000);
  // What is left: squares across the edge of a lamp, a twentieth that is spread evenly,
  // and the noise of a hundred records in the 17 squares of a lamp, about 0.15.
  for (const Vec3f p : {Vec3f{0.2f, 0.3f, 0}, Vec3f{0.8f, 0.7f, 0}}) {
    const Vec3f other = {1 - p.x, p.y, 0};
    CHECK(Distance(guide, p, TwoLamps) < 0.25);
    // It knows where it is.
    CHECK(Distance(guide, other, [&](Vec3d, Vec3d d) {
            return TwoLamps(VecCast<double>(p), d);
          }) > 0.6);
  }
}

TEST_CASE("a guide has learned radiance over twelve decades", "[guide]") {
  const Radiance decades = [](Vec3d p, Vec3d d) {
    return TwoLamps(p, d) * std::pow(10.0, 12 * p.y - 6);
  };
  std::vector<GuideRecord> records = FloorRecords(200'000, 1, decades);
  const Guide guide = BuildGuide(records, kLargeCells);
  for (const float y : {0.03f, 0.3f, 0.7f, 0.97f}) {
    // Within a cell brightness differs by two decades: fewer records count.
    CHECK(Distance(guide, {0.2f, y, 0}, TwoLamps) < 0.35);
    CHECK(Distance(guide, {0.8f, y, 0}, TwoLamps) < 0.35);
  }
}

TEST_CASE("a direction is learned by the four squares around it", "[guide]") {
  // A quarter of a square beyond the middle of column 5, an eighth beyond that of row 9.
  // (Both are exact in the 16 bits of a record.)
  std::vector<GuideRecord> records =
      FloorRecords(1000, 1, [](Vec3d, Vec3d) { return 1.0; });
  for (GuideRecord& r : records) {
    r.u = Fixed((5.5 + 0.25) / kGuideGrid), r.v = Fixed((9.5 + 0.125) / kGuideGrid);
  }
  const Guide guide = BuildGuide(records, {4000, 1000, 0.05, 1e-9});
  const double shares[2][2] = {{0.75 * 0.875, 0.25 * 0.875},
                               {0.75 * 0.125, 0.25 * 0.125}};
  for (std::size_t j = 0; j < 2; ++j) {
    for (std::size_t i = 0; i < 2; ++i) {
      const std::size_t square = (9 + j) * kGuideGrid + 5 + i;
      CHECK(Share(guide, {0.5f, 0.5f, 0}, square) ==
            Approx(0.95 * shares[j][i] + 0.05 * CosineMasses()[square]).epsilon(1e-3));
    }
  }
}

TEST_CASE("one bright record does not own its cell", "[guide]") {
  std::vector<GuideRecord> records =
      FloorRecords(300, 1, [](Vec3d, Vec3d) { return 1.0; });
  const std::size_t square = (records[7].v >> 12) * kGuideGrid + (records[7].u >> 12);
  for (const double bright : {1e6, 1e29}) {
    std::vector<GuideRecord> spoilt = records;
    spoilt[7].radiance = static_cast<float>(bright);
    const Guide guide = BuildGuide(spoilt, kLargeCells);
    REQUIRE(guide.cells() == 1);
    CHECK(Share(guide, {0.5f, 0.5f, 0}, square) < 1.5 / 16);
    CHECK(Share(guide, {0.5f, 0.5f, 0}, square) > 1.5 / kGuideSquares);
  }
}

TEST_CASE("where little is known a guide says little", "[guide]") {
  std::vector<GuideRecord> none;
  const Guide empty = BuildGuide(none, {});
  REQUIRE(empty.cells() == 1);
  CHECK(empty.nodes.size() == 1);
  CHECK(empty.fraction[0] == 0);
  // Black records are no light either.
  std::vector<GuideRecord> black =
      FloorRecords(5000, 1, [](Vec3d, Vec3d) { return 0.0; });
  const Guide dark = BuildGuide(black, {});
  for (const float fraction : dark.fraction) CHECK(fraction == 0);
  // A few records in a corner far off take over from their surroundings.
  std::vector<GuideRecord> records = FloorRecords(4000, 1, TwoLamps);
  const Guide guide = BuildGuide(records, {});
  for (std::size_t s = 0; s < kGuideSquares; ++s) {
    CHECK(Share(guide, {0.9f, 0.9f, 0}, s) > 0.04 / kGuideSquares);
  }
}

TEST_CASE("space is divided where the records are", "[guide]") {
  std::vector<GuideRecord> records = FloorRecords(20'000, 1, TwoLamps);
  // A plane that goes on to the horizon, and points that rounding has lost.
  for (std::size_t i = 0; i < records.size(); i += 50) {
    records[i].from = records[i].from * 1e6f;
  }
  records[3].from.x = 3e38f;
  const auto nodes = DivideGuideSpace(records, 300, 10'000);
  std::size_t largest = 0, leaves = 0, in_leaves = 0;
  for (const GuideSpaceNode& node : nodes) {
    CHECK(node.depth <= kGuideDepth);
    if (node.axis >= 0) continue;
    ++leaves, in_leaves += node.count();
    largest = std::max(largest, node.count());
  }
  CHECK(in_leaves == records.size());
  CHECK(largest <= 300);
  CHECK(leaves > 60);
  CHECK(DivideGuideSpace(records, 300, 16).size() == 31);
  // All in one place: there is nothing to divide by.
  for (GuideRecord& r : records) r.from = {1e9f, -1e9f, 0};
  CHECK(DivideGuideSpace(records, 300, 10'000).size() == 1);
}

TEST_CASE("walls of different orientation have cells of their own", "[guide]") {
  std::vector<GuideRecord> records = FloorRecords(3000, 1, TwoLamps);
  std::mt19937 engine(9);
  const Vec3f normals[] = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}};
  for (GuideRecord& r : records) r.normal = normals[engine() % 4];
  const auto nodes = DivideGuideSpace(records, 1200, 10'000);
  for (const GuideSpaceNode& node : nodes) {
    if (node.axis >= 0) {
      CHECK(node.axis >= 3);
      continue;
    }
    for (std::size_t i = node.begin; i < node.end; ++i) {
      CHECK(records[i].normal == records[node.begin].normal);
    }
  }
}

}  // namespace lanelight

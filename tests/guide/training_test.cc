// Training of a guide: nothing but scene, settings and seed decides what is learned, and
// what is kept comes back.
#include <catch2/catch.hpp>
#include <cstring>
#include <set>

#include "src/core/error.h"
#include "src/prepare/guide_cell.h"
#include "src/train/guide_tables.h"
#include "src/train/train_guide.h"
#include "src/train/trained_tables.h"
#include "tests/guide/prepared.h"

namespace lanelight {
namespace {

std::vector<std::uint32_t> Bits(const std::vector<TrainedTable>& tables) {
  std::vector<std::uint32_t> bits;
  for (const TrainedTable& table : tables) {
    for (double value : table.values) {
      bits.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(value)));
    }
  }
  return bits;
}

TrainedTable& Named(std::vector<TrainedTable>& tables, const std::string& name) {
  for (TrainedTable& table : tables) {
    if (table.name == name) return table;
  }
  FAIL("no table " << name);
  return tables[0];
}

// Puts tables back, into `tables`.
void PutBack(const std::vector<TrainedTable>& trained, const Prepared& room,
             StrategyTables& tables) {
  PutTraining(trained, std::uint64_t{room.run.width} * room.run.height, tables);
}

}  // namespace

TEST_CASE("what a guide learns depends on no thread and no wavefront", "[guide]") {
  std::vector<std::uint32_t> first;
  for (const int threads : {1, 2, 3}) {
    for (const std::uint32_t wavefront : {0u, 300u}) {
      const ThreadLimit limit(threads);
      Prepared room(test::SmallRoom(16, 5), "guiding=radiance", wavefront);
      const TrainingOutcome outcome = room.TrainWith(400'000);
      CHECK(outcome.samples > 15'000);
      CHECK(outcome.samples < 26'000);
      CHECK(outcome.note.find("guide of ") == 0);
      CHECK(room.tables.guide.cells() > 20);
      const auto bits = Bits(TakeGuide(room.tables.guide));
      if (first.empty()) first = bits;
      CHECK(bits == first);
    }
  }
  Prepared other(test::SmallRoom(16, 5), "guiding=radiance");
  other.run.seed = 12;
  other.TrainWith(400'000);
  CHECK(Bits(TakeGuide(other.tables.guide)) != first);
}

TEST_CASE("no samples of a guide's training are those of the image", "[guide]") {
  // The image has the seed itself, the roulettes' pilot the other one.
  std::set<std::uint32_t> seeds = {7u, 7u ^ 0x5bd1e995u};
  for (std::uint32_t pass = 1; pass <= 4096; ++pass) {
    CHECK(seeds.insert(GuidePassSeed(7, pass) ^ 0x5bd1e995u).second);
  }
  // And the passes do have them: the same pixels, other colours.
  const Prepared room(test::SmallRoom(16, 5), "guiding=none");
  const TrainingWork work = MakeTrainingWork(room.scene, 1024);
  const auto colors = [&](std::uint32_t seed) {
    return RunTrainingPass({room.scene, room.plan.options, &room.tables, seed}, work)
        .colors;
  };
  CHECK(colors(GuidePassSeed(7, 1)) == colors(GuidePassSeed(7, 1)));
  CHECK(colors(GuidePassSeed(7, 1)) != colors(7));
}

TEST_CASE("a guide that cannot be learned guides nothing", "[guide]") {
  Prepared small(test::SmallRoom(16, 5), "guiding=radiance");
  const TrainingOutcome none = small.TrainWith(1000);
  CHECK(none.note.find("no guide") == 0);
  CHECK(none.samples == 0);
  CHECK(small.tables.guide.fraction == UnknowingGuide().fraction);

  // No light; and a point light alone, which no ray finds, at depth 1.
  test::SceneBuilder dark(8, 8);
  dark.AddSphere({0, 0, 0}, 1, dark.AddDiffuse(test::Grey(0.5)));
  SceneDescription point = test::PointOverPlane(Scattering::kLambertian, 8);
  point.integrator.max_depth = 1;
  for (const SceneDescription& scene : {dark.Build(), point}) {
    Prepared black(scene, "guiding=radiance");
    black.TrainWith(200'000);
    for (const float fraction : black.tables.guide.fraction) CHECK(fraction == 0);
  }
}

TEST_CASE("a guide is kept and comes back with the same bits", "[guide]") {
  Prepared room(test::SmallRoom(16, 5), "guiding=radiance");
  room.TrainWith(400'000);
  const Guide& guide = room.tables.guide;
  StrategyTables back = MakeStrategyTables(room.scene);
  PutBack(TakeTraining(room.tables), room, back);
  const auto same = [](const auto& a, const auto& b) {
    return a.size() == b.size() &&
           std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
  };
  CHECK(same(back.guide.nodes, guide.nodes));
  CHECK(same(back.guide.cumulative, guide.cumulative));
  CHECK(same(back.guide.density, guide.density));
  CHECK(same(back.guide.fraction, guide.fraction));
}

TEST_CASE("kernels get no broken guide", "[guide]") {
  Prepared room(test::SmallRoom(16, 5), "guiding=radiance");
  room.TrainWith(200'000);
  const std::vector<TrainedTable> good = TakeTraining(room.tables);
  struct Fault {
    const char* table;
    std::size_t at;
    double value;
  };
  const double cells = double(room.tables.guide.cells());
  const Fault faults[] = {{"guide_next", 0, 0},                 // its own child
                          {"guide_next", 0, 6 + 8},             // axis 6
                          {"guide_next", 0, 1e6 * 8},           // no such children
                          {"guide_next", 0, 7 + 8 * cells},     // no such cell
                          {"guide_next", 0, 0.5},               //
                          {"guide_next", 0, -1},                //
                          {"guide_at", 0, NAN},                 //
                          {"guide_cumulative", 4, 2},           //
                          {"guide_cumulative", 4, -1},          //
                          {"guide_cumulative", 15, 0.9999999},  // does not end at 1
                          {"guide_cumulative", 31, 0.9999999},
                          {"guide_fraction", 0, 1},  //
                          {"guide_fraction", 0, NAN}};
  for (const Fault& fault : faults) {
    INFO(fault.table << "[" << fault.at << "] = " << fault.value);
    std::vector<TrainedTable> bad = good;
    Named(bad, fault.table).values[fault.at] = fault.value;
    StrategyTables tables = MakeStrategyTables(room.scene);
    CHECK_THROWS_AS(PutBack(bad, room, tables), InputError);
  }
  for (const char* table :
       {"guide_at", "guide_next", "guide_cumulative", "guide_fraction"}) {
    std::vector<TrainedTable> bad = good;
    Named(bad, table).values.pop_back();
    StrategyTables tables = MakeStrategyTables(room.scene);
    CHECK_THROWS_AS(PutBack(bad, room, tables), InputError);
    Named(bad, table).name = "gone";
    CHECK_THROWS_AS(PutBack(bad, room, tables), InputError);
  }
}

}  // namespace lanelight

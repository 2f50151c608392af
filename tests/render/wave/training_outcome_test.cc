// Several trainings of one strategy are combined.
#include <catch2/catch.hpp>

#include "src/render/wave/run_state.h"

namespace lanelight {

TEST_CASE("outcomes of all trainings are added up", "[training]") {
  TrainingOutcome all;
  TrainingOutcome values, roulette, nothing;
  values.note = "7 cells";
  values.samples = 10, values.rays = 100;
  roulette.changes = "roulette=throughput";
  roulette.note = "too few samples";
  roulette.samples = 1, roulette.rays = 2;
  TrainingOutcome blocks;
  blocks.changes = "reuse=none";
  for (const TrainingOutcome* one : {&values, &roulette, &nothing, &blocks}) {
    all.Add(*one);
  }
  CHECK(all.changes == "roulette=throughput,reuse=none");
  CHECK(all.note == "7 cells; too few samples");
  CHECK(all.samples == 11);
  CHECK(all.rays == 102);
}

}  // namespace lanelight

// Ranks render the bits of a single process, whatever they are told on the way. Here they
// are threads; with MPI, and what happens when one fails:
// tests/render/ranks/ranks_test.py.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "src/render/ranks/rank_messages.h"
#include "tests/render/ranks/thread_group.h"
#include "tests/render/run/resume_fixture.h"

namespace lanelight {
namespace {

using resume::InterruptingCheckpointer;
using resume::Request;
using resume::Rest;
using resume::Same;

// As the leader has it.
Rendered RenderOnRanks(int ranks, const Request& request) {
  std::optional<Rendered> out;
  OnRanks(ranks, [&](RankGroup& group) {
    Request own = request;
    own.group = &group;
    if (!group.is_leader()) own.checkpointer = nullptr;
    Rendered rendered = resume::Render(own);
    if (group.is_leader()) out.emplace(std::move(rendered));
  });
  return std::move(*out);
}

TEST_CASE("ranks render an image bit-identical to a single process", "[ranks]") {
  for (const char* strategy :
       {"points=sobol", "points=independent,pairs=antithetic",
        "points=sobol,control=regression", "points=halton,roulette=adjoint",
        "points=sobol,light-selection=learned", "points=sobol,decide=pilot",
        "points=sobol,reuse=block:16"}) {
    Request request;
    request.strategy = strategy;
    request.spp = 45;
    const Rendered alone = resume::Render(request);
    for (int ranks : {2, 3, 5}) {
      INFO(strategy << ", " << ranks << " ranks");
      const Rendered together = RenderOnRanks(ranks, request);
      CHECK(Identical(together.film, alone.film));
      CHECK(Same(together.result, alone.result));
      CHECK(together.result.ranks == ranks);
    }
  }
}

TEST_CASE("ranks reach a target at the same sample count as a single process",
          "[ranks]") {
  Request request;
  request.strategy = "points=sobol";
  request.target = 0.002;
  const Rendered alone = resume::Render(request);
  const Rendered together = RenderOnRanks(3, request);
  CHECK(together.result.stop_reason == StopReason::kTarget);
  CHECK(Identical(together.film, alone.film));
  CHECK(Same(together.result, alone.result));
}

TEST_CASE("checkpoints can be resumed by any number of ranks", "[ranks]") {
  for (const char* strategy :
       {"points=independent,pairs=antithetic", "points=sobol,roulette=adjoint"}) {
    Request request;
    request.strategy = strategy;
    request.spp = 400;
    const Rendered alone = resume::Render(request);
    Rest rest;
    int pauses = 0;
    for (int ranks : {3, 1, 2, 4}) {
      InterruptingCheckpointer interrupter(rest, 5 * ranks, /*stops=*/ranks != 4);
      request.checkpointer = &interrupter;
      request.stop = &interrupter.stop();
      const Rendered part = RenderOnRanks(ranks, request);
      pauses += part.result.stop_reason == StopReason::kInterrupted;
      if (ranks < 4) continue;
      CHECK(interrupter.kept() > 1);
      CHECK(Identical(part.film, alone.film));
      CHECK(Same(part.result, alone.result));
      CHECK(rest.counts.samples == 400 * resume::kWidth * resume::kHeight);
    }
    INFO(strategy);
    CHECK(pauses == 3);
  }
}

// The traffic to the leader does not grow with the number of ranks. A tile that is
// transferred on the way brings its part of the film once more. Whether any is
// transferred depends on time: one render of a few has none.
TEST_CASE("the film is gathered only once if nothing needs it earlier", "[ranks]") {
  Request request;
  request.strategy = "points=sobol";
  request.spp = 64;
  for (int ranks : {2, 4, 7}) {
    double minimum = 1e9;
    for (int i = 0; i < 8 && minimum >= 1.05; ++i) {
      Rendered rendered = RenderOnRanks(ranks, request);
      std::size_t whole = 0;
      for (const auto& column : rendered.film.Columns()) whole += column.Bytes();
      minimum =
          std::min(minimum, double(rendered.result.bytes_between_ranks) / double(whole));
    }
    INFO(ranks << " ranks");
    CHECK(minimum < 1.05);
  }
}

TEST_CASE("messages to worker ranks arrive bit-identical", "[ranks]") {
  RunStart start;
  start.tiles = {{0, 0, 16, 16}, {16, 0, 20, 7}};
  start.have_samples = true;
  start.planned_training = std::uint64_t{1} << 63;
  const RunStart there = RunStartFromBytes(ToBytes(start));
  REQUIRE(there.tiles.size() == 2);
  CHECK(there.tiles[1].x1 == 20);
  CHECK(there.tiles[1].y1 == 7);
  CHECK(there.have_samples);
  CHECK(there.planned_training == start.planned_training);
}

TEST_CASE("trained tables of ranks arrive bit-identical", "[ranks]") {
  const double tiny = std::numeric_limits<double>::denorm_min();
  const RunTraining training = {
      true,
      "roulette=adjoint",
      {{"one", "meaning", {0.1, -0.0, tiny, INFINITY}}, {"none", "", {}}}};
  const RunTraining there = RunTrainingFromBytes(ToBytes(training));
  CHECK(there.trained);
  CHECK(there.changes == training.changes);
  REQUIRE(there.tables.size() == 2);
  CHECK(there.tables[0].name == "one");
  REQUIRE(there.tables[0].values == training.tables[0].values);
  CHECK(std::signbit(there.tables[0].values[1]));
  CHECK(there.tables[1].values.empty());
  CHECK(RunTrainingFromBytes(ToBytes(RunTraining{})).changes.empty());
}

}  // namespace
}  // namespace lanelight

// The most efficient strategies of a sweep, in sweep.json and in the last lines.
#include <catch2/catch.hpp>
#include <functional>

#include "src/measure/sweep/results.h"
#include "tests/base/image/temporary_folder.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;

// Two strategies, with amounts and seeds by the last lines of the grid.
Sweep SmallSweep(const std::string& lines) {
  const TemporaryFolder folder;
  folder.Write("a.pbrt", "");
  return ParseSweep(folder.File("s.toml"), R"([grid]
scene = "a.pbrt"
strategy = ["points=stratified", "points=halton"]
)" + lines);
}

void SetCost(Json& cell, double error, double seconds) {
  cell["measured"]["relmse"] = error;
  cell["measured"]["cpu_seconds"] = seconds;
}

// Makes it a cell that a race does not need.
Json& Stop(Json& cell) {
  cell["status"] = Name(CellState::kStopped);
  cell["measured"] = Json::object();
  return cell;
}

// Returns sweep.json of finished cells, whose costs `finish` sets by index.
Json SweepJsonOf(const Sweep& sweep,
                 const std::function<void(Json&, std::size_t)>& finish) {
  std::vector<Json> cells;
  for (const SweepCell& cell : sweep.cells) {
    cells.push_back(CellJson(cell, {}));
    cells.back()["status"] = Name(CellState::kDone);
    finish(cells.back(), cell.index);
  }
  return SweepJson(sweep, cells, GroupCells(sweep, cells));
}

}  // namespace

TEST_CASE("sweep: one seed has no interval", "[sweep][report]") {
  const Sweep sweep = SmallSweep("spp = 16");
  const Json json =
      SweepJsonOf(sweep, [](Json& cell, std::size_t) { SetCost(cell, 1, 1); });
  CHECK(json["baseline"] == "points=stratified");
  REQUIRE(json["groups"].size() == 2);
  CHECK_FALSE(json["groups"][1].contains("measured"));
  CHECK(json["groups"][1]["efficiency"]["value"].is_number());
  CHECK(json["groups"][1]["efficiency"]["low"].is_null());
  CHECK(json["leaders"][0]["equals"] == 1);
  CHECK_THAT(AnswerText(json["leaders"]), Catch::Contains("one seed does not rank"));
}

TEST_CASE("sweep: cells that render for a time compare by error times processor time",
          "[sweep][report]") {
  // Other programs took a part of the time, another one in each cell.
  const double got[] = {0.3, 2, 1, 0.1, 1.9, 0.2, 0.4, 1.5};
  const Sweep sweep = SmallSweep("time = 2\nseed = [1, 2, 3, 4]");
  const Json json = SweepJsonOf(sweep, [&](Json& cell, std::size_t i) {
    SetCost(cell, (i < 4 ? 3 : 1) / got[i], got[i]);
  });
  CHECK(json["groups"][1]["efficiency"]["value"].get<double>() == Approx(3));
  CHECK(json["leaders"][0]["efficiency"]["low"].get<double>() == Approx(3));
  CHECK_THAT(AnswerText(json["leaders"]),
             Catch::Contains("time 2 s: points=halton has 3 [3, 3] times"));
}

TEST_CASE("sweep: a race that the baseline wins names the runner-up", "[sweep][report]") {
  const Sweep sweep = SmallSweep("spp = 16\nseed = [1, 2, 3, 4, 5]");
  const Json json = SweepJsonOf(sweep, [](Json& cell, std::size_t i) {
    SetCost(cell, i < 5 ? 1 : 2, 1);
    if (i >= 8) Stop(cell)["lost"] = true;
  });
  CHECK_THAT(
      AnswerText(json["leaders"]),
      Catch::Contains("points=stratified, the baseline, is the most efficient; the next, "
                      "points=halton, has 0.5 [0.5, 0.5] times its efficiency; 1 "
                      "stopped early (5 seeds)"));
}

TEST_CASE(
    "sweep: strategies that may be the best are named, with what they may cost more",
    "[sweep][report]") {
  const double scatter[] = {0.95, 1.1, 1, 1.05, 0.9};
  const Sweep sweep = SmallSweep("spp = 16\nseed = [1, 2, 3, 4, 5]");
  const Json full = SweepJsonOf(sweep, [&](Json& cell, std::size_t i) {
    SetCost(cell, i < 5 ? scatter[i] : 0.99 * scatter[9 - i], 1);
  });
  const Json& leader = full["leaders"][0];
  CHECK(leader["undecided"] == Json({"points=halton", "points=stratified"}));
  CHECK(leader["within"] ==
        Approx(leader["efficiency"]["high"].get<double>() - 1).epsilon(1e-6));
  CHECK_THAT(AnswerText(full["leaders"]),
             Catch::Contains(
                 "not decided between points=halton and points=stratified (within ") &&
                 Catch::Contains(" %) (5 seeds)"));

  // Two seeds are enough for a race that ends undecided, and its own limit is printed.
  const Json race = SweepJsonOf(sweep, [&](Json& cell, std::size_t i) {
    SetCost(cell, scatter[i % 5], 1);
    if (i % 5 >= 2) Stop(cell)["within"] = 0.213;
  });
  CHECK(
      AnswerText(race["leaders"]) ==
      "a, spp 16: not decided between points=stratified and points=halton (within 21 %) "
      "(2 seeds)\n");
}

}  // namespace lanelight

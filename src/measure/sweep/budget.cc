#include "src/measure/sweep/budget.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "src/base/core/input_file.h"
#include "src/base/core/json_text.h"
#include "src/base/core/text_layout.h"
#include "src/base/image/atomic_file.h"
#include "src/measure/sweep/cell_render.h"
#include "src/render/job/loaded_scene.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr double kMinCellSeconds = 0.05;
// Share of the budget for images and reports.
constexpr double kFiles = 0.015;

void CheckAmounts(const Sweep& sweep) {
  for (const SweepCell& cell : sweep.cells) {
    for (const Axis axis :
         {Axis::kSpp, Axis::kTime, Axis::kTargetRelmse, Axis::kTargetRmse}) {
      if (!Get(cell.values, axis)) continue;
      throw InputError(
          "{}: --budget decides how long cells render: remove {} from the grid",
          sweep.path, Name(axis));
    }
  }
}

double LoadSeconds(const Sweep& sweep) {
  CellRenderer renderer(sweep);
  std::set<std::string> seen;
  double seconds = 0;
  for (const SweepCell& cell : sweep.cells) {
    if (!CellRenderer::HasTarget(cell) || !seen.insert(renderer.SceneKey(cell)).second) {
      continue;
    }
    try {
      const Job job = renderer.Prepare(cell);
      seconds += job.loaded->load_seconds + job.loaded->build_seconds;
    } catch (const std::exception&) {  // the sweep reports it
    }
  }
  return seconds;
}

// Returns the time of all cells of a part and of their files.
double SecondsOf(const BudgetPlan& plan) {
  return (double(plan.cells) * plan.cell_seconds + plan.load_seconds) / (1 - kFiles);
}

Json PlanJson(const BudgetPlan& plan, double seconds) {
  return {{"budget_seconds", seconds},
          {"cells", plan.cells},
          {"cell_seconds", plan.cell_seconds},
          {"load_seconds", plan.load_seconds}};
}

BudgetPlan NewPlan(const Sweep& sweep, double seconds, std::size_t cells) {
  BudgetPlan plan = {cells, 0, LoadSeconds(sweep)};
  plan.cell_seconds = (seconds * (1 - kFiles) - plan.load_seconds) / double(cells);
  if (plan.cell_seconds >= kMinCellSeconds) return plan;
  throw InputError(
      "a budget of {} is too short for {} cells: each takes at least {} s, and loading "
      "the scenes {}",
      DurationText(seconds), cells, kMinCellSeconds, DurationText(plan.load_seconds));
}

// Returns the plan of the file for another number of cells, which keep their time.
BudgetPlan OldPlan(const std::string& path, double seconds, std::size_t cells) {
  return FromJsonOf(path, [&] {
    const Json json = ParseJson(ReadWholeFile(path));
    const BudgetPlan plan = {cells, json.at("cell_seconds"), json.at("load_seconds")};
    if (json.at("budget_seconds") == seconds && json.at("cells") == cells) return plan;
    const double needed = SecondsOf(plan);
    if (needed <= seconds) return plan;
    throw InputError(
        "'{}' plans {} for each cell, so that {} cells take {}, more than {}; give "
        "--budget {:.0f} to keep the finished cells, or use another --out",
        path, DurationText(plan.cell_seconds), cells, DurationText(needed),
        DurationText(seconds), std::ceil(needed));
  });
}

}  // namespace

BudgetPlan PlanBudget(Sweep& sweep, double seconds, const Part& part,
                      const std::string& out) {
  CheckAmounts(sweep);
  const auto parts = std::size_t(part.count);
  const std::size_t cells = (sweep.cells.size() + parts - 1) / parts;
  const std::string path = out + "/budget.json";
  BudgetPlan plan;
  if (fs::exists(path)) {
    plan = OldPlan(path, seconds, cells);
    WriteFileAtomically(path, DumpJson(PlanJson(plan, seconds), 1) + "\n");
  } else {
    plan = NewPlan(sweep, seconds, cells);
    std::error_code error;
    fs::create_directories(out, error);
    if (error) throw InputError("cannot make '{}': {}", out, error.message());
    WriteFileAtomically(path, DumpJson(PlanJson(plan, seconds), 1) + "\n");
  }
  const std::string time =
      CanonicalValue("time", fmt::format("{:.6g}", plan.cell_seconds), {});
  for (SweepCell& cell : sweep.cells) {
    cell.values[std::size_t(Axis::kTime)] = time;
    cell.name = CellName(cell.values);
  }
  return plan;
}

std::string BudgetText(const BudgetPlan& plan, double seconds) {
  std::string text = fmt::format(
      "budget {}: {} cells of {} each, and {} to load the scenes", DurationText(seconds),
      plan.cells, DurationText(plan.cell_seconds), DurationText(plan.load_seconds));
  const double rest = (seconds - SecondsOf(plan)) * (1 - kFiles);
  if (rest < plan.cell_seconds) return text;
  return text + fmt::format(
                    "; budget.json keeps their time, so {} are left: add seeds "
                    "or strategies, {:.0f} cells",
                    DurationText(rest), std::floor(rest / plan.cell_seconds));
}

}  // namespace lanelight

#include "src/measure/sweep/budget.h"

#include <fmt/format.h>

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

BudgetPlan OldPlan(const std::string& path, double seconds, std::size_t cells) {
  return FromJsonOf(path, [&] {
    const Json json = ParseJson(ReadWholeFile(path));
    const BudgetPlan plan = {json.at("cells"), json.at("cell_seconds"),
                             json.at("load_seconds")};
    if (json.at("budget_seconds") == seconds && plan.cells == cells) return plan;
    throw InputError(
        "'{}' plans {} for {} cells, not {} for {}: use another --out, or remove it",
        path, DurationText(json.at("budget_seconds")), plan.cells, DurationText(seconds),
        cells);
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
  return fmt::format("budget {}: {} cells of {} each, and {} to load the scenes",
                     DurationText(seconds), plan.cells, DurationText(plan.cell_seconds),
                     DurationText(plan.load_seconds));
}

}  // namespace lanelight

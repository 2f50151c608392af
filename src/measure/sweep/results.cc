#include "src/measure/sweep/results.h"

#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "src/base/core/json_text.h"
#include "src/base/core/parallel.h"
#include "src/base/core/version.h"
#include "src/base/image/atomic_file.h"
#include "src/base/stat/values.h"
#include "src/measure/report/page.h"
#include "src/measure/sweep/convergence.h"
#include "src/measure/sweep/race.h"
#include "src/render/job/machine_json.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;

// Columns of the table after the axes, with their places in report.json.
struct Measure {
  const char *name, *place;
  bool on_page = false;
};
constexpr Measure kColumns[] = {
    {"samples", "/samples", true},
    {"render_seconds", "/seconds/render", true},
    {"cpu_seconds", "/sweep/cpu_seconds", true},
    {"load_seconds", "/seconds/load"},
    {"build_seconds", "/seconds/build"},
    {"pilot_seconds", "/seconds/pilot"},
    {"write_seconds", "/seconds/write"},
    {"samples_per_second", "/samples_per_second", true},
    {"rays", "/rays/total"},
    {"rays_per_second", "/rays_per_second", true},
    {"relmse", "/error/relmse/value", true},
    {"relmse_low", "/error/relmse/low", true},
    {"relmse_high", "/error/relmse/high", true},
    {"rmse", "/error/rmse/value", true},
    {"rmse_low", "/error/rmse/low", true},
    {"rmse_high", "/error/rmse/high", true},
    {"stop_reason", "/stop_reason"},
    {"wavefront_bytes", "/wavefront_bytes"},
    {"used_threads", "/settings/threads", true},
    {"used_simd_target", "/target/name"},
    {"used_strategy", "/settings/strategy"},
    {"width_pixels", "/settings/resolution/0", true},
    {"height_pixels", "/settings/resolution/1", true},
    {"used_max_depth", "/settings/max_depth"},
    {"used_seed", "/settings/seed"},
    {"scene_hash", "/scene_hash"},
    {"machine", "/sweep/machine", true},
    {"program", "/sweep/program", true},
};

constexpr const char* kInvalidSamples = "invalid_samples";

std::string MachineName() {
  char name[256] = "";
  gethostname(name, sizeof(name) - 1);
  return name;
}

Json InvalidSamples(const Json& report) {
  std::uint64_t invalid = 0;
  for (const auto& [kind, count] : report.at("health").items()) {
    invalid += count.get<std::uint64_t>();
  }
  return invalid;
}

std::string Header(const std::vector<std::string>& stages) {
  std::string text = "cell,status";
  for (const Axis axis : kAllAxes) text += std::string(",") + Column(axis);
  for (const Measure& column : kColumns) text += std::string(",") + column.name;
  text += ",invalid_samples," + MachineCsvHeader();
  for (const std::string& stage : stages) text += ",stage_" + stage + "_cpu_seconds";
  return text + ",message\n";
}

std::string Row(const Json& cell, const std::vector<std::string>& stages) {
  std::string text = CsvField(cell.at("name")) + "," + CsvField(cell.at("status"));
  for (const Axis axis : kAllAxes) {
    text += "," + CsvField(cell.at("values").value(Key(axis), Json()));
  }
  for (const Measure& column : kColumns) {
    text += "," + CsvField(cell.at("measured").value(column.name, Json()));
  }
  text += "," + CsvField(cell.at("measured").value(kInvalidSamples, Json())) + "," +
          MachineCsvRow(MachineFromJson(cell.at("machine")));
  for (const std::string& stage : stages) {
    text += "," + CsvField(cell.at("stages").value(stage, Json()));
  }
  return text + "," + CsvField(cell.at("message")) + "\n";
}

}  // namespace

std::vector<std::string> StageNames(const std::vector<Json>& cells) {
  std::set<std::string> names;
  for (const Json& cell : cells) {
    for (const auto& [name, seconds] : cell.at("stages").items()) names.insert(name);
  }
  return {names.begin(), names.end()};
}

bool IsOnPage(const std::string& measure) {
  return measure == kInvalidSamples ||
         std::ranges::any_of(
             kColumns, [&](const Measure& m) { return m.on_page && m.name == measure; });
}

Json CellReport(const Rendering& rendering) {
  Json report = rendering.json;
  report["sweep"] = {{"cpu_seconds", rendering.report.result.cpu_seconds},
                     {"machine", MachineName()},
                     {"program", FullVersion()}};
  return report;
}

Json CellJson(const SweepCell& cell, const CellRecord& record) {
  Json json = {{"name", cell.name},
               {"status", Name(record.state)},
               {"message", record.message.empty() ? Json() : Json(record.message)},
               {"values", ByKey(cell.values)},
               {"measured", Json::object()},
               {"machine", Json()},
               {"stages", Json::object()}};
  if (record.state != CellState::kDone) return json;
  for (const Measure& column : kColumns) {
    const Json::json_pointer place(column.place);
    if (record.report.contains(place)) {
      json["measured"][column.name] = record.report.at(place);
    }
  }
  json["measured"][kInvalidSamples] = InvalidSamples(record.report);
  json["machine"] = record.report.value("machine", Json());  // null in older files
  for (const Json& stage : record.report.at("stages")) {
    json["stages"][stage.at("name").get<std::string>()] = stage.at("seconds");
  }
  return json;
}

std::string SweepCsv(const std::vector<Json>& cells) {
  const std::vector<std::string> stages = StageNames(cells);
  std::string text = Header(stages);
  for (const Json& cell : cells) text += Row(cell, stages);
  return text;
}

void ReadMissing(const Sweep& sweep, SweepFolder& folder, CellResults& results) {
  results.resize(sweep.cells.size());
  ParallelFor(results.size(), [&](std::size_t i) {
    if (!results[i].json.is_null()) return;
    const SweepCell& cell = sweep.cells[i];
    const CellRecord record = folder.ReadCell(cell);
    const bool done = record.state == CellState::kDone;
    results[i] = FromJsonOf(folder.File(cell, "report.json"), [&] {
      return CellResult{CellJson(cell, record),
                        done && record.report.value("differs", false)};
    });
  });
}

void WriteResults(const Sweep& sweep, SweepFolder& folder, bool race, CellResults results,
                  SweepOutcome& outcome) {
  ReadMissing(sweep, folder, results);
  std::vector<Json> cells;
  for (CellResult& result : results) {
    const Json& json = cells.emplace_back(std::move(result.json));
    if (json.at("status") == Name(CellState::kFailed)) {
      const Json& message = json.at("message");
      outcome.failures.push_back({json.at("name"), message.is_null() ? "" : message});
    }
    if (json.at("status") != Name(CellState::kDone)) continue;
    ++outcome.done;
    outcome.cpu_seconds += json.at("measured").value("cpu_seconds", 0.0);
    outcome.invalid_samples +=
        json.at("measured").at(kInvalidSamples).get<std::uint64_t>();
    outcome.differing += result.differs;
  }
  if (race) outcome.stopped = MarkStopped(sweep, cells);
  outcome.total = sweep.cells.size();
  outcome.other_cells = folder.OtherCells();
  WriteFileAtomically(folder.File("sweep.csv"), SweepCsv(cells));
  const std::vector<CellGroup> groups = GroupCells(sweep, cells);
  Json json = SweepJson(sweep, cells, groups);
  json["convergence"] = ConvergenceJson(sweep, folder, groups);
  outcome.answer =
      AnswerText(json.at("leaders")) + ConvergenceText(json.at("convergence"));
  WriteFileAtomically(folder.File("sweep.json"), DumpJson(json, 1) + "\n");
  WriteFileAtomically(folder.File("report.html"),
                      ReportPage(PageKind::kSweep, PageJson(std::move(json)),
                                 Thumbnails(sweep, folder, groups)));
}

}  // namespace lanelight

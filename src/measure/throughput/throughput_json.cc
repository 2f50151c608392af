#include "src/measure/throughput/throughput_comparison.h"

#include <fmt/chrono.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <tuple>

#include "src/base/core/error.h"
#include "src/base/core/input_file.h"
#include "src/base/core/json_text.h"
#include "src/base/core/version.h"
#include "src/base/stat/values.h"
#include "src/render/job/machine_json.h"
#include "src/vocabulary/strategy/strategy.h"
#include "src/vocabulary/strategy/strategy_text.h"

namespace lanelight {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Interval, value, low, high)

namespace {

using Json = nlohmann::json;

// Returns rate / (threads * rate of one thread); null without a row of one thread.
Json ParallelEfficiency(const std::vector<ThroughputRow>& rows,
                        const ThroughputRow& row) {
  if (row.threads == 1) return IntervalJson(WithoutBounds(1));  // nothing is estimated
  const ThroughputRow* one = OneThreadRow(rows, row);
  if (one == nullptr) return nullptr;
  const Interval ratio = RateRatioOf(row.Rate(), one->Rate());
  const double n = row.threads;
  return IntervalJson(Interval{ratio.value / n, ratio.low / n, ratio.high / n});
}

Json ToJson(const ThroughputRow& row, const std::vector<ThroughputRow>& rows) {
  Json groups = Json::array(), stages = Json::array();
  for (const StageGroup& g : StageGroups(row)) {
    groups.push_back(
        {{"name", g.name}, {"ns_per_sample", g.ns_per_sample}, {"lanes", g.Lanes()}});
  }
  for (const StageProfile& s : row.counts.stages) {
    stages.push_back({{"name", s.name},
                      {"items", s.items},
                      {"lanes", s.Occupancy()},
                      {"ns_per_sample", 1e9 * s.seconds / double(row.counts.samples)}});
  }
  return {{"scene", row.scene},
          {"scene_hash", fmt::format("{:016x}", row.scene_hash)},
          {"target", row.target},
          {"strategy", row.strategy},
          {"threads", row.threads},
          {"resolution", {row.width, row.height}},
          {"spp", row.spp},
          {"seconds", row.seconds},
          {"cpu_seconds", row.cpu_seconds},
          {"waiting", row.WaitingFraction()},
          {"samples", row.counts.samples},
          {"rays",
           {{"closest", row.counts.rays_closest}, {"shadow", row.counts.rays_shadow}}},
          {"samples_per_second", IntervalJson(row.Rate())},
          {"samples_per_cpu_second", IntervalJson(row.CpuRate())},
          {"parallel_efficiency", ParallelEfficiency(rows, row)},
          {"rays_per_second", double(row.rays()) / row.Seconds().value},
          {"bytes_per_path", row.bytes_per_path},
          {"wavefront", row.wavefront},
          {"groups", groups},
          {"stages", stages}};
}

}  // namespace

Json ToJson(const std::vector<ThroughputRow>& rows, double within) {
  Json out = {{"schema", kBenchSchema},
              {"machine", ToJson(ThisMachine())},
              {"program", FullVersion()},
              {"date", fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)))},
              {"confidence", kBenchConfidence},
              {"busy", BusyReasons(rows, ThisMachine())},
              {"warnings", ThroughputWarnings(rows, within)},
              {"rows", Json::array()}};
  for (const ThroughputRow& row : rows) out["rows"].push_back(ToJson(row, rows));
  return out;
}

std::string KnownRow::Key() const {
  const std::string changes = ChoicesNotIn(ToText(Strategy{}), strategy);
  return fmt::format("{}, {}, {} thread{}, {}x{}, {} spp{}{}", scene, target, threads,
                     threads == 1 ? "" : "s", width, height, spp,
                     changes.empty() ? "" : ", ", changes);
}

bool KnownRow::SameWork(const KnownRow& o) const {
  const std::string usual = ToText(Strategy{});
  return std::tie(scene_hash, width, height, spp) ==
             std::tie(o.scene_hash, o.width, o.height, o.spp) &&
         ChoicesNotIn(usual, strategy) == ChoicesNotIn(usual, o.strategy);
}

KnownThroughput ThroughputFromJson(const Json& json) {
  KnownThroughput known;
  known.machine = json.at("machine").at("text");
  known.program = json.at("program");
  known.busy = json.at("busy");
  known.date = json.at("date");
  for (const Json& row : json.at("rows")) {
    known.rows.push_back({row.at("scene"), row.at("target"), row.at("strategy"),
                          row.at("threads"), row.at("resolution").at(0),
                          row.at("resolution").at(1), row.at("spp"),
                          row.at("samples_per_second"), row.at("samples_per_cpu_second"),
                          row.at("scene_hash"), ""});
  }
  for (KnownRow& row : known.rows) row.label = SceneLabel(row.scene, known.rows);
  return known;
}

KnownThroughput ReadThroughput(const std::string& path) {
  KnownThroughput known = FromJsonOf(path, [&] {
    const Json json = ParseJson(ReadWholeFile(path));
    if (!json.contains("rows") || !json.contains("date")) {
      throw InputError("'{}' was not written by `lanelight bench --json`", path);
    }
    return ThroughputFromJson(json);
  });
  known.name = std::filesystem::path(path).stem();
  return known;
}

std::vector<KnownThroughput> ListedResults(const std::string& place) {
  std::vector<KnownThroughput> results;
  const bool is_file = std::filesystem::is_regular_file(place);
  if (is_file) results.push_back(ReadThroughput(place));
  if (is_file || place.empty()) {
    for (const StoredResult& stored : StoredResults()) {
      results.push_back(ThroughputFromJson(ParseJson(stored.text)));
      results.back().name = stored.name;
    }
  }
  std::error_code error;  // a missing folder has no results
  for (const auto& entry : std::filesystem::directory_iterator(place, error)) {
    if (entry.path().extension() != ".json") continue;
    results.push_back(ReadThroughput(entry.path()));
  }
  if (results.empty()) throw InputError("no bench result (.json) in '{}'", place);
  std::ranges::sort(results, [](const KnownThroughput& a, const KnownThroughput& b) {
    return std::tie(b.date, a.name) < std::tie(a.date, b.name);  // newest first
  });
  return results;
}

}  // namespace lanelight

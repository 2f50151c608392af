// The report of `lanelight profile --json`.
#include <nlohmann/json.hpp>

#include "src/base/core/hardware_counters.h"
#include "src/base/core/parallel.h"
#include "src/base/core/version.h"
#include "src/base/stat/values.h"
#include "src/render/job/loaded_scene.h"
#include "src/render/job/machine_json.h"
#include "src/render/job/profile_report.h"
#include "src/render/job/report.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;

Json CountersJson(const ProfileRow& row) {
  if (row.counts.counted_items == 0) return nullptr;
  return {{"items", row.counts.counted_items},
          {"cycles_per_item", row.PerItem(Counter::kCycles)},
          {"instructions_per_item", row.PerItem(Counter::kInstructions)},
          {"instructions_per_cycle", row.InstructionsPerCycle()},
          {"l1_misses_per_item", row.PerItem(Counter::kL1Misses)},
          {"llc_misses_per_item", row.PerItem(Counter::kLlcMisses)}};
}

// The median, and its repeats.
void AddTimes(const std::vector<double>& ns_per_sample, Json& out) {
  out["ns_per_sample"] = IntervalJson(MedianOf(ns_per_sample));
  out["ns_per_sample_of_repeats"] = ns_per_sample;
}

Json BouncesJson(const ProfileReport& report) {
  Json bounces = Json::array();
  for (const BounceProfile& b : report.bounces) {
    bounces.push_back({{"depth", bounces.size()},
                       {"seconds", b[kBounceSeconds]},
                       {"rays_closest", b[kBounceClosest]},
                       {"rays_shadow", b[kBounceShadow]},
                       {"occupancy", NumberJson(b[kBounceItems] / b[kBounceSlots])}});
  }
  return bounces;
}

Json RowJson(const ProfileRow& row, double flops) {
  const StageProfile& c = row.counts;
  Json out = {
      {"name", c.name},       {"kind", Name(row.kind)}, {"group", InfoOf(c.group).name},
      {"seconds", c.seconds}, {"share", row.fraction},  {"calls", c.calls},
      {"items", c.items}};
  AddTimes(row.ns_per_sample, out);
  out["ns_per_item"] = c.items > 0 ? Json(row.NsPerItem()) : Json();
  const bool stage = row.kind == RowKind::kStage;
  const auto of_stage = [&](double value) { return stage ? Json(value) : Json(); };
  out["intersect"] = row.intersect;
  out["material"] = c.material.empty() ? Json() : Json(c.material);
  out["occupancy"] = c.lane_slots > 0 ? Json(c.Occupancy()) : Json();
  out["bytes_read_per_item"] = of_stage(c.bytes_read);
  out["bytes_written_per_item"] = of_stage(c.bytes_written);
  out["bytes_per_second"] = of_stage(row.bandwidth);
  out["of_peak_bandwidth"] = of_stage(row.of_peak);
  out["peak_flops_per_item"] = of_stage(1e-9 * row.NsPerItem() * flops);
  out["bound"] = row.bound == Bound::kUnknown ? Json() : Json(Name(row.bound));
  out["counters"] = CountersJson(row);
  return out;
}

Json PeaksJson(const Peaks& peaks) {
  Json levels = Json::array();
  for (const MemoryLevel& level : peaks.levels) {
    levels.push_back({{"name", level.name},
                      {"bytes", level.bytes},
                      {"bytes_read", level.probe},
                      {"bytes_per_second", level.bytes_per_second}});
  }
  return {
      {"levels", levels},
      {"flops", peaks.flops},
      {"fma_instructions_per_cycle", peaks.fma_ipc > 0 ? Json(peaks.fma_ipc) : Json()},
      {"seconds", peaks.seconds}};
}

std::uint64_t TraceEvents(const RunTrace& trace) {
  std::uint64_t events = 0;
  for (const ThreadTrace& thread : trace.threads) events += thread.events.size();
  return events;
}

}  // namespace

Json ToJson(const ProfileReport& report, const Job& job, const RunResult& result) {
  Json rows = Json::array();
  for (const ProfileRow& row : report.rows)
    rows.push_back(RowJson(row, report.peaks.flops));
  Json groups = Json::array();
  for (const ProfileRow& group : report.groups) {
    groups.push_back(RowJson(group, report.peaks.flops));
    groups.back()["meaning"] = InfoOf(group.counts.group).meaning;
  }
  const bool intersects = report.intersect_seconds > 0;
  Json out = {
      {"schema", kProfileSchema},
      {"kind", "profile"},
      {"program", FullVersion()},
      {"repeats", report.ns_per_sample.size()},
      {"confidence", kProfileConfidence},
      {"busy", report.busy},
      {"resolution", {job.window.width(), job.window.height()}},
      {"rays_per_sample", report.rays_per_sample},
      {"groups", groups},
      {"bounces", BouncesJson(report)},
      {"target", TargetJson(job.plan.options.target)},
      {"machine", ToJson(ThisMachine())},
      {"threads", ThreadCount(job.settings.threads)},
      {"samples", result.samples},
      {"spp", job.spp},
      {"seed", job.seed},
      {"strategy", ToText(job.scene.strategy)},
      {"strategy_in_force", ToText(StrategyInForce(result, job))},
      {"scene_hash", fmt::format("{:016x}", job.loaded->scene_hash)},
      {"stopped_early", result.stopped_early},
      {"seconds",
       {{"render", result.seconds},
        {"cpu", result.cpu_seconds},
        {"threads", report.seconds},
        {"waiting", report.waiting_seconds},
        {"intersect", report.intersect_seconds},
        {"other_stages", report.other_stage_seconds}}},
      {"other_stages_over_intersect", intersects ? Json(report.Ratio()) : Json()},
      {"all_else_over_intersect", intersects ? Json(report.RatioWithAll()) : Json()},
      {"rows", rows},
      {"wavefront", {{"bytes", result.bytes_in_flight}, {"level", report.level.name}}},
      {"peaks", PeaksJson(report.peaks)},
      {"counters",
       {{"available", result.counters},
        {"note",
         result.counter_error ? Json(CountersProblem(result.counter_error)) : Json()}}},
      {"trace",
       {{"events", TraceEvents(result.trace)},
        {"dropped", DroppedEvents(result.trace)}}}};
  AddTimes(report.ns_per_sample, out);
  return out;
}

std::string ProfileCsv(const Json& profile) {
  const Json columns = profile.at("rows").at(0).flatten();  // by JSON pointer
  std::string text;
  for (const auto& [column, value] : columns.items()) text += column.substr(1) + ",";
  text.back() = '\n';
  for (const Json& row : profile.at("rows")) {
    const Json cells = row.flatten();
    for (const auto& [column, value] : columns.items()) {
      text += CsvField(cells.contains(column) ? cells.at(column) : Json()) + ",";
    }
    text.back() = '\n';
  }
  return text;
}

}  // namespace lanelight

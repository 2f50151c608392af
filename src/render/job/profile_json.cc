// The report of `lanelight profile --json`.
#include <nlohmann/json.hpp>

#include "src/base/core/hardware_counters.h"
#include "src/base/core/parallel.h"
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

Json RowJson(const ProfileRow& row, double flops) {
  const StageProfile& c = row.counts;
  Json out = {{"name", c.name},        {"kind", Name(row.kind)}, {"seconds", c.seconds},
              {"share", row.fraction}, {"calls", c.calls},       {"items", c.items}};
  out["ns_per_item"] = c.items > 0 ? Json(row.NsPerItem()) : Json();
  const bool stage = row.kind == RowKind::kStage;
  const auto of_stage = [&](double value) { return stage ? Json(value) : Json(); };
  out["intersect"] = row.intersect;
  out["occupancy"] = of_stage(c.Occupancy());
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
  const bool intersects = report.intersect_seconds > 0;
  return {
      {"schema", kProfileSchema},
      {"kind", "profile"},
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
}

}  // namespace lanelight

#include "src/render/job/report.h"

#include <nlohmann/json.hpp>

#include "kernels/simd/target.h"
#include "src/base/stat/values.h"
#include "src/render/job/loaded_scene.h"
#include "src/render/job/machine_json.h"
#include "src/render/job/setting.h"
#include "src/render/wave/light_paths.h"
#include "src/render/wave/shared_samples.h"
#include "src/scene/description/note.h"
#include "src/scene/prepare/parameters.h"
#include "src/scene/prepare/prepared_scene.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;

Json StageJson(const StageProfile& s, double total) {
  return {{"name", s.name},
          {"calls", s.calls},
          {"items", s.items},
          {"occupancy", s.Occupancy()},
          {"seconds", s.seconds},
          {"share", total > 0 ? s.seconds / total : 0},
          {"ns_per_item", s.items ? 1e9 * s.seconds / double(s.items) : 0},
          {"bytes_moved", s.bytes_per_item * double(s.items)}};
}

Json ProfileJson(const std::vector<StageProfile>& stages) {
  double total = 0;
  for (const StageProfile& s : stages) total += s.seconds;
  Json out = Json::array();
  for (const StageProfile& s : stages) out.push_back(StageJson(s, total));
  return out;
}

Json ControlJson(const std::optional<ControlReport>& control) {
  if (!control) return nullptr;
  return {{"coefficient", control->coefficient},
          {"paper_coefficient", -control->coefficient},
          {"correlation", control->correlation}};
}

Json ReportedSettings(const Job& job, bool half) {
  Json settings = SettingsJson(SettingsInForce(job), kReported);
  settings.update({{"strategy", ToText(job.scene.strategy)},
                   {"points", PointsText(job)},
                   {"depth", half ? "half" : "float"}});
  return settings;
}

Json NotesJson(const Job& job) {
  Json out = Json::array();
  for (const Note& note : job.loaded->description.notes) {
    out.push_back({{"where", note.where.ToString()},
                   {"message", note.message},
                   {"changes_image", note.changes_image},
                   {"warning", note.warning}});
  }
  for (const std::string& note : job.plan.notes) {
    out.push_back({{"where", "strategy"},
                   {"message", note},
                   {"changes_image", false},
                   {"warning", false}});
  }
  return out;
}

// Merged states have no BVH of their own.
Json TreesJson(const BvhReport& trees) {
  if (trees.bytes == 0) return nullptr;
  return {{"origin", trees.Origin()}, {"bytes", trees.bytes}};
}

}  // namespace

Strategy StrategyInForce(const RunResult& result, const Job& job) {
  Strategy strategy = job.scene.strategy;
  ApplyStrategy(result.training.changes, {}, strategy);
  return strategy;
}

std::string PointsText(const Job& job) {
  return PointsText(job.scene.strategy, job.OpenEnded() ? 0 : job.spp);
}

Json ToJson(const Plan& plan) {
  Json stages = Json::array(), omitted = Json::array(), live = Json::array(),
       absent = Json::array(), features = Json::array();
  Json seen = Json::array();
  for (const Phase& phase : plan.phases) {
    for (const PlannedStage& s : phase.stages) {
      if (phase.id == PhaseId::kVisibleLights) {
        seen.push_back(s.stage.name);
      } else if (phase.id != PhaseId::kFindEdges) {
        stages.push_back({{"name", s.stage.name},
                          {"role", Name(s.stage.role)},
                          {"meaning", s.stage.meaning}});
      }
    }
  }
  for (const OmittedStage& s : plan.omitted) {
    omitted.push_back({{"name", s.stage.name}, {"reason", s.reason}});
  }
  for (Field f : plan.live_fields) live.push_back(FieldName(f));
  for (Field f : plan.absent_fields) absent.push_back(FieldName(f));
  for (int i = 0; i < int(Feature::kCount); ++i) {
    const auto feature = static_cast<Feature>(i);
    if (plan.features.Has(feature)) features.push_back(FeatureName(feature));
  }
  return {{"stages", stages},
          {"seen_light_stages", seen},
          {"omitted_stages", omitted},
          {"fields", live},
          {"absent_fields", absent},
          {"features", features},
          {"bytes_per_path", plan.bytes_per_path},
          {"wavefront", plan.wavefront}};
}

Json ToJson(const ErrorEstimate& e) {
  if (!e.available) return nullptr;
  return {{"rmse", IntervalJson(e.rmse)},
          {"relmse", IntervalJson(e.relmse)},
          {"confidence", kEstimateConfidence},
          {"why", e.why.empty() ? Json(nullptr) : Json(e.why)},
          {"pixels", e.pixels},
          {"effective_pixels", e.effective_pixels}};
}

Json TargetJson(SimdTarget target) {
  return {{"name", target.name()},
          {"lanes", target.lanes()},
          {"available", AvailableTargets()}};
}

Json HeadJson(const Job& job, const std::string& scene, bool half) {
  const FilterReach reach = ReachOfFilter(job.scene);
  Json versions = Json::object();
  for (const auto& [name, version] : LibraryVersions()) versions[name] = version;
  return {{"schema", kReportSchema},
          {"scene", scene},
          {"scene_hash", fmt::format("{:016x}", job.loaded->scene_hash)},
          {"scale", job.scene.scale()},
          {"chance_of_light", ChanceOfLight(job.scene)},
          {"splat_unit", SplatUnit(job.scene)},
          {"filter_reach",
           {{"splats", reach.splats},
            {"shared", reach.shared},
            {"shared_variance", reach.shared_variance}}},
          {"plan", ToJson(job.plan)},
          {"settings", ReportedSettings(job, half)},
          {"target", TargetJson(job.plan.options.target)},
          {"machine", ToJson(ThisMachine())},
          {"notes", NotesJson(job)},
          {"differs", CountImageChanges(job.loaded->description.notes) > 0},
          {"versions", versions}};
}

Json ToJson(const RenderReport& report, const Json& head) {
  const RunResult& r = report.result;
  const double seconds = r.seconds > 0 ? r.seconds : 1e-9;
  const std::uint64_t rays = r.rays_closest + r.rays_shadow;
  Json json = {
      {"output",
       {{"exr", report.exr}, {"png", report.png.empty() ? Json() : Json(report.png)}}},
      {"seconds",
       {{"load", report.load_seconds},
        {"build", report.build_seconds},
        {"trees", report.trees.seconds},
        {"render", r.seconds},
        {"pilot", r.training.seconds},
        {"write", report.write_seconds}}},
      {"trees", TreesJson(report.trees)},
      {"ranks", r.ranks},
      {"bytes_between_ranks", r.bytes_between_ranks},
      {"cpu_seconds", r.cpu_seconds},
      {"samples", r.samples},
      {"unsampled_pixels", report.unsampled_pixels},
      {"partial", report.partial_number > 0},
      {"samples_per_second", double(r.samples) / seconds},
      {"rays", {{"closest", r.rays_closest}, {"shadow", r.rays_shadow}, {"total", rays}}},
      {"pilot",
       {{"samples", r.training.samples},
        {"rays", r.training.rays},
        {"note", r.training.note},
        {"changes", r.training.changes},
        {"gain", r.training.gain > 0 ? Json(r.training.gain) : Json()},
        {"filtered_gain", r.training.gain > 0 ? Json(r.training.filtered_gain) : Json()},
        {"roulette", Name(r.roulette)}}},
      {"rays_per_second", double(rays) / seconds},
      {"stopped_early", r.stopped_early},
      {"stop_reason", Name(r.stop_reason)},
      {"looks", r.num_checks},
      {"error", ToJson(report.error)},
      {"control", ControlJson(r.control)},
      {"health",
       {{"nan", r.health.nan},
        {"infinite", r.health.infinite},
        {"negative", r.health.negative}}},
      {"stages", ProfileJson(r.stages)},
      {"wavefront_bytes", r.wavefront_bytes}};
  json.update(head);
  return json;
}

}  // namespace lanelight

#include "src/measure/study/study.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "kernels/simd/target.h"
#include "src/base/core/parallel.h"
#include "src/base/stat/values.h"
#include "src/render/job/machine_json.h"
#include "src/render/job/report.h"

namespace lanelight {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Interval, value, low, high)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SelfCheck, relmse, inside, total, refused)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LevelAnalysis, spp, repetitions, rmse, relmse,
                                   relmse_trimmed, relmse_2, relmse_4, relmse_8, mape,
                                   worst_share, variance, bias2, bias, cpu_seconds,
                                   wall_seconds, rays_per_sample, path_length,
                                   reference_share, invalid)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SelfFailure, strategy, inside, total, pixel,
                                   worst_share)

namespace {

using Json = nlohmann::json;

Json Text(const std::string& text) { return text.empty() ? Json() : Json(text); }

Json Color(const Rgb& c) { return {NumberJson(c.x), NumberJson(c.y), NumberJson(c.z)}; }

template <class T>
Json Optional(const std::optional<T>& v) {
  return v ? Json(*v) : Json();
}

Json LevelJson(const LevelAnalysis& l) {
  const bool has_self = l.self.total + l.self.refused > 0;
  Json out = l;
  out.update({{"mean", Color(l.mean)},
              {"bias_p", Optional(l.bias_p)},
              {"reference_limited", l.ReferenceLimited()},
              {"image", Text(l.image)},
              {"self", has_self ? Json(l.self) : Json()}});
  return out;
}

Json StagesJson(const std::vector<StageProfile>& stages) {
  double total = 0;
  for (const StageProfile& s : stages) total += s.seconds;
  Json out = Json::array();
  for (const StageProfile& s : stages) {
    out.push_back({{"name", s.name},
                   {"seconds", s.seconds},
                   {"share", total > 0 ? s.seconds / total : 0},
                   {"ns_per_item", s.items ? 1e9 * s.seconds / double(s.items) : 0},
                   {"items", s.items},
                   {"occupancy", s.Occupancy()}});
  }
  return out;
}

Json TilesJson(const std::optional<TileTest>& tiles) {
  if (!tiles) return nullptr;
  Json out = TilesJson(tiles->layout, tiles->z);
  out.update(
      {{"failed", tiles->failed}, {"shared", tiles->shared}, {"level", tiles->level}});
  return out;
}

Json TargetJson(const std::optional<stat::TargetCost>& target) {
  if (!target) return nullptr;
  return {{"spp", IntervalJson(target->samples)},
          {"seconds", IntervalJson(target->seconds)},
          {"extrapolated", target->extrapolated}};
}

Json StrategyJson(const StrategyRuns& runs, const StrategyAnalysis& s) {
  const int figure = PaperFigure(runs.named.name);
  Json out = {{"name", runs.named.name},
              {"text", runs.Text()},
              {"status", Name(runs.status)},
              {"message", Text(runs.message)},
              {"same_as", Optional(runs.same_as)},
              {"figure", figure > 0 ? Json(figure) : Json()},
              {"levels", Json::array()},
              {"order", IntervalJson(s.order)},
              {"order_relmse", IntervalJson(s.order_relmse)},
              {"to_target", TargetJson(s.to_target)},
              {"efficiency", IntervalJson(s.efficiency)},
              {"efficiency_trimmed", IntervalJson(s.efficiency_trimmed)},
              {"budget_uncertainty", NumberJson(s.budget_uncertainty)},
              {"at_spp", s.HasRuns() ? Json(s.AtLevel().spp) : Json()},
              {"rank", s.HasRuns() ? Json({s.rank.best, s.rank.worst}) : Json()},
              {"heavy_tailed", s.heavy_tailed},
              {"stages", StagesJson(s.stages)},
              {"images",
               {{"mean", Text(s.mean)},
                {"one", Text(s.one)},
                {"variance", Text(s.variance)},
                {"bias", Text(s.bias)}}},
              {"tiles", TilesJson(s.tiles)}};
  for (const LevelAnalysis& level : s.levels) out["levels"].push_back(LevelJson(level));
  if (runs.status == RunStatus::kOk && !s.HasRuns()) {
    out["status"] = Name(RunStatus::kSkipped);
  }
  return out;
}

Json ReferenceJson(const SceneRuns& runs, const SceneAnalysis& analysis) {
  const Reference& r = runs.reference;
  if (r.mean.empty()) return nullptr;
  return {{"source", r.rendered() ? "rendered" : "file"},
          {"files", r.files},
          {"strategy", Text(r.strategy)},
          {"spp", r.rendered() ? Json(r.spp) : Json()},
          {"relmse", r.has_variance() ? NumberJson(r.OwnRelMse()) : Json()},
          {"rmse", r.has_variance() ? NumberJson(std::sqrt(r.OwnMse())) : Json()},
          {"independent", r.has_variance()},
          {"note", Text(r.note)},
          {"image", Text(analysis.reference_image)}};
}

Json CalibrationJson(const SceneAnalysis& analysis) {
  const SelfCheck& self = analysis.calibration;
  if (self.total + self.refused == 0) return nullptr;
  return {{"inside", self.inside},
          {"total", self.total},
          {"refused", self.refused},
          {"seeds", analysis.calibration_seeds},
          {"share", IntervalJson(analysis.calibration_share)},
          {"stated", kEstimateConfidence},
          {"failed", analysis.self_failures}};
}

Json DiffuseJson(const SceneRuns& runs, const SceneAnalysis& analysis) {
  Json out = Json::array();
  for (std::size_t i = 0; i < runs.diffuse.size(); ++i) {
    const DiffuseModel& model = runs.diffuse[i];
    Rgb mean;
    for (const Rgb& c : model.image) mean += c / double(model.image.size());
    out.push_back({{"model", model.name},
                   {"meaning", model.meaning},
                   {"image", analysis.diffuse_images[i]},
                   {"mean", Color(mean)}});
  }
  return out;
}

Json SceneJson(const SceneStudy& study, const StudyOptions& options) {
  const SceneRuns& runs = study.runs;
  const SceneAnalysis& analysis = study.analysis;
  Json out = {{"name", runs.name}, {"path", runs.path}, {"error", Text(runs.error)}};
  if (!runs.error.empty()) return out;
  const PixelRect& w = runs.window;
  out["hash"] = runs.hash;
  out["resolution"] = {runs.full_width, runs.full_height};
  out["crop"] = {w.x0, w.y0, w.x1, w.y1};
  out["seconds"] = {{"load", runs.load_seconds},
                    {"build", runs.build_seconds},
                    {"trees", runs.trees.seconds},
                    {"reference", runs.reference.seconds}};
  out["trees"] = runs.trees.Origin();
  out["notes"] = runs.notes;
  out["differs"] = Text(runs.differs);
  out["reference"] = ReferenceJson(runs, analysis);
  out["baseline"] = analysis.baseline;
  out["counts"] = options.spp;
  out["target_relmse"] = NumberJson(analysis.target_relmse);
  out["strategies"] = Json::array();
  for (std::size_t i = 0; i < analysis.strategies.size(); ++i) {
    out["strategies"].push_back(StrategyJson(runs.strategies[i], analysis.strategies[i]));
  }
  out["ranking"] = analysis.ranking;
  out["calibration"] = CalibrationJson(analysis);
  out["bias"] = {{"tests", analysis.bias_tests},
                 {"failed", analysis.biased.size()},
                 {"strategies", analysis.biased},
                 {"alike", analysis.biased_alike},
                 {"suspect_tiles", analysis.suspect_tiles},
                 {"level", analysis.bias_level}};
  out["verdict"] = analysis.verdict;
  out["cautions"] = analysis.cautions;
  out["machines"] = ToJson(analysis.machines);
  out["diffuse"] = DiffuseJson(runs, analysis);
  out["interrupted"] = runs.interrupted;
  out["report_scale"] = analysis.report_scale;
  return out;
}

Json SettingsJson(const StudyOptions& options) {
  const RenderSettings& s = options.settings;
  return {{"confidence", options.confidence},
          {"repetitions", options.Repetitions()},
          {"seed", Optional(s.seed)},
          {"threads", ThreadCount(s.threads)},
          {"max_depth", Optional(s.max_depth)},
          {"resolution", Optional(s.resolution)},
          {"crop", Optional(s.crop)},
          {"spp", options.spp.empty() ? Json() : Json(options.spp)},
          {"budget", Optional(options.budget)},
          {"target_relmse", Optional(options.target_relmse)}};
}

}  // namespace

nlohmann::json StudyJson(const std::vector<SceneStudy>& scenes,
                         const StudyOptions& options, double seconds) {
  Json versions = Json::object();
  for (const auto& [name, version] : LibraryVersions()) versions[name] = version;
  Json out = {{"schema", 1},
              {"kind", "lanelight-study"},
              {"settings", SettingsJson(options)},
              {"machine", ToJson(ThisMachine())},
              {"seconds", seconds},
              {"scenes", Json::array()}};
  out["machine"].update({{"target", SimdTarget(options.settings.target).name()},
                         {"threads", ThreadCount(options.settings.threads)},
                         {"versions", versions}});
  for (const SceneStudy& scene : scenes) {
    out["scenes"].push_back(SceneJson(scene, options));
  }
  return out;
}

std::string StudyCsv(const std::vector<SceneStudy>& scenes) {
  std::string text = "scene,strategy,spp,repetition," + CsvHeader() + ",inside," +
                     MachineCsvHeader() + "\n";
  for (const SceneStudy& scene : scenes) {
    if (!scene.runs.error.empty()) continue;
    const CellStore store(scene.runs.folder + "/cells", scene.runs.window);
    for (const StrategyRuns& runs : scene.runs.strategies) {
      for (std::uint64_t spp : runs.counts) {
        const Cells cells = store.Load(runs.Text(), spp);
        for (std::size_t r = 0; r < cells.repetitions.size(); ++r) {
          const Measurement& m = cells.repetitions[r];
          text += fmt::format("{},{},{},{},{},{},{}\n", CsvQuoted(scene.runs.name),
                              CsvQuoted(runs.named.name), spp, r + 1, CsvRow(m),
                              m.HasSelf() ? m.SelfIntervalCovers() ? "1" : "0" : "",
                              MachineCsvRow(m.machine));
        }
      }
    }
  }
  return text;
}

}  // namespace lanelight

#include "src/measure/live/state_json.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "kernels/simd/target.h"
#include "src/base/core/json_text.h"
#include "src/base/core/parallel.h"
#include "src/base/core/version.h"
#include "src/measure/live/picture.h"
#include "src/render/job/loaded_scene.h"
#include "src/scene/description/film.h"
#include "src/vocabulary/strategy/strategy_text.h"

namespace lanelight::live {
namespace {

using nlohmann::json;

// Ends that are not known become null.
json SnapshotJson(const EstimateSnapshot& snapshot) {
  const Interval& e = snapshot.error.relmse;
  return {{"spp", snapshot.spp}, {"seconds", snapshot.seconds},
          {"relmse", e.value},   {"low", e.low},
          {"high", e.high},      {"why", snapshot.error.why}};
}

json SnapshotsJson(const PassRenderer& renderer) {
  json snapshots = json::array();
  for (const EstimateSnapshot& snapshot : renderer.snapshots())
    snapshots.push_back(SnapshotJson(snapshot));
  return snapshots;
}

json StagesJson(const PassRenderer& renderer) {
  json stages = json::array();
  for (const StageProfile& stage : renderer.stages()) {
    if (stage.calls == 0) continue;
    json filled = nullptr;  // parts of tasks have no lanes
    if (stage.lane_slots > 0) filled = stage.Occupancy();
    stages.push_back({{"name", stage.name},
                      {"seconds", stage.seconds},
                      {"items", stage.items},
                      {"filled", filled}});
  }
  return stages;
}

json OmittedJson(const Plan& plan) {
  json omitted = json::array();
  for (const OmittedStage& s : plan.omitted) {
    omitted.push_back({{"name", s.stage.name}, {"reason", s.reason}});
  }
  return omitted;
}

json PassJson(const PassRenderer& renderer, const std::string& command) {
  const RunCounts& counts = renderer.record().counts;
  const std::string strategy = ToText(renderer.strategy());
  return {{"strategy", strategy},
          {"spp", renderer.spp()},
          {"samples", counts.samples},
          {"invalid", counts.health.Total()},
          {"rays", counts.rays_closest + counts.rays_shadow},
          {"seconds", renderer.cpu_seconds()},
          {"training", renderer.training()},
          {"looks", SnapshotsJson(renderer)},
          {"stages", StagesJson(renderer)},
          {"omitted", OmittedJson(renderer.plan())},
          {"notes", renderer.plan().notes},
          {"command", fmt::format("{} -o out.exr --spp {} --strategy {}", command,
                                  std::max<std::uint64_t>(1, renderer.spp()), strategy)}};
}

json SlotJson(const StateOfSlot& slot, const std::string& command) {
  json out = {{"name", slot.name}, {"refused", slot.refused}};
  if (slot.renderer != nullptr) out.update(PassJson(*slot.renderer, command));
  return out;
}

json RatioJson(const StateOfPage& state) {
  const PassRenderer* const a = state.slots[0].renderer;
  const PassRenderer* const b = state.slots[1].renderer;
  if (a == nullptr || b == nullptr || a == b) return nullptr;
  const Ratio ratio = EfficiencyOf(*a, *b, state.pace);
  json out = {{"why", ratio.why}};
  if (!ratio.available) return out;
  out["value"] = ratio.interval.value;
  out["low"] = ratio.interval.low;
  out["high"] = ratio.interval.high;
  if (ratio.ahead != Ahead::kUnknown) {
    out["ahead"] = ratio.ahead == Ahead::kB ? "B" : "A";
    out["since"] = ratio.since;
  }
  return out;
}

const char* KindName(CameraKind kind) {
  switch (kind) {
    case CameraKind::kPerspective:
      return "perspective";
    case CameraKind::kOrthographic:
      return "orthographic";
    case CameraKind::kSpherical:
      return "spherical";
    case CameraKind::kRealistic:
      return "realistic";
  }
  return "";
}

}  // namespace

std::string HelloText(const LiveScene& live_scene) {
  const SceneDescription& scene = live_scene.job.loaded->description;
  const PixelRect window = RenderedPixels(scene.film);
  json notes = json::array();
  for (const Note& note : scene.notes) {
    notes.push_back(note.where.ToString() + ": " + note.message);
  }
  return DumpJson({{"kind", "hello"},
                   {"scene", live_scene.path},
                   {"width", window.width()},
                   {"height", window.height()},
                   {"x0", window.x0},
                   {"y0", window.y0},
                   {"eye", ToJson(live_scene.pose)},
                   {"camera", KindName(scene.camera.kind)},
                   {"mirrored", scene.camera.world_from_camera.SwapsHandedness()},
                   {"strategies", StrategiesJson()},
                   {"scene_strategy", ToText(scene.strategy)},
                   {"layers", LayersJson()},
                   {"confidence", kEstimateConfidence},
                   {"threads", ThreadCount(live_scene.job.settings.threads)},
                   {"target", live_scene.job.plan.options.target.name()},
                   {"version", FullVersion()},
                   {"load_seconds", live_scene.job.loaded->load_seconds},
                   {"build_seconds", live_scene.job.loaded->build_seconds},
                   {"notes", notes}});
}

std::string StateText(const StateOfPage& state, const std::string& command) {
  json slots = json::array();
  for (const StateOfSlot& slot : state.slots) slots.push_back(SlotJson(slot, command));
  return DumpJson({{"kind", "state"},
                   {"view", state.view},
                   {"eye", ToJson(state.pose)},
                   {"moved", !(state.pose == state.live_scene.pose)},
                   {"pace", state.pace == Pace::kTime ? "time" : "samples"},
                   {"paused", state.paused},
                   {"slots", slots},
                   {"ratio", RatioJson(state)}});
}

nlohmann::json ParseMessage(std::string_view text) {
  if (text.size() > kLongestMessage) {
    throw InputError(fmt::format("a message of {} bytes; at most {} are accepted",
                                 text.size(), kLongestMessage));
  }
  try {
    nlohmann::json message = ParseJson(text);
    message.at("do").get_ref<const std::string&>();
    return message;
  } catch (const nlohmann::json::exception& error) {
    throw UnknownMessageText(error);
  }
}

InputError UnknownMessageText(const nlohmann::json::exception& error) {
  return InputError("invalid message: " + JsonProblem(error));
}

bool ChangesWork(const nlohmann::json& message) {
  const std::string& what = message.at("do").get_ref<const std::string&>();
  return what == "camera" || what == "strategy" || what == "pace" || what == "pause";
}

}  // namespace lanelight::live

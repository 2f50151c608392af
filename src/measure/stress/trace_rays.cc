#include "src/measure/stress/trace_rays.h"

#include <string_view>

#include "src/measure/stress/scene_point.h"
#include "src/scene/accel/accel.h"

namespace lanelight::stress {
namespace {

RenderSettings SettingsOn(SimdTarget target) {
  RenderSettings settings;
  settings.target = target.name();
  return settings;
}

constexpr std::size_t kPadding = 32;  // kernels may store a vector past the last path

}  // namespace

RayTracer::RayTracer(SimdTarget target, const std::string& text)
    : job_(PrepareText({text, SettingsOn(target)})) {
  static_cast<SceneParts&>(wave_) = job_.scene.Parts();
  wave_.run = &run_;
}

// Every column, whether the plan has it or not: these are few rays.
void RayTracer::Allocate(std::size_t rays) {
  if (rays <= wave_.capacity) return;
  storage_.clear();
  storage_.reserve(kNumFields + kNumQueues);
  const auto column = [&] {
    storage_.emplace_back(rays + kPadding, 0u);
    return storage_.back().data();
  };
#define X(type, name, ...) wave_.path.name = reinterpret_cast<type*>(column());
  LANELIGHT_PATH_FIELDS(X)
#undef X
  for (Queue& queue : wave_.queues) queue = {column(), 0};
  wave_.lists = ColumnLists(wave_.path, FeatureSet::All());
  wave_.capacity = static_cast<std::uint32_t>(rays);
}

void RayTracer::RunStages(const char* prefix) {
  for (const PlannedStage& planned : job_.plan.paths().stages) {
    if (std::string_view(planned.stage.name).starts_with(prefix)) planned.kernel(wave_);
  }
}

void RayTracer::PutRay(std::uint32_t slot, const WorldRay& ray) {
  const CompiledScene& s = scene();
  const Vec3f o = VecCast<float>((ray.origin - s.center) * s.scale);
  const Vec3f d = VecCast<float>(ray.direction);
  PathColumns& p = wave_.path;
  p.o_x[slot] = o.x, p.o_y[slot] = o.y, p.o_z[slot] = o.z;
  p.d_x[slot] = d.x, p.d_y[slot] = d.y, p.d_z[slot] = d.z;
  p.t[slot] = std::numeric_limits<float>::infinity();
  p.prim[slot] = kNoPrimitive;
  p.inst[slot] = kWorldInstance;
}

WorldRay RayTracer::Rounded(const WorldRay& ray) const {
  const CompiledScene& s = scene();
  const Vec3f o = VecCast<float>((ray.origin - s.center) * s.scale);
  return {VecCast<double>(o) / s.scale + s.center,
          VecCast<double>(VecCast<float>(ray.direction))};
}

WorldHit RayTracer::HitOf(std::uint32_t slot) const {
  const PathColumns& p = wave_.path;
  WorldHit hit;
  if (p.t[slot] == std::numeric_limits<float>::infinity()) return hit;
  const CompiledScene& s = scene();
  hit.found = true;
  hit.t = p.t[slot] / s.scale;
  hit.primitive = p.prim[slot];
  hit.point = Vec3d{p.p_x[slot], p.p_y[slot], p.p_z[slot]} / s.scale + s.center;
  hit.normal = {p.ng_x[slot], p.ng_y[slot], p.ng_z[slot]};
  return hit;
}

std::vector<WorldHit> RayTracer::Trace(const std::vector<WorldRay>& rays) {
  Allocate(rays.size());
  rays_ = static_cast<std::uint32_t>(rays.size());
  Queue& active = wave_.queue(QueueId::kActive);
  Queue& surface = wave_.queue(QueueId::kSurface);
  active.size = surface.size = 0;
  for (std::uint32_t i = 0; i < rays_; ++i) {
    PutRay(i, rays[i]);
    active.items[active.size++] = i;
  }
  if (rays_ > 0) RunStages("intersect_");
  for (std::uint32_t i = 0; i < rays_; ++i) {
    if (wave_.path.t[i] != std::numeric_limits<float>::infinity()) {
      surface.items[surface.size++] = i;
    }
  }
  if (surface.size > 0) RunStages("surface_");
  std::vector<WorldHit> hits;
  for (std::uint32_t i = 0; i < rays_; ++i) hits.push_back(HitOf(i));
  return hits;
}

std::vector<bool> RayTracer::Blocked(const std::vector<Vec3d>& directions,
                                     double length) {
  Queue& shadow = wave_.queue(QueueId::kShadow);
  shadow.size = 0;
  const PathColumns& p = wave_.path;
  std::vector<bool> blocked(directions.size(), false);
  for (std::uint32_t i = 0; i < directions.size() && i < rays_; ++i) {
    if (p.t[i] == std::numeric_limits<float>::infinity()) continue;
    const Vec3f d = VecCast<float>(directions[i]);
    p.ls_x[i] = d.x, p.ls_y[i] = d.y, p.ls_z[i] = d.z;
    p.ls_distance[i] = static_cast<float>(length * scene().scale);
    shadow.items[shadow.size++] = i;
    blocked[i] = true;
  }
  if (shadow.size > 0) RunStages("shadow_");
  for (std::uint32_t k = 0; k < shadow.size; ++k) blocked[shadow.items[k]] = false;
  return blocked;
}

}  // namespace lanelight::stress

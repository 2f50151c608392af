#include "tests/extremes/ray_trial.h"

#include <cmath>
#include <string_view>

#include "src/base/core/pi.h"
#include "src/measure/stress/scene_point.h"

namespace lanelight::stress {
namespace {

RenderSettings SettingsOn(SimdTarget target) {
  RenderSettings settings;
  settings.target = target.name();
  return settings;
}

}  // namespace

Across::Across(Vec3d n) {
  const Vec3d other = std::abs(n.x) < 0.7 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  u = Normalize(Cross(n, other));
  v = Cross(n, u);
}

Vec3d Across::At(double phi) const { return std::cos(phi) * u + std::sin(phi) * v; }

double Draws::operator()(double low, double high) {
  const double unit = static_cast<double>(engine_() >> 11) * 0x1p-53;
  return low + (high - low) * unit;
}

Vec3d Draws::Direction() {
  const double z = (*this)(-1, 1), phi = (*this)(0, 2 * kPi);
  const double ring = std::sqrt(1 - z * z);
  return {ring * std::cos(phi), ring * std::sin(phi), z};
}

Vec3d Draws::Above(Vec3d n, double sine) {
  const double length = Length(n);
  for (;;) {
    const Vec3d d = Direction();
    const double cosine = Dot(d, n);
    if (std::abs(cosine) >= sine * length) return cosine > 0 ? d : -d;
  }
}

Vec3d Draws::AtSine(Vec3d n, double sine) {
  const Vec3d flat = Across(n).At((*this)(0, 2 * kPi));
  return std::sqrt(1 - sine * sine) * flat + sine * n;
}

Vec3d PointOfSquare(Draws& draws, Vec3d center, Vec3d n, double side) {
  const Across a(n);
  return center + (a.u * draws(-0.45, 0.45) + a.v * draws(-0.45, 0.45)) * side;
}

MeshText SphereMesh(int rings, int segments, Vec3d center, double radius) {
  MeshText mesh;
  for (int r = 0; r <= rings; ++r) {
    const double theta = kPi * r / rings;
    const double sine = r == 0 || r == rings ? 0 : std::sin(theta);
    for (int s = 0; s < segments; ++s) {
      const double phi = 2 * kPi * s / segments;
      mesh.points.push_back(center + radius * Vec3d{sine * std::cos(phi),
                                                    sine * std::sin(phi),
                                                    std::cos(theta)});
    }
  }
  const auto at = [&](int r, int s) { return r * segments + s % segments; };
  for (int r = 0; r < rings; ++r) {
    for (int s = 0; s < segments; ++s) {
      const int a = r == 0 ? 0 : at(r, s), d = r == 0 ? 0 : at(r, s + 1);
      const int last = at(rings, 0);
      const int b = r + 1 == rings ? last : at(r + 1, s);
      const int c = r + 1 == rings ? last : at(r + 1, s + 1);
      if (b != c) mesh.indices.insert(mesh.indices.end(), {a, b, c});
      if (a != d) mesh.indices.insert(mesh.indices.end(), {a, c, d});
    }
  }
  return mesh;
}

MeshText SquareMesh(Vec3d center, Vec3d n, double side) {
  const Across a(n);
  const Vec3d u = a.u * (side / 2), v = a.v * (side / 2);
  MeshText mesh;
  mesh.AddQuad(center - u - v, center + u - v, center + u + v, center - u + v);
  return mesh;
}

std::string RayScene(const std::string& shapes, Vec3d eye) {
  return SkyScene(CameraText(eye, eye - Vec3d{0, 0, 1}), 0.5, shapes);
}

std::vector<Point> ExpectBothWays(double expected, const std::string& text,
                                  Quality quality, const Effort& effort) {
  quality.strategy = "directions=bsdf";
  const Point bsdf = Expect(expected, text, quality, effort);
  quality.strategy = "";
  quality.quick *= 16;
  return {Named("bsdf", bsdf), Named("mis", Expect(expected, text, quality, effort))};
}

Point BoundPoint(double worst, double bound) {
  Point point;
  point.measured = worst;
  point.tolerance = bound;
  return point;
}

Point NoFailures(std::uint64_t failures, std::uint64_t trials) {
  Point point;
  point.measured = trials > 0 ? double(failures) / double(trials) : 1;
  return point;
}

RayTracer::RayTracer(SimdTarget target, const std::string& text)
    : job_(PrepareText({text, SettingsOn(target)})) {}

void RayTracer::RunStages(const char* prefix) {
  for (const PlannedStage& planned : job_.plan.paths().stages) {
    if (std::string_view(planned.stage.name).starts_with(prefix)) {
      planned.kernel(fixture_->wave);
    }
  }
}

WorldRay RayTracer::Rounded(const WorldRay& ray) const {
  const CompiledScene& s = scene();
  const Vec3f o = VecCast<float>((ray.origin - s.center) * s.scale);
  return {VecCast<double>(o) / s.scale + s.center,
          VecCast<double>(VecCast<float>(ray.direction))};
}

WorldHit RayTracer::HitOf(std::uint32_t slot) const {
  const PathColumns& p = fixture_->wave.path;
  const CompiledScene& s = scene();
  if (std::isinf(p.t[slot])) return {};
  return {true, p.t[slot] / s.scale, p.prim[slot],
          VecCast<double>(fixture_->P(slot)) / s.scale + s.center,
          VecCast<double>(fixture_->Ng(slot))};
}

std::vector<WorldHit> RayTracer::Trace(const std::vector<WorldRay>& rays) {
  const CompiledScene& s = scene();
  std::vector<TestRay> rounded;
  for (const WorldRay& ray : rays) {
    rounded.push_back({VecCast<float>((ray.origin - s.center) * s.scale),
                       VecCast<float>(ray.direction)});
  }
  fixture_.emplace(job_.scene.Parts(), static_cast<std::uint32_t>(rays.size()));
  fixture_->SetRays(rounded);
  RunStages("intersect_");
  Queue& surface = fixture_->wave.queue(QueueId::kSurface);
  surface.size = 0;
  for (std::uint32_t i = 0; i < rays.size(); ++i) {
    if (!std::isinf(fixture_->wave.path.t[i])) surface.items[surface.size++] = i;
  }
  if (surface.size > 0) RunStages("surface_");
  std::vector<WorldHit> hits;
  for (std::uint32_t i = 0; i < rays.size(); ++i) hits.push_back(HitOf(i));
  return hits;
}

std::vector<bool> RayTracer::Blocked(const std::vector<Vec3d>& directions,
                                     double length) {
  Queue& shadow = fixture_->wave.queue(QueueId::kShadow);
  shadow.size = 0;
  const PathColumns& p = fixture_->wave.path;
  std::vector<bool> blocked(directions.size(), false);
  for (std::uint32_t i = 0; i < directions.size(); ++i) {
    if (std::isinf(p.t[i])) continue;
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

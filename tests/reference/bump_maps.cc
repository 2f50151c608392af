#include "tests/reference/bump_maps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/base/core/check.h"
#include "tests/reference/frame.h"

namespace lanelight::reference {
namespace {

// Directions (perspective) or origins (orthographic) one pixel apart, in camera space.
void PixelStep(const Camera& camera, const Film& film, double step[2]) {
  double window[4];
  std::copy(camera.screen_window, camera.screen_window + 4, window);
  if (window[1] == window[0]) {
    const double aspect = static_cast<double>(film.width) / film.height;
    window[1] = std::max(1.0, aspect), window[0] = -window[1];
    window[3] = std::max(1.0, 1 / aspect), window[2] = -window[3];
  }
  const bool perspective = camera.kind == CameraKind::kPerspective;
  const double k = perspective ? std::tan(camera.fov / 360 * std::numbers::pi) : 1;
  step[0] = k * (window[1] - window[0]) / film.width;
  step[1] = -k * (window[3] - window[2]) / film.height;
}

// By how much of u and v the vector d, in the tangent plane, leads on.
UvSteps InSurface(const SurfacePoint& at, Vec3d d) {
  const Vec3d across_v = Cross(at.dpdv, at.ng), across_u = Cross(at.dpdu, at.ng);
  return {Dot(d, across_v) / Dot(at.dpdu, across_v),
          Dot(d, across_u) / Dot(at.dpdv, across_u)};
}

// Slopes of a height per unit length along two directions give its gradient g: slope_u =
// g . a, slope_v = g . b in the plane of a and b. The displaced surface has the normal
// n - g.
Vec3d BumpedNormal(const SurfacePoint& at, Vec3d a, Vec3d b, double slope_u,
                   double slope_v) {
  const Vec3d across_a = Cross(a, at.ns), across_b = Cross(b, at.ns);
  const Vec3d gradient =
      across_b * (slope_u / Dot(a, across_b)) + across_a * (slope_v / Dot(b, across_a));
  return Normalize(at.ns - gradient);
}

SurfacePoint Bumped(const SceneDescription& scene, const Material& material,
                    const SurfacePoint& at, const TextureLookup& texture) {
  const auto height = [&](double u, double v) {
    const Vec3d moved = at.p + at.dpdu * (u - at.u) + at.dpdv * (v - at.v);
    return texture(material.displacement.texture, {u, v, moved, at.ng}).x;
  };
  UvSteps step = HalfFootprint(scene, at);
  // Not less than single precision can tell apart.
  step.u = std::max(step.u, std::max(1.0, std::abs(at.u)) / 131072);
  step.v = std::max(step.v, std::max(1.0, std::abs(at.v)) / 131072);
  const double here = height(at.u, at.v);
  const double slope_u = (height(at.u + step.u, at.v) - here) / step.u;
  const double slope_v = (height(at.u, at.v + step.v) - here) / step.v;
  Vec3d a = at.dpdu, b = at.dpdv;
  if (at.mesh_side != 0) {
    a = a - Dot(a, at.ns) * at.ns;
    b = at.mesh_side * Cross(at.ns, a);
  }
  SurfacePoint out = at;
  out.ns = BumpedNormal(at, a, b, slope_u, slope_v);
  out.dpdu = a + slope_u * at.ns;
  return out;
}

SurfacePoint Mapped(const Material& material, const SurfacePoint& at,
                    const NormalMapLookup& normal_map) {
  const Rgb c = normal_map(material.normal_map, at.u, at.v);
  const TangentFrame frame = MakeFrame(at.ns, at.dpdu);
  SurfacePoint out = at;
  out.ns = Normalize(frame.ToWorld({2 * c.x - 1, 2 * c.y - 1, 2 * c.z - 1}));
  out.dpdu = frame.x;
  return out;
}

bool OnlyMirrorsOrRefracts(MaterialKind kind) {
  return kind == MaterialKind::kConductor || kind == MaterialKind::kCoatedConductor ||
         kind == MaterialKind::kDielectric || kind == MaterialKind::kThinDielectric;
}

// See kernels/surface/mapped_normals-inl.h.
Vec3d KeepInView(Vec3d n, Vec3d ng, Vec3d wo, bool mirrors) {
  if (Dot(ng, wo) < 0) wo = -wo;
  const double min_cosine = 1.0 / 64, steepest = std::acos(min_cosine);
  if (Dot(n, wo) < min_cosine) {
    const TangentFrame frame = MakeFrame(wo, n);
    n = std::sin(steepest) * frame.x + std::cos(steepest) * wo;
  }
  const Vec3d mirrored = 2 * Dot(n, wo) * n - wo;
  const double wanted = std::min(min_cosine, Dot(wo, ng)), height = Dot(mirrored, ng);
  if (!mirrors || height >= wanted) return n;
  return Normalize(wo + Normalize(mirrored + (wanted - height) * ng));
}

}  // namespace

UvSteps HalfFootprint(const SceneDescription& scene, const SurfacePoint& at) {
  const Camera& camera = scene.camera;
  const Transform to_world = camera.world_from_camera;
  const Vec3d q = to_world.Inverse().Point(at.p);
  LL_CHECK(q.z > 0);
  double step[2];
  PixelStep(camera, scene.film, step);
  const double scale = std::max(0.125, 1 / std::sqrt(scene.sampler.spp));
  UvSteps sum = {0, 0};
  for (int axis = 0; axis < 2; ++axis) {
    // A thousandth of a pixel aside: where does that ray meet the tangent plane?
    Vec3d beside = {0, 0, 0}, direction = {0, 0, 1};
    const bool perspective = camera.kind == CameraKind::kPerspective;
    if (perspective) direction = q / q.z;
    (perspective ? direction : beside)[axis] += step[axis] * scale / 1000;
    if (!perspective) beside += Vec3d{q.x, q.y, 0};
    const Vec3d o = to_world.Point(beside), d = to_world.Vector(direction);
    const double t = Dot(at.p - o, at.ng) / Dot(d, at.ng);
    const UvSteps there = InSurface(at, (o + t * d - at.p) * 1000);
    sum.u += std::abs(there.u) / 2;
    sum.v += std::abs(there.v) / 2;
  }
  const UvSteps absent;
  return {sum.u == 0 ? absent.u : sum.u, sum.v == 0 ? absent.v : sum.v};
}

SurfacePoint WithBumpMaps(const SceneDescription& scene, const Material& material,
                          const SurfacePoint& at, Vec3d wo, const TextureLookup& texture,
                          const NormalMapLookup& normal_map) {
  const bool mapped = !material.normal_map.empty();
  if (!mapped && material.displacement.texture == kNone) return at;
  SurfacePoint out =
      mapped ? Mapped(material, at, normal_map) : Bumped(scene, material, at, texture);
  if (Dot(out.ns, at.ng) < 0) out.ns = -out.ns;
  out.ns = KeepInView(out.ns, at.ng, wo, OnlyMirrorsOrRefracts(material.kind));
  return out;
}

}  // namespace lanelight::reference

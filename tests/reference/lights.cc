#include "tests/reference/lights.h"

#include <map>
#include <numbers>
#include <utility>

#include "src/core/check.h"

namespace lanelight::reference {
namespace {

constexpr double kPi = std::numbers::pi;

Vec3d UniformOnSphere(Random& random) {
  // Archimedes: the height of a uniform point on the sphere is uniform.
  const double z = 1 - 2 * random.Uniform();
  const double r = std::sqrt(std::max(0.0, 1 - z * z)), phi = 2 * kPi * random.Uniform();
  return {r * std::cos(phi), r * std::sin(phi), z};
}

// A point uniform by area, and the outer normal there.
std::pair<Vec3d, Vec3d> SamplePoint(const Primitive& shape, Random& random) {
  if (shape.kind == ShapeKind::kMesh) {
    // Uniform in the unit square, folded onto the triangle.
    double a = random.Uniform(), b = random.Uniform();
    if (a + b > 1) a = 1 - a, b = 1 - b;
    Vec3d normal = shape.face_normal;
    if (shape.n) {
      const auto& n = *shape.n;
      if (Dot(normal, (1 - a - b) * n[0] + a * n[1] + b * n[2]) < 0) normal = -normal;
    }
    const auto& p = shape.p;
    return {p[0] + a * (p[1] - p[0]) + b * (p[2] - p[0]), normal};
  }
  Vec3d o, n = {0, 0, 1};
  const double phi = shape.phi_max * random.Uniform();
  const double z = shape.z_min + (shape.z_max - shape.z_min) * random.Uniform();
  if (shape.kind == ShapeKind::kSphere) {
    const double across = std::sqrt(std::max(0.0, shape.radius * shape.radius - z * z));
    o = {across * std::cos(phi), across * std::sin(phi), z};
    n = o / shape.radius;
  } else if (shape.kind == ShapeKind::kCylinder) {
    n = {std::cos(phi), std::sin(phi), 0};
    o = {shape.radius * n.x, shape.radius * n.y, z};
  } else {
    // Between r0 and r1 the area inside radius r grows as r^2.
    const double r0 = shape.inner_radius, r1 = shape.radius;
    const double r = std::sqrt(r0 * r0 + random.Uniform() * (r1 * r1 - r0 * r0));
    o = {r * std::cos(phi), r * std::sin(phi), shape.height};
  }
  const Vec3d normal = Normalize(shape.world_from_object.Normal(n));
  return {shape.world_from_object.Point(o), shape.normal_sign * normal};
}

// Falls from 1 to 0 between the two cosines along a cubic with flat ends.
double SpotFalloff(double cosine, double cos_zero, double cos_full) {
  if (cosine <= cos_zero) return 0;
  if (cosine >= cos_full) return 1;
  const double x = (cosine - cos_zero) / (cos_full - cos_zero);
  return x * x * (3 - 2 * x);
}

}  // namespace

double PrimitiveArea(const Primitive& shape) {
  if (shape.kind == ShapeKind::kMesh) {
    return Length(Cross(shape.p[1] - shape.p[0], shape.p[2] - shape.p[0])) / 2;
  }
  const double scale = shape.world_from_object.UniformScale();
  LL_CHECK(scale > 0);
  LL_CHECK(shape.kind != ShapeKind::kPlane);
  const double r = shape.radius, inner = shape.inner_radius;
  // The lateral area of a cylinder is that of the sphere inside, slice by slice.
  const double unit = shape.kind == ShapeKind::kDisk
                          ? shape.phi_max / 2 * (r * r - inner * inner)
                          : shape.phi_max * r * (shape.z_max - shape.z_min);
  return unit * scale * scale;
}

Lights::Lights(const SceneDescription& scene, const Geometry& geometry,
               EnvironmentLookup environment)
    : scene_(scene), geometry_(geometry), environment_(std::move(environment)) {
  // A given power is that of the whole shape: the triangles of a mesh share it.
  std::map<int, double> shape_area;
  for (const Primitive& shape : geometry.primitives()) {
    if (shape.area_light != kNone) shape_area[shape.shape] += PrimitiveArea(shape);
  }
  for (int i = 0; i < static_cast<int>(geometry.primitives().size()); ++i) {
    const Primitive& shape = geometry.primitives()[i];
    emitter_of_.push_back(kNone);
    if (shape.area_light == kNone) continue;
    const AreaLight& light = scene.area_lights[shape.area_light];
    Rgb radiance = light.radiance * light.scale;
    if (light.power > 0) {
      const double sides = light.two_sided ? 2 : 1;
      radiance *=
          light.power / (kPi * sides * shape_area[shape.shape] * Luminance(radiance));
    }
    emitter_of_.back() = static_cast<int>(emitters_.size());
    emitters_.push_back({i, PrimitiveArea(shape), radiance, light.two_sided});
  }
  for (Index i = 0; i < static_cast<Index>(scene.lights.size()); ++i) {
    if (scene.lights[i].kind == LightKind::kInfinite) infinite_.push_back(i);
  }
}

Rgb Lights::Emitted(int primitive, const SurfacePoint& at, Vec3d toward) const {
  if (emitter_of_[primitive] == kNone) return {};
  const Emitter& emitter = emitters_[emitter_of_[primitive]];
  return emitter.two_sided || Dot(at.ng, toward) > 0 ? emitter.radiance : Rgb{};
}

Rgb Lights::InfiniteRadiance(Index index, Vec3d toward) const {
  const Light& light = scene_.lights[index];
  if (light.image_path.empty()) return light.emission;
  LL_CHECK(environment_ != nullptr);
  LL_CHECK(light.illuminance <= 0);
  const Vec3d local = Normalize(light.world_from_light.Inverse().Vector(toward));
  return environment_(index, local) * light.image_scale;
}

Rgb Lights::Environment(Vec3d toward) const {
  Rgb sum;
  for (Index index : infinite_) sum += InfiniteRadiance(index, toward);
  return sum;
}

std::vector<LightConnection> Lights::DeltaLights(Vec3d p) const {
  std::vector<LightConnection> out;
  for (const Light& light : scene_.lights) {
    const Transform& world = light.world_from_light;
    if (light.kind == LightKind::kInfinite) continue;
    if (light.kind == LightKind::kDistant) {
      const Vec3d toward = Normalize(world.Vector(light.from - light.to));
      out.push_back({toward, kInfinity, light.emission});
      continue;
    }
    const Vec3d delta = world.Point(light.from) - p;
    const double distance = Length(delta);
    Rgb irradiance = light.emission / (distance * distance);
    if (light.kind == LightKind::kSpot) {
      const Vec3d axis = Normalize(light.to - light.from);
      const double cosine = Dot(axis, Normalize(world.Inverse().Vector(-delta)));
      irradiance *=
          SpotFalloff(cosine, std::cos(light.cone_angle * kPi / 180),
                      std::cos((light.cone_angle - light.cone_delta) * kPi / 180));
    }
    if (irradiance == Rgb{}) continue;
    out.push_back({delta / distance, distance, irradiance});
  }
  return out;
}

LightConnection Lights::SampleEmitter(const Emitter& emitter, Vec3d p,
                                      Random& random) const {
  const auto [point, normal] =
      SamplePoint(geometry_.primitives()[emitter.primitive], random);
  const Vec3d delta = point - p;
  const double distance = Length(delta);
  LightConnection out = {delta / distance, distance, {}};
  const double cosine = -Dot(normal, out.toward);
  if (!(distance > 0) || (cosine <= 0 && !emitter.two_sided)) return out;
  // domega = cos dA / distance^2.
  out.radiance =
      emitter.radiance * (std::abs(cosine) * emitter.area / (distance * distance));
  return out;
}

std::vector<LightConnection> Lights::AreaLights(Vec3d p, Random& random) const {
  std::vector<LightConnection> out;
  for (const Emitter& emitter : emitters_) {
    const LightConnection sample = SampleEmitter(emitter, p, random);
    if (!(sample.radiance == Rgb{})) out.push_back(sample);
  }
  for (Index index : infinite_) {
    const Vec3d toward = UniformOnSphere(random);
    out.push_back({toward, kInfinity, 4 * kPi * InfiniteRadiance(index, toward)});
  }
  return out;
}

}  // namespace lanelight::reference

#include "tests/reference/lights.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "src/base/core/check.h"
#include "src/base/core/pi.h"
#include "src/base/image/octahedral.h"

namespace lanelight::reference {
namespace {

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
  // A given power is that of each face.
  std::map<int, double> face_area;
  for (const Primitive& shape : geometry.primitives()) {
    if (shape.area_light != kNone) face_area[shape.face] += PrimitiveArea(shape);
  }
  for (int i = 0; i < static_cast<int>(geometry.primitives().size()); ++i) {
    const Primitive& shape = geometry.primitives()[i];
    emitter_of_.push_back(kNone);
    if (shape.area_light == kNone) continue;
    const AreaLight& light = scene.area_lights[shape.area_light];
    Rgb radiance = light.radiance * light.scale;
    if (light.power > 0) {
      const double sides = light.two_sided ? 2 : 1;
      radiance *= light.power / (kPi * sides * face_area[shape.face]);
    }
    Index image = kNone;
    if (!light.image_path.empty()) {
      LL_CHECK(light.power <= 0);
      image = AddImage(light.image_path, WrapMode::kClamp, true);
    }
    emitter_of_.back() = static_cast<int>(emitters_.size());
    emitters_.push_back({i, PrimitiveArea(shape), radiance, light.two_sided, image});
  }
  for (Index i = 0; i < static_cast<Index>(scene.lights.size()); ++i) {
    const Light& light = scene.lights[i];
    if (light.kind == LightKind::kInfinite) infinite_.push_back(i);
    const bool portal = !light.portal.empty();
    const bool directions = light.kind == LightKind::kGoniometric || portal;
    const bool mine = directions || light.kind == LightKind::kProjection;
    light_images_.push_back(kNone);
    if (!mine || light.image_path.empty()) continue;
    LL_CHECK(light.power <= 0);
    light_images_.back() =
        AddImage(light.image_path,
                 directions ? WrapMode::kOctahedralSphere : WrapMode::kClamp, portal);
  }
  textures_ = std::make_unique<Textures>(images_);
}

Index Lights::AddImage(const std::string& path, WrapMode wrap, bool bilinear) {
  Texture image;
  image.kind = TextureKind::kImage;
  image.path = path;
  image.wrap = wrap;
  image.bilinear = bilinear;
  images_.push_back(image);
  return static_cast<Index>(images_.size()) - 1;
}

Rgb Lights::EmittedAt(const Emitter& emitter, double u, double v) const {
  if (emitter.image == kNone) return emitter.radiance;
  return emitter.radiance * textures_->Eval(emitter.image, u, v);
}

Rgb Lights::Emitted(int primitive, const SurfacePoint& at, Vec3d toward) const {
  if (emitter_of_[primitive] == kNone) return {};
  const Emitter& emitter = emitters_[emitter_of_[primitive]];
  return emitter.two_sided || Dot(at.ng, toward) > 0 ? EmittedAt(emitter, at.u, at.v)
                                                     : Rgb{};
}

// Returns whether a ray leaves through the rectangle, on the side that its corners turn
// to the left around.
bool PassesThrough(const std::vector<Vec3d>& corners, Vec3d p, Vec3d d) {
  const Vec3d x = corners[3] - corners[0], y = corners[1] - corners[0], n = Cross(x, y);
  const double ahead = Dot(corners[0] - p, n);
  if (!(Dot(d, n) > 0 && ahead > 0)) return false;
  const Vec3d q = p + d * (ahead / Dot(d, n)) - corners[0];
  const double a = Dot(q, x) / Dot(x, x), b = Dot(q, y) / Dot(y, y);
  return a >= 0 && a <= 1 && b >= 0 && b <= 1;
}

// The map at the middle of a cell of angles about the portal's axes.
Rgb Lights::PortalRadiance(const Light& light, Index image, Vec3d p, Vec3d toward) const {
  if (!PassesThrough(light.portal, p, toward)) return {};
  if (image == kNone) return light.emission;
  const Vec3d x = Normalize(light.portal[3] - light.portal[0]);
  const Vec3d y = Normalize(light.portal[1] - light.portal[0]), z = Cross(x, y);
  const int n = textures_->Size(image);
  const auto middle = [&](double along) {
    const double turn = std::atan2(along, Dot(toward, z)) / kPi + 0.5;
    return std::tan(((std::floor(turn * n) + 0.5) / n - 0.5) * kPi);
  };
  const Vec3d w = x * middle(Dot(toward, x)) + y * middle(Dot(toward, y)) + z;
  const Vec3d local = Normalize(light.world_from_light.Inverse().Vector(w));
  const auto [s, t] = DirectionToOctahedral(local);
  return textures_->Eval(image, s, 1 - t) * light.image_scale;
}

std::array<double, 2> GoniometricPlace(Vec3d d) {
  const double ring = std::sqrt(std::max(0.0, 1 - std::abs(d.y)));
  const double phi = std::atan2(std::abs(d.z), std::abs(d.x)) * (2 / kPi);
  double v = phi * ring, u = ring - v;
  if (d.y < 0) std::tie(u, v) = std::pair{1 - v, 1 - u};
  return {(std::copysign(u, d.x) + 1) / 2, (std::copysign(v, d.z) + 1) / 2};
}

Rgb Lights::PointIntensity(Index index, Vec3d away) const {
  const Light& light = scene_.lights[index];
  const Vec3d local = light.world_from_light.Inverse().Vector(Normalize(away));
  const Vec3d d = Normalize(local);
  if (light.kind == LightKind::kGoniometric) {
    const auto [s, t] = GoniometricPlace(local);
    const Rgb value = textures_->Eval(light_images_[index], s, 1 - t);
    return light.emission * ((value.x + value.y + value.z) / 3);
  }
  if (light.kind == LightKind::kProjection) {
    const auto [width, height] = textures_->Resolution(light_images_[index]);
    const double unit = std::tan(light.fov * kPi / 360) / std::min(width, height);
    const double s = d.x / d.z / (unit * width), t = d.y / d.z / (unit * height);
    if (!(d.z > 0) || std::abs(s) > 1 || std::abs(t) > 1) return {};
    return light.emission *
           textures_->Eval(light_images_[index], (1 + s) / 2, (1 + t) / 2);
  }
  if (light.kind == LightKind::kPoint) return light.emission;
  const Vec3d axis = Normalize(light.to - light.from);
  return light.emission *
         SpotFalloff(Dot(axis, d), std::cos(light.cone_angle * kPi / 180),
                     std::cos((light.cone_angle - light.cone_delta) * kPi / 180));
}

Rgb Lights::InfiniteRadiance(Index index, Vec3d p, Vec3d toward) const {
  const Light& light = scene_.lights[index];
  if (!light.portal.empty()) {
    return PortalRadiance(light, light_images_[index], p, toward);
  }
  if (light.image_path.empty()) return light.emission;
  LL_CHECK(environment_ != nullptr);
  LL_CHECK(light.illuminance <= 0);
  const Vec3d local = Normalize(light.world_from_light.Inverse().Vector(toward));
  return environment_(index, local) * light.image_scale;
}

Rgb Lights::Environment(Vec3d p, Vec3d toward) const {
  Rgb sum;
  for (Index index : infinite_) sum += InfiniteRadiance(index, p, toward);
  return sum;
}

std::vector<LightConnection> Lights::DeltaLights(Vec3d p) const {
  std::vector<LightConnection> out;
  for (Index i = 0; i < static_cast<Index>(scene_.lights.size()); ++i) {
    const Light& light = scene_.lights[i];
    const Transform& world = light.world_from_light;
    if (light.kind == LightKind::kInfinite) continue;
    if (light.kind == LightKind::kDistant) {
      const Vec3d toward = Normalize(world.Vector(light.from - light.to));
      out.push_back({toward, kInfinity, light.emission});
      continue;
    }
    const Vec3d delta = world.Point(light.from) - p;
    const double distance = Length(delta);
    const Rgb irradiance = PointIntensity(i, -delta) / (distance * distance);
    if (irradiance == Rgb{}) continue;
    out.push_back({delta / distance, distance, irradiance});
  }
  return out;
}

bool Lights::IsUnseen(const Emitter& emitter) const {
  const FloatValue& alpha = geometry_.primitives()[emitter.primitive].alpha;
  return alpha.texture == kNone && alpha.constant <= 0;
}

// Neither pictured nor cut.
bool Lights::IsEven(const Emitter& emitter) const {
  const FloatValue& alpha = geometry_.primitives()[emitter.primitive].alpha;
  return emitter.image == kNone && alpha.texture == kNone && alpha.constant >= 1;
}

// Of the point where the ray meets the emitter at that distance: the share that alpha
// leaves. Of one that is not met, all but what would be behind it.
Rgb Lights::RadianceAt(const Emitter& emitter, const Ray& ray, double distance) const {
  if (IsEven(emitter)) return emitter.radiance;
  Hit hits[2];
  const Primitive& shape = geometry_.primitives()[emitter.primitive];
  const int count = IntersectPrimitive(shape, ray, false, hits);
  if (count == 0) return {};  // at an edge
  const bool second =
      count > 1 && std::abs(hits[1].t - distance) < std::abs(hits[0].t - distance);
  Hit hit = hits[second ? 1 : 0];
  hit.primitive = emitter.primitive;
  const SurfacePoint at = geometry_.Describe(ray, hit);
  const double left = IsUnseen(emitter) ? (second ? 0 : 1)
                                        : std::clamp(geometry_.Alpha(ray, hit), 0.0, 1.0);
  return EmittedAt(emitter, at.u, at.v) * left;
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
  out.radiance = RadianceAt(emitter, {p, out.toward, kNone}, distance) *
                 (std::abs(cosine) * emitter.area / (distance * distance));
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
    out.push_back({toward, kInfinity, 4 * kPi * InfiniteRadiance(index, p, toward)});
  }
  return out;
}

std::vector<LightConnection> Lights::UnseenLights(Vec3d p, Random& random) const {
  std::vector<LightConnection> out;
  for (const Emitter& emitter : emitters_) {
    if (IsUnseen(emitter)) out.push_back(SampleEmitter(emitter, p, random));
  }
  return out;
}

double Lights::PowerOf(const Emitter& emitter) const {
  return kPi * emitter.area * Luminance(emitter.radiance) * (emitter.two_sided ? 2 : 1);
}

std::optional<EmittedPoint> Lights::SampleEmission(Random& random) const {
  double power = 0;
  for (const Emitter& emitter : emitters_) power += PowerOf(emitter);
  double left = power * random.Uniform();
  for (const Emitter& emitter : emitters_) {
    left -= PowerOf(emitter);
    if (left > 0) continue;
    if (EmissionDensity(emitter.primitive) == 0) return std::nullopt;
    const auto [p, n] = SamplePoint(geometry_.primitives()[emitter.primitive], random);
    const bool back = emitter.two_sided && random.Uniform() < 0.5;
    return EmittedPoint{emitter.primitive, p, back ? -n : n};
  }
  return std::nullopt;
}

int Lights::Sides(int primitive) const {
  return emitters_[emitter_of_[primitive]].two_sided ? 2 : 1;
}

double Lights::EmissionDensity(int primitive) const {
  if (emitter_of_[primitive] == kNone) return 0;
  const Emitter& emitter = emitters_[emitter_of_[primitive]];
  if (emitter.image != kNone) return 0;
  double power = 0;
  for (const Emitter& other : emitters_) power += PowerOf(other);
  return PowerOf(emitter) / power / emitter.area;
}

}  // namespace lanelight::reference

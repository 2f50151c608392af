// Large spheres against extended precision: distances, leaving, alpha, normals.
#include <catch2/catch.hpp>

#include "kernels/stages.h"
#include "tests/kernels/intersect/trace.h"
#include "tests/support/brute_force.h"
#include "tests/support/each_target.h"

namespace lanelight {
namespace {

using brute::Random;

LargeSphereRecord MakeLargeSphere(Vec3f point, Vec3f normal, float radius) {
  const Vec3f n = Normalize(normal);
  LargeSphereRecord s{};
  for (int i = 0; i < 3; ++i) s.point[i] = point[i], s.normal[i] = n[i];
  s.curvature = 1 / radius;
  s.x_axis[0] = s.z_axis[2] = s.y_sign = s.normal_sign = 1;
  s.light = -1;
  return s;
}

// Nearest distance > 0 on the record's own sphere; also how steeply it is met.
struct SphereTruth {
  long double t = std::numeric_limits<long double>::infinity(), sine = 0;
};
SphereTruth TruthOf(const LargeSphereRecord& s, const TestRay& ray) {
  long double a = 0, b = 0, c = 0;
  for (int i = 0; i < 3; ++i) {
    const long double q = static_cast<long double>(ray.o[i]) - s.point[i];
    const long double d = ray.d[i], k = s.curvature, m = s.normal[i];
    a += k * d * d;
    b += (m + k * q) * d;
    c += q * (2 * m + k * q);
  }
  const long double discriminant = b * b - a * c;
  if (discriminant < 0) return {};
  const long double root = std::sqrt(discriminant);
  const long double sum = -(b + std::copysign(root, b));
  const long double t0 = std::min(c / sum, sum / a), t1 = std::max(c / sum, sum / a);
  return {t0 > 0 ? t0 : t1 > 0 ? t1 : SphereTruth{}.t, root};
}

const std::vector<StageOn> kClosestLarge = {IntersectLargeSpheresStage};
const std::vector<StageOn> kShadowLarge = {ShadowLargeSpheresStage};

std::vector<TestRay> RaysAbout(const LargeSphereRecord& s, Random& random, float height) {
  const Vec3f point{s.point[0], s.point[1], s.point[2]};
  const Vec3f normal{s.normal[0], s.normal[1], s.normal[2]};
  std::vector<TestRay> rays;
  for (int i = 0; i < 600; ++i) {
    const float side = i % 5 == 0 ? -1.0f : 1.0f;  // some from within
    const Vec3f o = point + (side * height * random(0.5f, 2)) * normal +
                    height * random.Point(i % 2 ? 1.0f : 30.0f);
    rays.push_back({o, random.Direction()});
  }
  return rays;
}

}  // namespace

TEST_CASE("large spheres agree with extended precision", "[intersect]") {
  const EachTarget target;
  Random random(71);
  for (const float radius : {1e2f, 1e4f, 1e6f, 1e8f, 1e12f}) {
    for (const float height : {1e-3f, 1.0f}) {
      Geometry g;
      g.large_spheres = {MakeLargeSphere(random.Point(1), random.Direction(), radius)};
      const CompiledScene scene = MakeScene(std::move(g));
      const auto rays = RaysAbout(scene.geometry.large_spheres[0], random, height);
      const auto hits = TraceClosest(scene, rays, kClosestLarge);
      int compared = 0;
      std::vector<std::uint32_t> open;
      for (std::uint32_t i = 0; i < rays.size(); ++i) {
        if (std::isinf(hits[i].t)) open.push_back(i);
        const SphereTruth truth = TruthOf(scene.geometry.large_spheres[0], rays[i]);
        // Grazing rays are ill-posed in float, and far hits beyond the ground's curve.
        if (truth.sine < 1e-2L) continue;
        ++compared;
        CAPTURE(radius, height, i, double(truth.t), hits[i].t);
        REQUIRE(std::isinf(truth.t) == std::isinf(hits[i].t));
        if (std::isinf(truth.t)) continue;
        // Off the sphere: 8 roundings of the way to the origin, and along the ray.
        const LargeSphereRecord& r = scene.geometry.large_spheres[0];
        const double way = Length(rays[i].o - Vec3f{r.point[0], r.point[1], r.point[2]});
        const double off = std::abs(hits[i].t - double(truth.t)) * double(truth.sine);
        REQUIRE(off < 8 * 0x1p-24 * (way + double(truth.t)));
      }
      CHECK(compared > 400);
      CHECK(Unoccluded(scene, rays, kShadowLarge) == open);
    }
  }
}

TEST_CASE("rays that leave a large sphere do not meet it again", "[surface]") {
  const FeatureSet features = {Feature::kScatters};
  const EachTarget target;
  Random random(72);
  int tried = 0, without_offset = 0;
  for (const float radius : {1e2f, 1e5f, 1e8f, 1e12f}) {
    for (const float factor : {1.0f, 0.0f}) {
      Geometry g;
      g.large_spheres = {MakeLargeSphere(random.Point(1), random.Direction(), radius)};
      const CompiledScene scene = MakeScene(std::move(g));
      const auto rays = RaysAbout(scene.geometry.large_spheres[0], random, 1);
      WaveFixture f(scene, static_cast<std::uint32_t>(rays.size()));
      f.SetRays(rays);
      f.Run(kClosestLarge[0], features);
      const PathColumns& p = f.wave.path;
      Queue& surface = f.wave.queue(QueueId::kSurface);
      surface.size = 0;
      for (std::uint32_t i = 0; i < rays.size(); ++i) {
        if (!std::isinf(p.t[i])) surface.items[surface.size++] = i;
      }
      f.Run(SurfaceLargeSphereStage, features);
      Queue& shadow = f.wave.queue(QueueId::kShadow);
      shadow.size = 0;
      for (std::uint32_t k = 0; k < surface.size; ++k) {
        const std::uint32_t i = surface.items[k];
        Vec3f d = random.Direction();
        if (std::abs(Dot(d, f.Ng(i))) < 1e-4f) continue;
        if (Dot(d, f.Ng(i)) < 0) d = -d;
        p.ls_x[i] = d.x, p.ls_y[i] = d.y, p.ls_z[i] = d.z;
        p.ls_distance[i] = std::numeric_limits<float>::infinity();
        p.p_error[i] *= factor;
        shadow.items[shadow.size++] = i;
      }
      const std::uint32_t before = shadow.size;
      f.Run(kShadowLarge[0], features);
      CAPTURE(radius, factor);
      if (factor == 1) CHECK(shadow.size == before);
      if (factor == 1) tried += static_cast<int>(before);
      if (factor == 0) without_offset += static_cast<int>(before - shadow.size);
    }
  }
  CHECK(tried > 1000);
  CHECK(without_offset > 100);  // the check has power
}

TEST_CASE("large spheres have the surface of an ordinary one", "[surface]") {
  const FeatureSet features = {Feature::kScatters, Feature::kUv, Feature::kTangents};
  const EachTarget target;
  Random random(73);
  // The same sphere of radius 8 in both forms.
  const Vec3f n = random.Direction(), center{0.3f, 0.1f, -0.2f};
  Geometry large, ordinary;
  large.large_spheres = {MakeLargeSphere(center + 8.0f * n, n, 8)};
  ordinary.spheres = {MakeSphere(center, 8)};
  const CompiledScene scenes[] = {MakeScene(std::move(large)),
                                  MakeScene(std::move(ordinary))};
  std::vector<TestRay> rays;
  for (int i = 0; i < 300; ++i) {
    const Vec3f o = center + 20.0f * random.Direction();
    rays.push_back({o, Normalize(center + 2.0f * random.Direction() - o)});
  }
  std::vector<Vec3f> found[2];
  std::vector<float> numbers[2];
  for (const int k : {0, 1}) {
    WaveFixture f(scenes[k], 300);
    f.SetRays(rays);
    f.Run(k ? IntersectSpheresStage : IntersectLargeSpheresStage, features);
    f.QueueAll(QueueId::kSurface, 300);
    f.Run(k ? SurfaceSphereStage : SurfaceLargeSphereStage, features);
    const PathColumns& p = f.wave.path;
    for (std::uint32_t i = 0; i < 300; ++i) {
      found[k].insert(found[k].end(), {f.P(i), f.Ng(i)});
      found[k].push_back({p.tg_x[i] / 50, p.tg_y[i] / 50, p.tg_z[i] / 50});
      // dp/dv turns fast about the poles.
      const Vec3f tv = {p.tv_x[i] / 25, p.tv_y[i] / 25, p.tv_z[i] / 25};
      found[k].push_back(std::abs(f.Ng(i).z) > 0.99f ? Vec3f{} : tv);
      numbers[k].insert(numbers[k].end(), {p.t[i], p.uv_u[i], p.uv_v[i]});
    }
  }
  for (std::size_t i = 0; i < found[0].size(); ++i) {
    CAPTURE(i);
    REQUIRE(Length(found[0][i] - found[1][i]) < 2e-5f);
  }
  for (std::size_t i = 0; i < numbers[0].size(); ++i) {
    CAPTURE(i);
    const float apart = std::abs(numbers[0][i] - numbers[1][i]);
    REQUIRE(std::min(apart, std::abs(1 - apart)) < 2e-5f);  // u turns round
  }
}

}  // namespace lanelight

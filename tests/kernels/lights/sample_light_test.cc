// Light samples: direction, distance, density and radiance of every shape of light
// against plain formulas, and the densities against the solid angles that they cover.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "kernels/stages.h"
#include "src/base/core/check.h"
#include "tests/kernels/lights/light_truth.h"
#include "tests/support/each_target.h"
#include "tests/support/wave_fixture.h"

namespace lanelight::test {
namespace {

constexpr std::uint32_t kSamples = 2003;
constexpr float kError = 1e-6f;

StageOn StageOf(LightShape shape) {
  switch (shape) {
    case LightShape::kTriangle:
      return SampleTriangleLightStage;
    case LightShape::kRectangle:
      return SampleRectangleLightStage;
    case LightShape::kSphere:
      return SampleSphereLightStage;
    case LightShape::kDisk:
      return SampleDiskLightStage;
    case LightShape::kPoint:
      return SamplePointLightStage;
    case LightShape::kSpot:
      return SampleSpotLightStage;
    case LightShape::kDistant:
      return SampleDistantLightStage;
    case LightShape::kInfiniteConstant:
      return SampleInfiniteConstantStage;
    case LightShape::kInfiniteImage:
      break;
    case LightShape::kGoniometric:  // image_lights_test.cc
    case LightShape::kProjection:
    case LightShape::kPortal:
    case LightShape::kCount:
      LL_CHECK(false);
  }
  return SampleInfiniteImageStage;
}

// Receivers with a selected light each; every light stage runs, as in a plan.
struct Samples {
  const LightScene& lights;
  WaveFixture fixture;
  bool solid_angle = false;

  // tree: the probability of the selection comes with the path.
  Samples(const LightScene& l, std::uint32_t count, bool tree)
      : lights(l), fixture(l.Parts(), count) {
    PathColumns& p = fixture.wave.path;
    if (!tree) p.light_pmf = nullptr;
    std::mt19937 engine(31);
    std::uniform_real_distribution<float> place(-2, 2);
    for (std::uint32_t i = 0; i < count; ++i) {
      Place(i, {place(engine), place(engine), place(engine)});
      p.u_light_0[i] = static_cast<float>(engine() >> 8) * 0x1p-24f;
      p.u_light_1[i] = static_cast<float>(engine() >> 8) * 0x1p-24f;
      p.ls_light[i] = engine() % static_cast<std::uint32_t>(l.lights.size());
      if (tree) p.light_pmf[i] = 0.01f + 0.9f * (i % 17) / 17;
      p.ls_pdf[i] = p.ls_r[i] = p.ls_g[i] = p.ls_b[i] = -1;
    }
    fixture.QueueAll(QueueId::kLit, count);
  }
  void Place(std::uint32_t i, Vec3f at) {
    PathColumns& p = fixture.wave.path;
    p.p_x[i] = at.x, p.p_y[i] = at.y, p.p_z[i] = at.z, p.p_error[i] = kError;
  }
  void Run() {
    FeatureSet features;
    if (lights.lights.size() > 1) features.Add(Feature::kManyLights);
    if (solid_angle) features.Add(Feature::kSolidAngleLights);
    for (int s = 0; s <= static_cast<int>(LightShape::kRectangle); ++s) {
      const auto shape = static_cast<LightShape>(s);
      const bool has = std::any_of(lights.lights.begin(), lights.lights.end(),
                                   [&](const NamedLight& light) {
                                     return static_cast<int>(light.record.shape) == s;
                                   });
      if (has) fixture.Run(StageOf(shape), features);
    }
  }
  const NamedLight& LightOf(std::uint32_t i) const {
    const bool many = lights.lights.size() > 1;
    return lights.lights[many ? fixture.wave.path.ls_light[i] : 0];
  }
  double Pmf(std::uint32_t i) const {
    const float* by_path = fixture.wave.path.light_pmf;
    return by_path != nullptr ? by_path[i] : LightOf(i).pmf;
  }
  Vec3d Direction(std::uint32_t i) const {
    const PathColumns& p = fixture.wave.path;
    return {p.ls_x[i], p.ls_y[i], p.ls_z[i]};
  }
};

// The shadow ray ends in front of the light, but not far in front: by the rounding of
// both points, and where a ray grazes a sphere, of the square root.
void CheckDistance(const Samples& s, std::uint32_t i, const VisibleLight& seen) {
  const double distance = s.fixture.wave.path.ls_distance[i];
  const auto shape = static_cast<LightShape>(s.LightOf(i).record.shape);
  if (std::isinf(seen.distance) || shape == LightShape::kPoint ||
      shape == LightShape::kSpot) {
    const double want = seen.distance;
    CHECK((distance == want || distance == Approx(want).epsilon(1e-6)));
    return;
  }
  CHECK(distance < seen.distance);
  const double gap = shape == LightShape::kSphere ? 0.01 : 1e-4 / seen.cosine;
  CHECK(distance > seen.distance * 0.5);
  CHECK(distance > seen.distance - std::max(gap, 1e-4));
}

void CheckSample(const Samples& s, std::uint32_t i) {
  const PathColumns& p = s.fixture.wave.path;
  const NamedLight& light = s.LightOf(i);
  const Vec3d from = {p.p_x[i], p.p_y[i], p.p_z[i]}, w = s.Direction(i);
  const VisibleLight seen =
      FindVisibleLight(s.lights.scene, light.record, from, Normalize(w), s.solid_angle);
  const auto shape = static_cast<LightShape>(light.record.shape);
  INFO(light.name << ", path " << i << ", cosine " << seen.cosine);
  CHECK(Length(w) == Approx(1).epsilon(1e-6));
  if (!seen.met && shape == LightShape::kInfiniteImage) return;  // on a texel's edge
  if (seen.cosine < 1e-4) return;  // a receiver in the plane of the light
  CHECK(seen.met);
  CheckDistance(s, i, seen);
  // The kernel aims a little in front of a surface, by what the rounding of both points
  // may be: about 1e-5 here, which counts where the surface is near or seen edge-on.
  const bool area = shape <= LightShape::kDisk || shape == LightShape::kRectangle;
  const double height = seen.distance * seen.cosine;
  const double tolerance = 2e-5 + (area ? 5e-5 / height : 0);
  const double pdf = s.Pmf(i) * seen.pdf;
  CHECK(p.ls_pdf[i] == Approx(pdf).epsilon(tolerance));
  const double divisor = seen.pdf > 0 ? pdf : s.Pmf(i);
  const float* columns[3] = {p.ls_r, p.ls_g, p.ls_b};
  for (int c = 0; c < 3; ++c) {
    const double want = seen.facing ? seen.radiance[c] / divisor : 0;
    CHECK(columns[c][i] == Approx(want).epsilon(tolerance).margin(1e-5 * divisor));
  }
}

void CheckAll(const LightScene& lights, bool tree) {
  for (const bool solid_angle : {false, true}) {
    Samples s(lights, kSamples, tree);
    s.solid_angle = solid_angle;
    s.Run();
    for (std::uint32_t i = 0; i < kSamples; ++i) CheckSample(s, i);
  }
}

// The means of 1 / density and of direction / density over even sample points: multiples
// of the powers of the plastic number, modulo 1 (Roberts 2018), whose error falls nearly
// with their number.
SolidAngle Covered(const LightScene& one, Vec3f from, bool solid_angle) {
  constexpr std::uint32_t kPoints = 1 << 17;
  constexpr double kPlastic = 1.32471795724474602596;
  Samples s(one, kPoints, false);
  s.solid_angle = solid_angle;
  PathColumns& p = s.fixture.wave.path;
  const auto place = [](double v) {
    return static_cast<float>(std::floor((v - std::floor(v)) * 0x1p24) * 0x1p-24);
  };
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    s.Place(i, from);
    p.u_light_0[i] = place(0.5 + i / kPlastic);
    p.u_light_1[i] = place(0.5 + i / kPlastic / kPlastic);
  }
  s.Run();
  SolidAngle sum;
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    const double weight = s.Pmf(i) / (double(p.ls_pdf[i]) * kPoints);
    sum.steradians += weight;
    sum.moment += s.Direction(i) * weight;
  }
  return sum;
}

// A point that sees the light: of the axis of a disk.
Vec3f Viewpoint(const LightScene& one) {
  const LightRecord& light = one.lights[0].record;
  if (static_cast<LightShape>(light.shape) != LightShape::kDisk)
    return {0.3f, -0.2f, 0.1f};
  const Geometry& g = one.scene.geometry;
  const DiskRecord& disk = g.disks[light.primitive - g.ranges.disks];
  const auto at = [&](int k) { return disk.center[k] + 1.5f * disk.normal[k]; };
  return {at(0), at(1), at(2)};
}

}  // namespace

TEST_CASE("light samples agree with closed formulas", "[lights]") {
  const EachTarget target;
  const LightScene all;
  CheckAll(all, false);  // with the widest vectors: records in registers
  CheckAll(all, true);   // the probability of each path, as a tree selects
  LightScene more;
  more.AddOthers(50);
  CheckAll(more, false);  // records gathered
  for (std::size_t i = 0; i < all.lights.size(); ++i) {
    LightScene one;
    one.Keep(i);
    CheckAll(one, false);  // nothing to select
  }
}

TEST_CASE("densities of light samples cover the solid angle of the light", "[lights]") {
  const LightScene all;
  const EachTarget target;
  for (std::size_t i = 0; i < all.lights.size(); ++i) {
    LightScene one;
    one.Keep(i);
    const LightRecord& light = one.lights[0].record;
    const auto shape = static_cast<LightShape>(light.shape);
    if (shape == LightShape::kPoint || shape == LightShape::kSpot ||
        shape == LightShape::kDistant) {
      continue;
    }
    const Vec3f from = Viewpoint(one);
    const SolidAngle want = SolidAngleOf(one.scene, light, VecCast<double>(from));
    for (const bool solid_angle : {false, true}) {
      const SolidAngle covered = Covered(one, from, solid_angle);
      CAPTURE(one.lights[0].name, want.steradians, solid_angle);
      // The error of so many points; samples that are not as dense as they say are off
      // by far more.
      CHECK(covered.steradians == Approx(want.steradians).epsilon(1e-3));
      CHECK(Length(covered.moment - want.moment) < 1e-3 * want.steradians);
    }
  }
}

}  // namespace lanelight::test

// Light that rays hit: emission of every shape and of the environments, weighted against
// the density with which light sampling would have found it; and the choice of lights.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "kernels/stages.h"
#include "src/scene/prepare/parameters.h"
#include "src/scene/prepare/prepared_scene.h"
#include "tests/kernels/lights/light_truth.h"
#include "tests/support/each_target.h"
#include "tests/support/wave_fixture.h"

namespace lanelight::test {
namespace {

constexpr std::uint32_t kHits = 1511;

struct Variant {
  const char* strategy;
  bool mis, tree;
  double exponent;  // of the heuristic
  bool solid_angle = false;
};
constexpr Variant kVariants[] = {{"directions=mis:power", true, false, 2},
                                 {"directions=mis:balance", true, false, 1},
                                 {"directions=mis:power", true, true, 2},
                                 {"directions=mis:power", true, false, 2, true},
                                 {"directions=mis:balance", true, true, 1, true},
                                 {"directions=bsdf", false, false, 0}};

Vec3f At(const Geometry& g, std::uint32_t prim, std::mt19937& engine) {
  std::normal_distribution<float> normal;
  std::uniform_real_distribution<float> unit(0.05f, 0.95f);
  const auto vec = [](const float* v) { return Vec3f{v[0], v[1], v[2]}; };
  const Vec3f away = Normalize(Vec3f{normal(engine), normal(engine), normal(engine)});
  if (prim < g.ranges.spheres) {
    const TriangleRecord& t = g.triangles[prim];
    const float a = unit(engine), b = unit(engine) * (1 - a);
    return vec(t.p[0]) * (1 - a - b) + vec(t.p[1]) * a + vec(t.p[2]) * b;
  }
  if (prim < g.ranges.disks) {
    const SphereRecord& s = g.spheres[prim - g.ranges.spheres];
    return vec(s.center) + away * s.radius;
  }
  const DiskRecord& d = g.disks[prim - g.ranges.disks];
  const Vec3f flat = Cross(away, vec(d.normal));
  const float r = d.inner_radius + (d.radius - d.inner_radius) * unit(engine);
  return vec(d.center) + Normalize(flat) * r;
}

// Paths whose rays go from random points to random points of the shapes, or anywhere.
struct Hits {
  const LightScene& lights;
  const Variant& variant;
  WaveFixture fixture;
  std::vector<Vec3f> before;

  Hits(const LightScene& l, const Variant& v)
      : lights(l), variant(v), fixture(l.Parts(), kHits) {
    PathColumns& p = fixture.wave.path;
    if (!v.tree) p.light_pmf = nullptr;
    Strategy strategy;
    ApplyStrategy(v.strategy, {}, strategy);
    fixture.run.mis = MakeMisParameters(strategy);
    std::mt19937 engine(37);
    std::uniform_real_distribution<float> place(-2, 2), unit(0.1f, 1);
    const PrimitiveRanges& ranges = l.scene.geometry.ranges;
    for (std::uint32_t i = 0; i < kHits; ++i) {
      const Vec3f o = {place(engine), place(engine), place(engine)};
      p.prim[i] = engine() % ranges.end;
      const bool plane = p.prim[i] >= ranges.planes;
      const Vec3f q = plane ? Vec3f{place(engine), place(engine), -9}
                            : At(l.scene.geometry, p.prim[i], engine);
      const Vec3f d = Normalize(q - o);
      p.o_x[i] = o.x, p.o_y[i] = o.y, p.o_z[i] = o.z;
      p.d_x[i] = d.x, p.d_y[i] = d.y, p.d_z[i] = d.z;
      p.t[i] = Length(q - o);
      p.beta_r[i] = unit(engine), p.beta_g[i] = unit(engine), p.beta_b[i] = unit(engine);
      p.l_r[i] = unit(engine), p.l_g[i] = unit(engine), p.l_b[i] = unit(engine);
      p.bsdf_pdf[i] = i % 5 == 0 ? 0 : std::pow(10.0f, place(engine));
      if (v.tree) p.light_pmf[i] = unit(engine);
      before.push_back({p.l_r[i], p.l_g[i], p.l_b[i]});
    }
  }
  FeatureSet features() const {
    FeatureSet features;
    if (variant.mis) features.Add(Feature::kMis);
    if (variant.solid_angle) features.Add(Feature::kSolidAngleLights);
    return features;
  }
  Vec3d Origin(std::uint32_t i) const {
    const PathColumns& p = fixture.wave.path;
    return {p.o_x[i], p.o_y[i], p.o_z[i]};
  }
  Vec3d Direction(std::uint32_t i) const {
    const PathColumns& p = fixture.wave.path;
    return Normalize(Vec3d{p.d_x[i], p.d_y[i], p.d_z[i]});
  }
  // The share of what is seen that hits have, where samples have density pdf.
  double Weight(std::uint32_t i, double pdf) const {
    const double mine = fixture.wave.path.bsdf_pdf[i];
    if (!variant.mis || mine == 0) return 1;
    return 1 / (1 + std::pow(pdf / mine, variant.exponent));
  }
  void CheckGained(std::uint32_t i, Vec3d radiance, double tolerance) const {
    const PathColumns& p = fixture.wave.path;
    const float* now[3] = {p.l_r, p.l_g, p.l_b};
    const float* beta[3] = {p.beta_r, p.beta_g, p.beta_b};
    for (int c = 0; c < 3; ++c) {
      const double gained = beta[c][i] * radiance[c];
      CHECK(now[c][i] == Approx(before[i][c] + gained).margin(1e-6 + tolerance * gained));
    }
  }
};

std::int32_t LightOf(const Geometry& g, std::uint32_t prim) {
  if (prim < g.ranges.spheres) return g.triangles[prim].light;
  if (prim < g.ranges.disks) return g.spheres[prim - g.ranges.spheres].light;
  if (prim < g.ranges.planes) return g.disks[prim - g.ranges.disks].light;
  return -1;
}

void CheckHit(const Hits& hits, std::uint32_t i) {
  const CompiledScene& scene = hits.lights.scene;
  const PathColumns& p = hits.fixture.wave.path;
  const std::int32_t index = LightOf(scene.geometry, p.prim[i]);
  INFO("path " << i << ", primitive " << p.prim[i]);
  if (index < 0) return hits.CheckGained(i, {}, 0);
  const NamedLight& light = hits.lights.lights[static_cast<std::size_t>(index)];
  // What is hit is not always what is nearest: a far side is seen through the near one.
  const VisibleLight seen = FindVisibleLight(scene, light.record, hits.Origin(i),
                                             hits.Direction(i), hits.variant.solid_angle);
  INFO(light.name << ", cosine " << seen.cosine);
  if (std::abs(seen.distance - p.t[i]) > 1e-5 * p.t[i]) return;
  if (seen.cosine < 0.03) return;  // rounding decides which side is seen
  const double pmf = hits.variant.tree ? p.light_pmf[i] : light.pmf;
  const double weight = seen.facing ? hits.Weight(i, pmf * seen.pdf) : 0;
  hits.CheckGained(i, seen.radiance * weight, 1e-5 + 2e-5 / seen.cosine);
}

}  // namespace

TEST_CASE("hit lights add their emission with the MIS weight of hits", "[lights]") {
  const LightScene all;
  LightScene more;
  more.AddOthers(80);  // without a look at which primitives emit
  const EachTarget target;
  for (const Variant& variant : kVariants) {
    for (const LightScene* lights : {&all, static_cast<const LightScene*>(&more)}) {
      CAPTURE(variant.strategy, variant.tree);
      Hits hits(*lights, variant);
      hits.fixture.QueueAll(QueueId::kHit, kHits);
      hits.fixture.Run(EmissionTriangleStage, hits.features());
      hits.fixture.Run(EmissionRectangleStage, hits.features());
      hits.fixture.Run(EmissionSphereStage, hits.features());
      hits.fixture.Run(EmissionDiskStage, hits.features());
      for (std::uint32_t i = 0; i < kHits; ++i) CheckHit(hits, i);
    }
  }
}

TEST_CASE("escaped rays add every environment with the MIS weight of hits", "[lights]") {
  const LightScene all;
  const EachTarget target;
  for (const Variant& variant : kVariants) {
    if (variant.tree) continue;  // environments are chosen beside the tree
    CAPTURE(variant.strategy);
    Hits hits(all, variant);
    hits.fixture.QueueAll(QueueId::kMiss, kHits);
    hits.fixture.Run(EscapeStage, hits.features());
    for (std::uint32_t i = 0; i < kHits; ++i) {
      Vec3d sum;
      bool certain = true;
      for (const NamedLight& light : all.lights) {
        const auto shape = static_cast<LightShape>(light.record.shape);
        if (shape != LightShape::kInfiniteConstant &&
            shape != LightShape::kInfiniteImage) {
          continue;
        }
        const VisibleLight seen =
            FindVisibleLight(all.scene, light.record, {}, hits.Direction(i));
        certain &= seen.met;
        sum += seen.radiance * hits.Weight(i, light.pmf * seen.pdf);
      }
      INFO("path " << i);
      if (certain) hits.CheckGained(i, sum, 1e-5);
    }
  }
}

TEST_CASE("the table selects lights with their stated probability", "[lights]") {
  constexpr std::uint32_t kSteps = 1 << 16;
  const EachTarget target;
  for (const char* selection : {"power", "uniform"}) {
    CAPTURE(selection);
    LightScene lights;
    lights.AddOthers(21);
    CompiledScene& scene = lights.scene;
    const std::size_t n = scene.lights.lights.size();
    for (std::size_t i = 0; i < n; ++i) {
      scene.lights.power.push_back(1 + double(i * i % 13));
    }
    Strategy strategy;
    ApplyStrategy(std::string("light-selection=") + selection, {}, strategy);
    lights.chances = MakeLightChances(scene, strategy);
    WaveFixture fixture(lights.Parts(), kSteps);
    PathColumns& p = fixture.wave.path;
    for (std::uint32_t i = 0; i < kSteps; ++i) p.u_select[i] = (i + 0.5f) / kSteps;
    fixture.QueueAll(QueueId::kLit, kSteps);
    fixture.Run(SelectLightStage, {});
    std::vector<double> counts(n);
    for (std::uint32_t i = 0; i < kSteps; ++i) {
      REQUIRE(p.ls_light[i] < n);
      counts[p.ls_light[i]] += 1.0 / kSteps;
    }
    double total = 0;
    for (double w : scene.lights.power) total += w;
    for (std::size_t i = 0; i < n; ++i) {
      INFO("light " << i);
      const bool power = std::string(selection) == "power";
      const double want = power ? scene.lights.power[i] / total : 1 / double(n);
      CHECK(lights.chances.pmf[i] == Approx(want));
      // Every entry of the table that a light has part in may be off by a step.
      CHECK(std::abs(counts[i] - want) < double(n) / kSteps);
    }
  }
}

}  // namespace lanelight::test

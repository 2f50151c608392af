// Auxiliary output of the first hit, and the light of unoccluded shadow rays.
#include <catch2/catch.hpp>

#include "kernels/stages.h"
#include "tests/support/each_target.h"
#include "tests/support/wave_fixture.h"

namespace lanelight {
namespace {

constexpr std::uint32_t kHitPaths = 77;
constexpr float kUnchanged = -77;

// One material of every kind; colours that differ by material and channel.
CompiledScene AllKinds() {
  CompiledScene scene;
  MaterialTable& m = scene.materials;
  for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(ShadeKind::kCount); ++k) {
    m.kind.push_back(k);
    m.color0_r.push_back(0.1f + 0.05f * k);
    m.color0_g.push_back(0.2f + 0.05f * k);
    m.color0_b.push_back(0.3f + 0.05f * k);
    m.color1_r.push_back(1.0f + k);
    m.color1_g.push_back(1.5f + k);
    m.color1_b.push_back(2.0f + k);
  }
  return scene;
}

// Reflectance at normal incidence of a metal n + ik in air.
double Metal(double n, double k) {
  return ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k);
}

// What the albedo of a kind is, for colours c0 and c1 of one channel.
double Albedo(ShadeKind kind, double c0, double c1) {
  switch (kind) {
    case ShadeKind::kConductorSmooth:
    case ShadeKind::kConductorRough:
    case ShadeKind::kCoatedConductor:
    case ShadeKind::kCoatedConductorMedium:
      return Metal(c0, c1);
    case ShadeKind::kDielectricSmooth:
    case ShadeKind::kDielectricRough:
    case ShadeKind::kThinDielectric:
      return 1;
    default:
      return c0;
  }
}

bool IsFirstHit(std::uint32_t i) { return i % 3 != 1; }

// Paths on a surface, some of them at their first hit.
void FillHits(WaveFixture& f, std::uint32_t materials) {
  PathColumns& p = f.wave.path;
  for (std::uint32_t i = 0; i < kHitPaths; ++i) {
    p.depth[i] = IsFirstHit(i) ? 0 : i % 5 + 1;
    p.material[i] = i % materials;
    p.t[i] = 2.0f + i;
    p.ng_x[i] = 1 + i, p.ng_y[i] = 2 + i, p.ng_z[i] = 3 + i;
    p.ns_x[i] = -1.0f - i, p.ns_y[i] = -2.0f - i, p.ns_z[i] = -3.0f - i;
    p.color0_r[i] = 0.9f - 0.01f * i, p.color0_g[i] = 0.8f - 0.01f * i;
    p.color0_b[i] = 0.7f - 0.005f * i;
    p.color1_r[i] = 1.5f + i, p.color1_g[i] = 2.0f + i, p.color1_b[i] = 3.0f + i;
    for (float* aov : {p.aov_albedo_r, p.aov_albedo_g, p.aov_albedo_b, p.aov_n_x,
                       p.aov_n_y, p.aov_n_z, p.aov_depth}) {
      aov[i] = kUnchanged;
    }
  }
  f.QueueAll(QueueId::kSurface, kHitPaths);
}

void CheckHit(const PathColumns& p, const MaterialTable& m, std::uint32_t i,
              const FeatureSet& features) {
  INFO("path " << i << ", kind " << m.kind[p.material[i]]);
  if (!IsFirstHit(i)) {
    CHECK(p.aov_albedo_g[i] == kUnchanged);
    CHECK(p.aov_n_z[i] == kUnchanged);
    CHECK(p.aov_depth[i] == kUnchanged);
    return;
  }
  const std::uint32_t id = p.material[i];
  const auto kind = static_cast<ShadeKind>(m.kind[id]);
  const bool textured = features.Has(Feature::kTextures);
  const float r = textured ? p.color0_r[i] : m.color0_r[id];
  const float g = textured ? p.color0_g[i] : m.color0_g[id];
  const float b = textured ? p.color0_b[i] : m.color0_b[id];
  const bool second = features.Has(Feature::kTexturedColor1);
  const float k[] = {second ? p.color1_r[i] : m.color1_r[id],
                     second ? p.color1_g[i] : m.color1_g[id],
                     second ? p.color1_b[i] : m.color1_b[id]};
  CHECK(p.aov_albedo_r[i] == Approx(Albedo(kind, r, k[0])).epsilon(1e-6));
  CHECK(p.aov_albedo_g[i] == Approx(Albedo(kind, g, k[1])).epsilon(1e-6));
  CHECK(p.aov_albedo_b[i] == Approx(Albedo(kind, b, k[2])).epsilon(1e-6));
  const bool shading = features.Has(Feature::kVertexNormals);
  CHECK(p.aov_n_x[i] == (shading ? p.ns_x[i] : p.ng_x[i]));
  CHECK(p.aov_n_y[i] == (shading ? p.ns_y[i] : p.ng_y[i]));
  CHECK(p.aov_n_z[i] == (shading ? p.ns_z[i] : p.ng_z[i]));
  CHECK(p.aov_depth[i] == p.t[i]);
}

}  // namespace

TEST_CASE("aov: albedo of every kind, normal and depth are those of the first hit",
          "[accumulate]") {
  const CompiledScene scene = AllKinds();
  const FeatureSet variants[] = {{},
                                 {Feature::kVertexNormals},
                                 {Feature::kTextures},
                                 {Feature::kTextures, Feature::kVertexNormals},
                                 {Feature::kTextures, Feature::kTexturedColor1}};
  const EachTarget target;
  for (const FeatureSet& features : variants) {
    CAPTURE(features.Has(Feature::kTextures));
    WaveFixture f(scene, kHitPaths);
    FillHits(f, static_cast<std::uint32_t>(scene.materials.size()));
    if (!features.Has(Feature::kTexturedColor1)) f.wave.path.color1_r = nullptr;
    f.Run(AovStage, features);
    for (std::uint32_t i = 0; i < kHitPaths; ++i) {
      CheckHit(f.wave.path, scene.materials, i, features);
    }
  }
}

TEST_CASE("connect: the queued paths gain what their shadow rays carry", "[accumulate]") {
  const CompiledScene scene;
  const EachTarget target;
  WaveFixture f(scene, kHitPaths);
  PathColumns& p = f.wave.path;
  Queue& shadow = f.wave.queue(QueueId::kShadow);
  for (std::uint32_t i = 0; i < kHitPaths; ++i) {
    p.l_r[i] = i, p.l_g[i] = 2 * i, p.l_b[i] = 3 * i;
    p.sh_r[i] = 1, p.sh_g[i] = 0.5f, p.sh_b[i] = i;
    if (i % 4 != 2) shadow.items[shadow.size++] = i;
  }
  f.Run(ConnectStage, {});
  for (std::uint32_t i = 0; i < kHitPaths; ++i) {
    const float lit = i % 4 != 2;
    CHECK(p.l_r[i] == i + lit);
    CHECK(p.l_g[i] == 2 * i + 0.5f * lit);
    CHECK(p.l_b[i] == 3 * i + i * lit);
  }
}

}  // namespace lanelight

// The skeleton of the shading stages on a hand-made wavefront: what a bounce and a light
// sample write, and that a path's result depends on the path alone.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <numbers>

#include "kernels/stages.h"
#include "tests/kernels/shade/probe_batch.h"
#include "tests/kernels/shade/shade_stages.h"
#include "tests/support/each_target.h"
#include "tests/support/wave_fixture.h"

namespace lanelight::test {
namespace {

constexpr std::uint32_t kPaths = 37;  // never a multiple of a vector
const FeatureSet kAll = {Feature::kLights, Feature::kMis, Feature::kScatters,
                         Feature::kVertexNormals};

StageOn StageOf(ShadeKind kind) {
  const StageOn stage = kShadeStages[static_cast<int>(kind)];
  REQUIRE(stage(TestTarget()).input == ShadeQueue(kind));
  return stage;
}

// Random surfaces, one material, everything that a shading stage reads.
struct ShadeFixture {
  CompiledScene scene;
  WaveFixture fixture;
  ShadeKind kind;

  explicit ShadeFixture(const TestMaterial& material)
      : fixture(scene, kPaths), kind(material.kind) {
    scene.materials = material.table;
    PathColumns& p = fixture.wave.path;
    p.color0_r = p.color0_g = p.color0_b = p.alpha_x = p.alpha_y = nullptr;
    p.color1_r = p.color1_g = p.color1_b = p.coat_thickness = p.coat_g = nullptr;
    reference::Random random(81);
    const auto unit = [&] { return static_cast<float>(random.Bits() >> 40) * 0x1p-24f; };
    for (std::uint32_t i = 0; i < kPaths; ++i) {
      p.pixel[i] = 100 + i, p.sample[i] = i, p.depth[i] = 3, p.material[i] = 0;
      const Vec3d n = RandomDirection(random);
      const Vec3d s = Normalize(n + 0.05 * RandomDirection(random));
      Set(i, n, p.ng_x, p.ng_y, p.ng_z);
      Set(i, s, p.ns_x, p.ns_y, p.ns_z);
      Set(i, RandomDirection(random), p.tg_x, p.tg_y, p.tg_z);
      Set(i, RandomDirection(random), p.d_x, p.d_y, p.d_z);
      Set(i, 10.0 * RandomDirection(random), p.p_x, p.p_y, p.p_z);
      Set(i, RandomDirection(random), p.ls_x, p.ls_y, p.ls_z);
      Set(i, {1, 2, 3}, p.ls_r, p.ls_g, p.ls_b);
      Set(i, {0.5, 0.25, 1}, p.beta_r, p.beta_g, p.beta_b);
      p.p_error[i] = 1e-3f;
      p.ls_pdf[i] = i % 3 == 0 ? 0 : 2 * unit();
      p.u_lobe[i] = unit(), p.u_bsdf_0[i] = unit(), p.u_bsdf_1[i] = unit();
      p.eta_scale[i] = 1, p.uv_v[i] = material.uv_v[0], p.bsdf_pdf[i] = -1, p.t[i] = 5;
    }
  }

  static void Set(std::uint32_t i, Vec3d v, float* x, float* y, float* z) {
    x[i] = static_cast<float>(v.x), y[i] = static_cast<float>(v.y);
    z[i] = static_cast<float>(v.z);
  }
  void Run(const FeatureSet& features, const std::vector<std::uint32_t>& slots) {
    Queue& queue = fixture.wave.queue(ShadeQueue(kind));
    queue.size = static_cast<std::uint32_t>(slots.size());
    std::copy(slots.begin(), slots.end(), queue.items);
    fixture.Run(StageOf(kind), features);
  }
  std::vector<std::uint32_t> All() const {
    std::vector<std::uint32_t> slots(kPaths);
    for (std::uint32_t i = 0; i < kPaths; ++i) slots[i] = kPaths - 1 - i;
    return slots;
  }
  std::vector<std::uint32_t> Slots(QueueId id) {
    const Queue& queue = fixture.wave.queue(id);
    return {queue.items, queue.items + queue.size};
  }
};

Vec3d At(const float* x, const float* y, const float* z, std::uint32_t i) {
  return {x[i], y[i], z[i]};
}

}  // namespace

TEST_CASE("a Lambertian bounce by hand", "[shade][stage]") {
  const EachTarget target;
  const TestMaterial& material = TestMaterials()[0];
  const ShadeFixture before(material);
  ShadeFixture f(material);
  f.Run(kAll, f.All());
  const PathColumns &p = f.fixture.wave.path, &q = before.fixture.wave.path;
  CHECK(f.Slots(QueueId::kScattered) == f.All());
  CHECK(f.Slots(QueueId::kDone).empty());
  std::vector<std::uint32_t> shadows;
  for (std::uint32_t i = 0; i < kPaths; ++i) {
    INFO("path " << i);
    const Vec3d n = At(q.ns_x, q.ns_y, q.ns_z, i), ng = At(q.ng_x, q.ng_y, q.ng_z, i);
    const double side = -Dot(At(q.d_x, q.d_y, q.d_z, i), n) > 0 ? 1 : -1;
    const Vec3d d = At(p.d_x, p.d_y, p.d_z, i), l = At(q.ls_x, q.ls_y, q.ls_z, i);
    CHECK(Length(d) == Approx(1).epsilon(1e-6));
    CHECK(Dot(d, n) * side > 0);
    CHECK(p.bsdf_pdf[i] == Approx(std::abs(Dot(d, n)) / std::numbers::pi).margin(1e-6));
    CHECK(p.beta_g[i] == Approx(0.25 * 0.5));
    CHECK(p.depth[i] == 4);
    CHECK(std::isinf(p.t[i]));
    const Vec3d offset = At(p.o_x, p.o_y, p.o_z, i) - At(q.p_x, q.p_y, q.p_z, i);
    CHECK(Dot(offset, ng) == Approx(Dot(d, ng) > 0 ? 1e-3 : -1e-3).margin(1e-5));
    const double pb = std::abs(Dot(l, n)) / std::numbers::pi, pl = q.ls_pdf[i];
    const double weight = pl == 0 ? 1 : pl * pl / (pl * pl + pb * pb);
    const bool lit = Dot(l, n) * side > 0;
    CHECK(p.sh_r[i] == Approx(lit ? 0.5 * 0.8 * pb * 1 * weight : 0).margin(1e-6));
    CHECK(p.sh_b[i] == Approx(lit ? 1.0 * 0.1 * pb * 3 * weight : 0).margin(1e-6));
    if (lit) shadows.insert(shadows.begin(), i);
  }
  CHECK(f.Slots(QueueId::kShadow) == shadows);
}

TEST_CASE("stages omit features that a scene does not use", "[shade][stage]") {
  const EachTarget target;
  for (const TestMaterial& m : TestMaterials()) {
    ShadeFixture f(m);
    PathColumns& p = f.fixture.wave.path;
    // Null columns: touching one would end the test program.
    p.ns_x = p.ns_y = p.ns_z = p.tg_x = p.tg_y = p.tg_z = p.bsdf_pdf = nullptr;
    p.ls_x = p.ls_y = p.ls_z = p.ls_r = p.ls_g = p.ls_b = p.ls_pdf = nullptr;
    p.start_n_x = p.start_n_y = p.start_n_z = nullptr;
    p.sh_r = p.sh_g = p.sh_b = nullptr;
    f.Run({Feature::kScatters}, f.All());
    CHECK(f.Slots(QueueId::kShadow).empty());
    CHECK(f.Slots(QueueId::kScattered).size() + f.Slots(QueueId::kDone).size() == kPaths);
  }
}

TEST_CASE("shading keeps the normal on the incoming side", "[shade][stage]") {
  const EachTarget target;
  for (const TestMaterial& m : TestMaterials()) {
    if (HasTrait(m.kind, kSpecularOnly)) continue;  // no light sample competes
    ShadeFixture f(m);
    const ShadeFixture before(m);
    f.Run(kAll, f.All());
    const PathColumns &p = f.fixture.wave.path, &q = before.fixture.wave.path;
    for (std::uint32_t i = 0; i < kPaths; ++i) {
      INFO("path " << i);
      const Vec3d n = At(q.ns_x, q.ns_y, q.ns_z, i);
      const double side = Dot(At(q.d_x, q.d_y, q.d_z, i), n) < 0 ? 1 : -1;
      CHECK(At(p.start_n_x, p.start_n_y, p.start_n_z, i) == n * side);
    }
  }
}

TEST_CASE("delta lights alone have full weight", "[shade][stage]") {
  ShadeFixture all(TestMaterials()[0]), delta(TestMaterials()[0]);
  for (std::uint32_t i = 0; i < kPaths; ++i) all.fixture.wave.path.ls_pdf[i] = 0;
  all.Run(kAll, all.All());
  PathColumns& p = delta.fixture.wave.path;
  p.ls_pdf = p.bsdf_pdf = nullptr;
  delta.Run({Feature::kLights, Feature::kScatters, Feature::kVertexNormals}, delta.All());
  for (std::uint32_t i = 0; i < kPaths; ++i) {
    CHECK(p.sh_g[i] == all.fixture.wave.path.sh_g[i]);
  }
}

TEST_CASE("textured parameters come from the path", "[shade][stage]") {
  const EachTarget target;
  ShadeFixture f(TestMaterials()[0]);
  std::vector<float> color(kPaths + 32);
  for (std::uint32_t i = 0; i < kPaths; ++i) color[i] = (i + 1) / 64.f;
  PathColumns& p = f.fixture.wave.path;
  p.color0_r = p.color0_g = p.color0_b = color.data();
  f.Run(kAll, f.All());
  for (std::uint32_t i = 0; i < kPaths; ++i) CHECK(p.beta_b[i] == color[i]);
}

TEST_CASE("absorbed paths enter the done queue", "[shade][stage]") {
  TestMaterial black = TestMaterials()[0];
  black.table.color0_r[0] = black.table.color0_g[0] = black.table.color0_b[0] = 0;
  const EachTarget target;
  ShadeFixture f(black);
  f.Run(kAll, f.All());
  CHECK(f.Slots(QueueId::kDone) == f.All());
  CHECK(f.Slots(QueueId::kScattered).empty());
  CHECK(f.Slots(QueueId::kShadow).empty());
}

TEST_CASE("a bounce depends on its own path only", "[shade][stage]") {
  // All at once, and one by one: bit for bit the same.
  const EachTarget target;
  for (const TestMaterial& m : TestMaterials()) {
    ShadeFixture together(m), alone(m);
    together.Run(kAll, together.All());
    for (std::uint32_t i = 0; i < kPaths; ++i) alone.Run(kAll, {i});
    const PathColumns &a = together.fixture.wave.path, &b = alone.fixture.wave.path;
    INFO(m.name);
    const auto same = [](const float* x, const float* y) {
      return std::memcmp(x, y, kPaths * sizeof(float)) == 0;
    };
    CHECK(same(a.d_x, b.d_x));
    CHECK(same(a.o_z, b.o_z));
    CHECK(same(a.beta_g, b.beta_g));
    CHECK(same(a.bsdf_pdf, b.bsdf_pdf));
    CHECK(same(a.eta_scale, b.eta_scale));
    if (!IsSpecular(m.kind)) CHECK(same(a.sh_b, b.sh_b));
  }
}

}  // namespace lanelight::test

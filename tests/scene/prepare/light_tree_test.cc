// light-selection=tree: the tree bounds its lights, and the kernels that descend and
// climb it agree with each other and with a probability that sums to 1.
#include "src/scene/prepare/light_bounds.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <random>

#include "kernels/stages.h"
#include "src/scene/prepare/prepared_scene.h"
#include "tests/reference/scenes.h"
#include "tests/render/run/render_fixture.h"
#include "tests/support/each_target.h"
#include "tests/support/wave_fixture.h"

namespace lanelight::test {
namespace {

PreparedScene ManyLights(int count) {
  SceneBuilder b(4, 4);
  const Index dark = b.AddDiffuse(Grey(0));
  std::mt19937 random(5);
  const auto u = [&] { return double(random() % 1000) / 1000 - 0.5; };
  for (int i = 0; i < count; ++i) {
    const Vec3d p = {8 * u(), 8 * u(), 8 * u()};
    const Index light = b.AddEmission({1 + 3 * std::abs(u()), 2, 1}, i % 5 == 0);
    if (i % 3 == 0) b.AddSphere(p, 0.1, dark, light);
    if (i % 3 == 1) b.AddDisk(p, {u(), u(), 1.1}, 0.2, dark, light);
    if (i % 3 == 2) b.AddQuad(p, {0.3, 0, u()}, {0, 0.2, u()}, dark, light);
  }
  b.AddPoint({0, 0, 1}, {1, 1, 1});
  b.AddSpot({1, 0, 2}, {0, 0, 0}, {2, 2, 2}, 30, 10);
  b.AddDistant({0, 1, 2}, {0.1, 0.1, 0.1});
  b.AddEnvironment({0.1, 0.1, 0.1});
  SceneDescription scene = b.Build();
  scene.strategy.light_selection = LightSelection::kTree;
  return PrepareScene(scene);
}

bool Inside(const LightNode& inner, const LightNode& outer) {
  for (int k = 0; k < 3; ++k) {
    if (inner.low[k] < outer.low[k] || inner.high[k] > outer.high[k]) return false;
  }
  return true;
}

// Largest angle between the axis of `above` and a direction of the cone of `node`.
double ConeReach(const LightNode& node, const LightNode& above) {
  double cosine = 0;
  for (int k = 0; k < 3; ++k) cosine += double(node.axis[k]) * above.axis[k];
  const double between = std::acos(std::clamp(cosine, -1.0, 1.0));
  return std::min(between + std::acos(double(node.cos_axis)), std::acos(-1.0));
}

}  // namespace

TEST_CASE("light tree: nodes bound their children", "[strategy]") {
  const PreparedScene scene = ManyLights(60);
  const LightTree& tree = scene.chances->tree;
  REQUIRE_FALSE(tree.nodes.empty());
  std::map<std::int32_t, int> leaves;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const LightNode& node = tree.nodes[i];
    if (node.child < 0) {
      ++leaves[~node.child];
      // The cone of every node on the way up holds the cone of the leaf.
      for (std::int32_t up = node.parent; up >= 0;) {
        const LightNode& above = tree.nodes[static_cast<std::size_t>(up)];
        CHECK(ConeReach(node, above) <= std::acos(above.cos_axis) + 2e-3);
        up = above.parent;
      }
      continue;
    }
    double power = 0;
    for (std::int32_t c : {node.child, node.child + 1}) {
      const LightNode& child = tree.nodes[static_cast<std::size_t>(c)];
      CHECK(child.parent == static_cast<std::int32_t>(i));
      CHECK(Inside(child, node));
      power += child.power;
    }
    CHECK(node.power == Approx(power).epsilon(1e-5));
  }
  CHECK(leaves.size() + tree.far.size() == scene.compiled->lights.lights.size());
  CHECK(tree.far.size() == 2);
  for (const auto& [light, count] : leaves) CHECK(count == 1);
}

TEST_CASE("light tree: top-down and bottom-up probabilities agree", "[strategy]") {
  const PreparedScene scene = ManyLights(40);
  const std::uint32_t n = 1 << 15;
  const EachTarget target;
  WaveFixture f(scene.Parts(), n);
  PathColumns& p = f.wave.path;
  const Vec3f from = {0.3f, -1.2f, 0.4f};
  for (std::uint32_t i = 0; i < n; ++i) {
    p.p_x[i] = p.o_x[i] = from.x, p.p_y[i] = p.o_y[i] = from.y;
    p.p_z[i] = p.o_z[i] = from.z;
    p.u_select[i] = (static_cast<float>(i) + 0.5f) / static_cast<float>(n);
  }
  f.QueueAll(QueueId::kLit, n);
  f.Run(SelectLightTreeStage, {});
  std::map<std::uint32_t, std::pair<float, int>> seen;
  for (std::uint32_t i = 0; i < n; ++i) {
    auto& [pmf, count] = seen[p.ls_light[i]];
    if (count++ == 0) pmf = p.light_pmf[i];
    // The product of probabilities is the same whatever number led there.
    REQUIRE(p.light_pmf[i] == pmf);
  }
  double sum = 0;
  for (const auto& [light, entry] : seen) {
    const auto [pmf, count] = entry;
    sum += pmf;
    // Evenly spaced numbers: counts are exact but for one at each end of the interval
    // and rounding.
    CHECK(std::abs(count - pmf * float(n)) < 4 + 2e-3 * count);
  }
  CHECK(sum == Approx(1).epsilon(1e-3));
  CHECK(sum < 1.0001);

  // The way up, for lights that a ray can hit.
  std::uint32_t hits = 0;
  std::vector<float> expected;
  for (const auto& [light, entry] : seen) {
    const LightRecord& record = scene.compiled->lights.lights[light];
    if (record.primitive == 0xffffffffu) continue;
    p.prim[hits++] = record.primitive;
    expected.push_back(entry.first);
  }
  REQUIRE(hits > 20);
  f.QueueAll(QueueId::kHit, hits);
  f.Run(HitLightTreeStage, {});
  for (std::uint32_t i = 0; i < hits; ++i) CHECK(p.light_pmf[i] == Approx(expected[i]));
}

TEST_CASE("light tree: near and facing lights are preferred", "[strategy]") {
  const PreparedScene scene = ManyLights(40);
  WaveFixture f(scene.Parts(), 2048);
  PathColumns& p = f.wave.path;
  const SphereRecord& sphere = scene.compiled->geometry.spheres[3];
  for (std::uint32_t i = 0; i < 2048; ++i) {
    p.p_x[i] = sphere.center[0] + 1.5f * sphere.radius;
    p.p_y[i] = sphere.center[1];
    p.p_z[i] = sphere.center[2];
    p.u_select[i] = (static_cast<float>(i) + 0.5f) / 2048;
  }
  f.QueueAll(QueueId::kLit, 2048);
  f.Run(SelectLightTreeStage, {});
  int nearest = 0;
  for (std::uint32_t i = 0; i < 2048; ++i)
    nearest += p.ls_light[i] == static_cast<std::uint32_t>(sphere.light);
  // Alike, it would get a third (beside two lights without a place) of 1 in 42.
  CHECK(nearest > 4 * 2048 / (3 * 42));
}

TEST_CASE("light tree: both halves of a rectangle select its light", "[strategy]") {
  SceneBuilder b(4, 4);
  const Index dark = b.AddDiffuse(Grey(0));
  for (int i = 0; i < 9; ++i) {
    const Index light = b.AddEmission({1 + 0.5 * i, 2, 1}, i % 2 == 0);
    b.AddQuad({2.0 * i, 0.3 * i, 1}, {0.5, 0, 0}, {0, 0.75, 0}, dark, light);
  }
  SceneDescription description = b.Build();
  description.strategy.light_selection = LightSelection::kTree;
  const PreparedScene scene = PrepareScene(description);
  REQUIRE(scene.compiled->lights.lights.size() == 9);
  const LightTree& tree = scene.chances->tree;
  for (const LightRecord& light : scene.compiled->lights.lights) {
    REQUIRE(light.shape == static_cast<std::uint32_t>(LightShape::kRectangle));
    const std::int32_t leaf = tree.primitive_leaf[light.primitive];
    CHECK(leaf >= 0);
    CHECK(tree.primitive_leaf[light.second_primitive] == leaf);
    const LightNode& node = tree.nodes[static_cast<std::size_t>(leaf)];
    CHECK(&light ==
          &scene.compiled->lights.lights[static_cast<std::size_t>(~node.child)]);
    for (const std::uint32_t prim : {light.primitive, light.second_primitive}) {
      for (const auto& p : scene.compiled->geometry.triangles[prim].p) {
        for (int k = 0; k < 3; ++k) {
          CHECK(p[k] >= node.low[k]);
          CHECK(p[k] <= node.high[k]);
        }
      }
    }
  }
}

TEST_CASE("light tree: lights without a position are not in the tree", "[strategy]") {
  SceneBuilder b(4, 4);
  b.Depth(2).Perspective({0, -4, 3}, {0, 0, 0.3}, {0, 0, 1}, 36);
  b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddDiffuse(Grey(0.5)));
  b.AddSphere({0, 0, 0.5}, 0.5, b.AddDiffuse(Grey(0.5)));
  b.AddDistant({0, 1, 2}, {0.4, 0.4, 0.4});
  b.AddEnvironment({0.3, 0.4, 0.5});
  const auto mean = [&](const std::string& selection) {
    TestRender options;
    options.spp = 4096;
    options.strategy = "light-selection=" + selection;
    return ImageMean(RenderDescription(b.Build(), options).film);
  };
  const Rgb tree = mean("tree"), uniform = mean("uniform");
  CHECK(tree.y == Approx(uniform.y).epsilon(0.01));
}

}  // namespace lanelight::test

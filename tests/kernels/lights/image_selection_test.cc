// Goniometric and projection lights among others: how often each is chosen against the
// probability that is reported with it (chi-square), by table and by tree, and samples
// that are worth the light alone over that probability.
#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <vector>

#include "kernels/stages.h"
#include "src/base/stat/hypothesis.h"
#include "src/scene/prepare/prepared_scene.h"
#include "tests/base/stat/chi2.h"
#include "tests/kernels/lights/image_strategies.h"
#include "tests/kernels/lights/pictures.h"
#include "tests/reference/scenes.h"
#include "tests/support/each_target.h"
#include "tests/support/wave_fixture.h"

namespace lanelight::test {
namespace {

constexpr std::uint32_t kChoices = 1 << 18;
constexpr LightSelection kSelections[] = {
    LightSelection::kPower, LightSelection::kUniform, LightSelection::kTree};
const Vec3d kReceivers[] = {{0.4, -0.3, 0.1}, {-0.8, 0.6, 0.3}};

// Two of each kind, of different images, sizes of view and brightness.
std::vector<Light> LightsWithImages() {
  std::vector<Light> lights;
  for (int i = 0; i < 4; ++i) {
    Light light;
    const bool map = i % 2 == 0;
    light.kind = map ? LightKind::kGoniometric : LightKind::kProjection;
    light.image_path = map ? Picture("square.exr", kSquare, kSquare, Patchwork)
                           : Picture("wide.exr", kWide, kHigh, Patchwork);
    light.emission = Rgb{1, 1.5, 0.5} * (1.0 + i);
    light.fov = 60 + 20 * i;
    // Projections look down on the receivers.
    light.world_from_light =
        Transform::Translate({0.3 * i, 0.5 - 0.4 * i, 1.5 + 0.3 * i}) *
        Transform::Rotate(180 - 4 * i, {1, 0.1, 0});
    lights.push_back(light);
  }
  return lights;
}

SceneDescription LitBy(const std::vector<Light>& lights, bool others,
                       LightSelection selection) {
  SceneBuilder b(4, 4);
  b.Depth(1).Perspective({0, -4, 3}, {0, 0, 0}, {0, 0, 1}, 50);
  const Index white = b.AddDiffuse(Grey(0.5));
  b.AddQuad({-1, -1, 3}, {0, 1, 0}, {1, 0, 0}, white,
            others ? b.AddEmission({2, 2, 2}) : kNone);
  if (others) {
    b.AddPoint({1, 1, 2}, {2, 1, 2});
    b.AddDistant({0, 1, 1}, {1, 1, 1});
  }
  SceneDescription scene = b.Build();
  scene.lights.insert(scene.lights.end(), lights.begin(), lights.end());
  scene.strategy.light_selection = selection;
  return scene;
}

// Choices for one receiver, and what is sampled of image lights.
struct Choices {
  PreparedScene scene;
  WaveFixture fixture;
  std::vector<double> counts, reported;  // of each light; probabilities

  Choices(const SceneDescription& description, Vec3d receiver, std::uint32_t n)
      : scene(PrepareScene(description)),
        fixture(scene.Parts(), n),
        counts(scene.compiled->lights.lights.size()),
        reported(scene.compiled->lights.lights.size()) {
    PathColumns& p = fixture.wave.path;
    const bool tree = !scene.chances->tree.nodes.empty();
    if (!tree) p.light_pmf = nullptr;
    const Vec3d at = (receiver - scene.compiled->center) * scene.compiled->scale;
    std::mt19937 engine(23);
    for (std::uint32_t i = 0; i < n; ++i) {
      p.p_x[i] = float(at.x), p.p_y[i] = float(at.y), p.p_z[i] = float(at.z);
      p.u_select[i] = float(engine() >> 8) * 0x1p-24f;
      p.ls_light[i] = 0;
    }
    fixture.QueueAll(QueueId::kLit, n);
    if (counts.size() > 1) {
      fixture.Run(tree ? SelectLightTreeStage : SelectLightStage,
                  scene.compiled->features);
    }
    bool same = true;  // probability, whatever number led to a light
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t light = p.ls_light[i];
      if (light >= counts.size()) FAIL("no such light");
      const double pmf = tree ? p.light_pmf[i] : scene.chances->pmf[light];
      same &= counts[light] == 0 || reported[light] == pmf;
      reported[light] = pmf;
      ++counts[light];
    }
    CHECK(same);
    fixture.Run(SampleImageLightStage, scene.compiled->features);
  }
  double PValue(const std::vector<double>& claimed) const {
    double sum = 0, n = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) sum += claimed[i], n += counts[i];
    std::vector<double> expected;
    for (const double c : claimed) expected.push_back(c / sum * n);
    return stat::ChiSquareTest(counts, expected).p;
  }
};

}  // namespace

// The family of all ways to choose, receivers and targets raises a false alarm with
// probability 1e-6.
TEST_CASE("image lights are selected with their stated probability", "[lights][stat]") {
  const double level = stat::SidakLevel(1e-6, int(6 * AvailableTargets().size()));
  const EachTarget target;
  for (const LightSelection selection : kSelections) {
    const SceneDescription scene = LitBy(LightsWithImages(), true, selection);
    for (const Vec3d receiver : kReceivers) {
      CAPTURE(int(selection), receiver.x);
      const Choices choices(scene, receiver, kChoices);
      REQUIRE(choices.counts.size() == 7);
      double sum = 0;
      for (const double pmf : choices.reported) {
        CHECK(pmf > 0);
        sum += pmf;
      }
      CHECK(sum == Approx(1).epsilon(1e-5));
      CHECK(choices.PValue(choices.reported) > level);
      // A probability of one light that is off by 5 % is rejected.
      std::vector<double> wrong = choices.reported;
      *std::max_element(wrong.begin(), wrong.end()) *= 1.05;
      CHECK(choices.PValue(wrong) < 1e-6);
    }
  }
}

TEST_CASE("a selected image light is weighted by the inverse probability", "[lights]") {
  const std::vector<Light> lights = LightsWithImages();
  const EachTarget target;
  for (const Vec3d receiver : kReceivers) {
    std::vector<Rgb> alone;
    for (const Light& light : lights) {
      const Choices one(LitBy({light}, false, LightSelection::kPower), receiver, 1);
      const PathColumns& p = one.fixture.wave.path;
      CHECK(one.reported[0] == 1);
      alone.push_back({p.ls_r[0], p.ls_g[0], p.ls_b[0]});
      CHECK(alone.back().x > 0);
    }
    for (const LightSelection selection : kSelections) {
      CAPTURE(int(selection), receiver.x);
      const Choices all(LitBy(lights, true, selection), receiver, 4096);
      const std::size_t first = all.counts.size() - lights.size();
      const PathColumns& p = all.fixture.wave.path;
      for (std::uint32_t i = 0; i < 4096; ++i) {
        if (p.ls_light[i] < first) continue;
        const Rgb sampled = Rgb{p.ls_r[i], p.ls_g[i], p.ls_b[i]};
        const Rgb want = alone[p.ls_light[i] - first] / all.reported[p.ls_light[i]];
        for (int c = 0; c < 3; ++c) CHECK(sampled[c] == Approx(want[c]).epsilon(1e-5));
      }
    }
  }
}

}  // namespace lanelight::test

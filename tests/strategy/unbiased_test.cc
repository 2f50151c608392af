// Every strategy, and every two choices of different axes together, render the same image
// as the scalar reference or the closed form, on scenes that are hard for some of them.
//
// Combinations come from a covering array. A choice that the scene refuses (a control
// variate without its lights) is left out of the combination there, and the refusal is
// checked. All comparisons of this file share one false-alarm budget; planted errors of
// 1 % must be found.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <map>

#include "src/image/exr.h"
#include "src/image/octahedral.h"
#include "tests/image/temporary_folder.h"
#include "tests/reference/closed_forms.h"
#include "src/prepare/prepare_scene.h"
#include "tests/lights/cut_lamps.h"
#include "tests/lights/pictures.h"
#include "tests/media/scenes.h"
#include "src/stat/hypothesis.h"
#include "tests/strategy/covering.h"
#include "tests/strategy/tiles.h"
#include "tests/wavefront/agreement.h"

namespace lanelight::test {
namespace {

constexpr double kFalseAlarm = 1e-4;  // for all comparisons of a test case together
// A comparison that finds no smaller bias than that is not made.
constexpr double kJudged = 0.25;

// Arguments with which a choice takes part; the others take part as they are.
const std::map<std::string, std::vector<std::string>>& Variants() {
  static const std::map<std::string, std::vector<std::string>> kVariants = {
      {"mis", {"mis:power", "mis:balance"}},
      {"antithetic",
       {"antithetic:all", "antithetic:pixel", "antithetic:light", "antithetic:bsdf",
        "antithetic:first-bounce"}},
      {"analytic", {"analytic,c=1", "analytic,c=optimal"}},
      {"ambient", {"ambient,c=1", "ambient,c=optimal"}},
      {"regression", {"regression,c=1"}},
      {"block", {"block:8", "block:64:compact", "block:16:apart"}},
      {"constant", {"constant:0.2"}},
      {"throughput", {"throughput:0.1:1", "throughput:0:2:4"}},
      {"contribution", {"contribution", "contribution:0.02"}}};
  return kVariants;
}

std::vector<Axis> MakeAxes() {
  std::vector<Axis> axes;
  for (const ChoiceInfo& choice : AllChoices()) {
    if (axes.empty() || axes.back().key != choice.axis) axes.push_back({choice.axis, {}});
    const auto variants = Variants().find(choice.name);
    auto& values = axes.back().values;
    if (variants == Variants().end()) {
      values.push_back(choice.name);
    } else {
      values.insert(values.end(), variants->second.begin(), variants->second.end());
    }
  }
  return axes;
}

// Every choice of src/strategy/choices.h.
const std::vector<Axis>& Axes() {
  static const std::vector<Axis> kAxes = MakeAxes();
  return kAxes;
}

const std::vector<Combination>& Combinations() {
  static const std::vector<Combination> kCombinations = CoverPairs(Axes(), 60);
  return kCombinations;
}

// A small emitter that scattered rays rarely hit.
SceneDescription TinyLight() { return SmallRoom(8, 3, 0.12); }

// A ceiling that is all light: light samples lie mostly at grazing angles.
SceneDescription LargeLight() { return SmallRoom(8, 3, 0.95); }

SceneDescription GlossyPlates() {
  Material metal;
  metal.kind = MaterialKind::kConductor;
  metal.eta.constant = {0.2, 0.9, 1.1};
  metal.k.constant = {3.9, 2.5, 2.2};
  metal.uroughness.constant = metal.vroughness.constant = 0.15;
  metal.remap_roughness = false;
  SceneDescription scene = Plate(metal, 8, 3);
  return scene;
}

// Radiance of the image of a sky, 8 x 8 texels: dim, with a bright spot.
Rgb SkyTexel(int x, int y) {
  if (x == 5 && y == 3) return {3, 2.5, 2};
  return {0.1 + 0.02 * ((x + 2 * y) % 5), 0.15, 0.1 + 0.03 * (y % 3)};
}

Rgb SkyRadiance(Index, Vec3d toward) {
  const auto [u, v] = DirectionToOctahedral(toward);
  return SkyTexel(std::min(static_cast<int>(8 * u), 7),
                  std::min(static_cast<int>(8 * v), 7));
}

std::string SkyFile() {
  static const TemporaryFolder folder;
  std::vector<ExrPlane> planes = {{"R", {}, true}, {"G", {}, true}, {"B", {}, true}};
  for (int i = 0; i < 64; ++i) {
    for (int c = 0; c < 3; ++c) {
      planes[static_cast<std::size_t>(c)].values.push_back(
          static_cast<float>(SkyTexel(i % 8, i / 8)[c]));
    }
  }
  WriteExr(folder.File("sky.exr"), 8, 8, planes);
  return folder.File("sky.exr");
}

// Skies, constant, as an image and through a skylight, with a sun of their own and one
// that is a small, far, bright sphere.
SceneDescription SkyAndSun() {
  SceneBuilder b(8, 8);
  b.Depth(3).Perspective({0, -4, 3}, {0, 0, 0.3}, {0, 0, 1}, 36);
  const Index ground = b.AddDiffuse({0.5, 0.4, 0.3});
  Material leaf;
  leaf.kind = MaterialKind::kDiffuseTransmission;
  leaf.reflectance.constant = {0.4, 0.3, 0.2};
  leaf.transmittance.constant = {0.2, 0.3, 0.5};
  Material plastic;
  plastic.kind = MaterialKind::kCoatedDiffuse;
  // Grey: a coloured base under a coat is replaced when compiling by the colour of its
  // spectral response (src/compile/coat_color.h), which the reference does not do.
  plastic.reflectance.constant = Grey(0.6);
  plastic.uroughness.constant = plastic.vroughness.constant = 0;
  b.AddPlane({0, 0, 0}, {0, 0, 1}, ground);
  b.AddQuad({-1, -0.5, 0.9}, {1, 0, 0.1}, {0, 1, 0}, b.AddMaterial(leaf));
  b.AddSphere({0.6, 0, 0.5}, 0.5, b.AddMaterial(plastic));
  b.AddSphere({4, 3, 8}, 1.5, ground, b.AddEmission({12, 11, 9}));
  b.AddDistant({-1, -1, 2}, {0.5, 0.5, 0.6});
  b.AddEnvironment({0.2, 0.3, 0.5});
  b.AddEnvironment({});
  SceneDescription scene = b.Build();
  scene.lights.back().image_path = SkyFile();
  scene.lights.push_back(scene.lights.back());
  scene.lights.back().portal = {{-1.5, -1.5, 2}, {-1.5, 1, 2}, {1, 1, 2}, {1, -1.5, 2}};
  scene.lights.back().image_scale = 2;
  return scene;
}

// Lights of every shape that has a place, some with an image, for the selection of
// lights.
SceneDescription ManyLights() {
  SceneBuilder b(8, 8);
  b.Depth(2).Perspective({0, -4, 3}, {0, 0, 0.3}, {0, 0, 1}, 36);
  const Index ground = b.AddDiffuse({0.5, 0.4, 0.3}), dark = b.AddDiffuse(Grey(0));
  b.AddPlane({0, 0, 0}, {0, 0, 1}, ground);
  for (int i = 0; i < 6; ++i) {
    const double x = 0.6 * i - 1.5;
    b.AddSphere({x, 1, 0.8}, 0.15, dark, b.AddEmission({4.0 + i, 3, 2}));
    b.AddDisk({x, 0.2, 1.2}, {0.2 * i - 0.5, 0, -1}, 0.15, dark,
              b.AddEmission({3, 5, 2.0 + i}, i % 2 == 0));
    b.AddQuad({x, -0.8, 1}, {0, 0.2, 0}, {0.2, 0, 0.05 * i}, dark,
              b.AddEmission({6, 6, 6}));
  }
  b.AddPoint({0, 0, 2}, {0.3, 0.3, 0.3});
  b.AddSpot({1, 0, 2}, {0, 0, 0}, {2, 2, 2}, 30, 10);
  SceneDescription scene = b.Build();
  const std::string picture = Picture("emitted.exr", 8, 8, Patchwork);
  for (std::size_t i = 0; i < 6; ++i) scene.area_lights[i].image_path = picture;
  for (const LightKind kind : {LightKind::kGoniometric, LightKind::kProjection}) {
    Light& light = scene.lights.emplace_back();
    light.kind = kind;
    light.image_path = picture;
    light.emission = {0.5, 0.5, 0.5};
    light.world_from_light =
        Transform::Translate({-0.5, 0, 2}) * Transform::Rotate(180, {1, 0.1, 0});
  }
  return scene;
}

struct HardScene {
  const char* name;
  SceneDescription scene;
  int tile;  // pixels per side that together see enough of rare events
};

constexpr std::size_t kScenes = 7;
std::vector<HardScene> HardScenes() {
  return {{"tiny light", TinyLight(), 8},       {"large light", LargeLight(), 4},
          {"glossy plates", GlossyPlates(), 8}, {"sky and sun", SkyAndSun(), 4},
          {"many lights", ManyLights(), 8},     {"clouds", NestedSmoke(), 8},
          {"lamps with holes", MixedLamps(), 8}};
}

bool Accepts(const SceneDescription& scene, const std::string& strategy) {
  SceneDescription copy = scene;
  ApplyStrategy(strategy, {}, copy.strategy);
  PlanOptions options;
  options.max_depth = static_cast<std::uint32_t>(scene.integrator.max_depth);
  try {
    MakePlan(PrepareScene(copy), options);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

std::size_t AxisOf(const std::string& key) {
  const auto at = std::find_if(Axes().begin(), Axes().end(),
                               [&](const Axis& axis) { return axis.key == key; });
  REQUIRE(at != Axes().end());
  return static_cast<std::size_t>(at - Axes().begin());
}

// The combination as this scene takes it. What refuses reuse=block are choices of other
// axes, and control variates are what else a scene refuses.
Combination FitTo(const SceneDescription& scene, const Combination& combination,
                  bool keep_reuse) {
  Combination fitted = combination;
  const auto fits = [&] { return Accepts(scene, StrategyOf(Axes(), fitted)); };
  if (fits()) return fitted;
  if (combination[AxisOf("reuse")] != 0) {
    if (keep_reuse) {
      for (const char* key : {"control", "roulette", "allocation"}) {
        fitted[AxisOf(key)] = 0;
      }
      CHECK(fits());
      return fitted;
    }
    fitted[AxisOf("reuse")] = 0;
    if (fits()) return fitted;
  }
  CHECK(fitted[AxisOf("control")] != 0);
  fitted[AxisOf("control")] = 0;
  CHECK(fits());
  return fitted;
}

stat::ImageTestResult Compare(const HardScene& hard, const std::string& strategy,
                              const stat::ImageEstimate& truth, std::uint64_t spp,
                              std::uint64_t seed, double false_alarm) {
  const stat::ImageTestOptions options = {hard.tile, false_alarm, kFloatTolerance, 1e-7};
  if (strategy.find("reuse=block") == std::string::npos) {
    return stat::CompareMeans(EstimateWith(hard.scene, strategy, spp, seed), truth,
                              options);
  }
  return stat::CompareMeans(RenderTiles(hard.scene, strategy, spp, seed, hard.tile),
                            TilesOf(truth, hard.tile),
                            {1, false_alarm, kFloatTolerance, 1e-7});
}

// The smallest relative error of an image that a comparison with each choice finds.
class Power {
 public:
  void Add(const Combination& combination, double detectable) {
    for (std::size_t axis = 0; axis < Axes().size(); ++axis) {
      const auto at = least_.try_emplace({axis, combination[axis]}, detectable).first;
      at->second = std::min(at->second, detectable);
    }
  }
  void Check(double wanted) const {
    for (const auto& [choice, least] : least_) {
      const Axis& axis = Axes()[choice.first];
      INFO(axis.key << "=" << axis.values[choice.second]);
      CHECK(least < wanted);
    }
  }
  bool SawEveryChoice() const {
    std::size_t choices = 0;
    for (const Axis& axis : Axes()) choices += axis.values.size();
    return least_.size() == choices;
  }

 private:
  std::map<std::pair<std::size_t, std::size_t>, double> least_;
};

// Renders every combination and compares it with `truth`.
void CheckAll(const HardScene& hard, const stat::ImageEstimate& truth, std::uint64_t spp,
              Power& power) {
  const auto& combinations = Combinations();
  std::vector<double> uniformity;
  for (std::size_t i = 0; i < combinations.size(); ++i) {
    const Combination fitted = FitTo(hard.scene, combinations[i], i % 2 == 0);
    const std::string strategy = StrategyOf(Axes(), fitted);
    const stat::ImageTestResult result =
        Compare(hard, strategy, truth, spp, i + 1,
                stat::SidakLevel(kFalseAlarm, int(kScenes * combinations.size())));
    INFO(hard.name << ", " << strategy << ": " << result.ToString());
    // So few bright samples that their mean is far from normal (uniform directions, tiny
    // light, roulette that knows of no light): a test would reject good renders and find
    // no fault. Power::Check asks that every choice is judged elsewhere.
    if (result.detectable_bias > kJudged) continue;
    CHECK(result.same);
    uniformity.push_back(result.uniformity_p);
    power.Add(fitted, result.detectable_bias);
  }
  REQUIRE(!uniformity.empty());
  const double least = *std::min_element(uniformity.begin(), uniformity.end());
  CHECK(least > stat::SidakLevel(kFalseAlarm, int(uniformity.size())));
}

stat::ImageEstimate Reference(const SceneDescription& scene, int samples) {
  const reference::Textures textures(scene.textures);
  ReferenceOptions options =
      TexturedOptions(textures, ReferenceEstimator::kLightSampling, samples);
  options.environment = SkyRadiance;
  return Estimate(RenderReference(scene, options));
}

}  // namespace

TEST_CASE("the combinations cover every pair of choices", "[strategy]") {
  CHECK(Combinations().size() >= 60);
  CHECK(CountUncoveredPairs(Axes(), Combinations()) == 0);
  std::vector<Combination> fewer = Combinations();
  fewer.resize(20);
  CHECK(CountUncoveredPairs(Axes(), fewer) > 0);
}

TEST_CASE("every combination renders the reference image", "[strategy]") {
  Power power;
  for (const HardScene& hard : HardScenes()) {
    CheckAll(hard, Reference(hard.scene, 16384), 1024, power);
  }
  power.Check(0.03);
  CHECK(power.SawEveryChoice());
}

TEST_CASE("every combination renders the reference image, at length",
          "[strategy][slow]") {
  Power power;
  for (const HardScene& hard : HardScenes()) {
    CheckAll(hard, Reference(hard.scene, 262144), 16384, power);
  }
  power.Check(0.0075);
  CHECK(power.SawEveryChoice());
}

TEST_CASE("every combination fills the closed room as the closed form says",
          "[strategy]") {
  const double albedo = 0.9;
  const int depth = 8;
  const HardScene room = {"closed room", ClosedBox(albedo, depth), 4};
  const double value = closed_form::ClosedRoom(1, albedo, depth);
  const int size = room.scene.film.width;
  Power power;
  CheckAll(room,
           stat::KnownImage(size, room.scene.film.height,
                            [&](int, int) { return Grey(value); }),
           256, power);
  // Set by directions=uniform; all other choices find 2 %.
  power.Check(0.08);
}

TEST_CASE("a bias of 1 % is found", "[strategy]") {
  // A reference whose emission is 1 % too strong stands for any error of that size: a
  // density, a cosine or a 1 / (1 - q) that is off by 1 %.
  const SceneDescription scene = LargeLight();
  SceneDescription brighter = scene;
  for (AreaLight& light : brighter.area_lights) light.scale *= 1.01;
  const std::string strategy = "directions=mis,points=independent";
  const stat::ImageEstimate image = EstimateWith(scene, strategy, 65536, 1);
  const stat::ImageEstimate truth = EstimateWith(scene, strategy, 65536, 2);
  const stat::ImageEstimate planted = EstimateWith(brighter, strategy, 65536, 2);
  const stat::ImageTestOptions options = {8, 1e-6, kFloatTolerance, 1e-7};
  CHECK(stat::CompareMeans(image, truth, options).same);
  CHECK(stat::CompareMeans(image, truth, options).detectable_bias < 0.01);
  CHECK_FALSE(stat::CompareMeans(image, planted, options).same);
}

TEST_CASE("a probability of selecting a light that is 1 % wrong is found", "[strategy]") {
  const SceneDescription scene = PolygonLight(8);
  CompiledScene compiled = PrepareScene(scene);
  Strategy strategy;
  ApplyStrategy("directions=light,points=independent", {}, strategy);
  UseStrategy(strategy, compiled);
  PlanOptions plan_options;
  plan_options.max_depth = 1;
  const auto render = [&](std::uint64_t seed) {
    const ThreadLimit limit(2);
    Rendered out{
        FilmAccumulator(0, 0, 8, 8, GroupsOf(compiled.strategy), Auxiliary::kNone),
        {},
        MakePlan(compiled, plan_options)};
    RunOptions run;
    run.spp = 8192;
    run.seed = seed;
    out.result = Run(compiled, out.plan, run, out.film);
    return Estimate(out);
  };
  const stat::ImageEstimate good = render(1), again = render(2);
  for (LightRecord& light : compiled.lights.lights) light.pmf *= 0.99f;
  const stat::ImageEstimate wrong = render(2);
  const stat::ImageTestOptions options = {8, 1e-6, kFloatTolerance, 1e-7};
  CHECK(stat::CompareMeans(good, again, options).same);
  CHECK(stat::CompareMeans(good, again, options).detectable_bias < 0.01);
  CHECK_FALSE(stat::CompareMeans(good, wrong, options).same);
}

}  // namespace lanelight::test

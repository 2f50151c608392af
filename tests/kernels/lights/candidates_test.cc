// Resampled light samples: the choice among known candidates against its definition, the
// numbers of further candidates, and whole renders against what theory says of them.
#include <catch2/catch.hpp>

#include <array>
#include <numbers>

#include "kernels/stages.h"
#include "src/render/plan/plan_features.h"
#include "tests/kernels/control/control_scenes.h"
#include "tests/support/each_target.h"
#include "tests/support/wave_fixture.h"

namespace lanelight::test {
namespace {

constexpr std::uint32_t kDraws = 1 << 14;
constexpr Rgb kAlbedo = {0.8, 0.5, 0.2}, kBeta = {0.3, 0.6, 0.9};

struct Candidate {
  Vec3d direction;
  Rgb light;  // radiance over density
  double pdf;
};
using Candidates = std::vector<Candidate>;

// Of different brightness, colour and height; one below the horizon, one black.
Candidates Known() {
  return {{Normalize(Vec3d{1, 2, 3}), {4, 3, 2}, 0.4},
          {Normalize(Vec3d{1, 0, -1}), {50, 50, 50}, 0.1},
          {Normalize(Vec3d{-2, 0.5, 1}), {1, 6, 9}, 2.0},
          {{0, 0, 1}, {0, 0, 0}, 1.0},
          {{0, 0, 1}, {0.2, 0.1, 2}, 0}};
}

// Returns what a Lambertian surface of normal +z sends towards the path's origin; with
// `weighs`, by the power heuristic against its cosine density.
Rgb Carried(const Candidate& c, bool weighs) {
  const double pdf = std::max(c.direction.z, 0.0) / std::numbers::pi;
  double factor = pdf;
  if (weighs && c.pdf > 0) factor *= 1 / (1 + std::pow(pdf / c.pdf, 2));
  return {kBeta.x * kAlbedo.x * c.light.x * factor,
          kBeta.y * kAlbedo.y * c.light.y * factor,
          kBeta.z * kAlbedo.z * c.light.z * factor};
}

double Sum(const Candidates& candidates, bool weighs) {
  double sum = 0;
  for (const Candidate& c : candidates) sum += Luminance(Carried(c, weighs));
  return sum;
}

// Paths on a Lambertian surface that are all offered the same candidates. Their numbers
// of the choice fill [0, 1) evenly, so that what is kept how often is known, not random.
struct Vertices {
  CompiledScene scene = MakeScene({});
  WaveFixture fixture{scene, kDraws};

  explicit Vertices(bool weighs) {
    PathColumns& p = fixture.wave.path;
    if (weighs) fixture.run.features.Add(Feature::kMis);
    for (std::uint32_t i = 0; i < kDraws; ++i) {
      p.d_x[i] = 0, p.d_y[i] = 0, p.d_z[i] = -1;
      p.ng_x[i] = p.ns_x[i] = 0, p.ng_y[i] = p.ns_y[i] = 0, p.ng_z[i] = p.ns_z[i] = 1;
      p.material[i] = 0;
      Put(p.beta_r, p.beta_g, p.beta_b, i, kBeta);
      Put(p.color0_r, p.color0_g, p.color0_b, i, kAlbedo);
      p.u_candidate[i] = (static_cast<float>(i) + 0.5f) / kDraws;
      p.u_select[i] = p.u_light_0[i] = p.u_light_1[i] = 0.25f;
    }
    fixture.QueueAll(QueueId::kLit, kDraws);
    fixture.QueueAll(ShadeQueue(ShadeKind::kDiffuse), kDraws);
  }
  static void Put(float* r, float* g, float* b, std::uint32_t i, Rgb c) {
    r[i] = static_cast<float>(c.x), g[i] = static_cast<float>(c.y);
    b[i] = static_cast<float>(c.z);
  }
  void AddCandidate(const Candidate& c, std::uint32_t light) {
    PathColumns& p = fixture.wave.path;
    for (std::uint32_t i = 0; i < kDraws; ++i) {
      Put(p.ls_x, p.ls_y, p.ls_z, i, c.direction);
      Put(p.ls_r, p.ls_g, p.ls_b, i, c.light);
      p.ls_pdf[i] = static_cast<float>(c.pdf);
      p.ls_distance[i] = static_cast<float>(light + 1);
      p.ls_light[i] = light;
    }
    fixture.Run(ConsiderStage, fixture.run.features);
  }
  void Run(const Candidates& candidates) {
    fixture.run.candidates = static_cast<std::uint32_t>(candidates.size());
    fixture.Run(BeginCandidatesStage, fixture.run.features);
    for (std::uint32_t j = 0; j < candidates.size(); ++j) AddCandidate(candidates[j], j);
    fixture.Run(KeepCandidateStage, fixture.run.features);
  }
};

// Each is kept as often as its share of the sum says; what is kept has its own direction,
// distance, density, and such a radiance that it carries the mean of all.
void CheckKept(const Vertices& vertices, const Candidates& candidates, bool weighs) {
  const PathColumns& p = vertices.fixture.wave.path;
  const double sum = Sum(candidates, weighs), count = double(candidates.size());
  std::vector<int> kept(candidates.size());
  bool same = true;
  for (std::uint32_t i = 0; i < kDraws; ++i) {
    const std::uint32_t j = p.ls_light[i];
    REQUIRE(j < candidates.size());
    ++kept[j];
    const Candidate& c = candidates[j];
    same &= p.ls_distance[i] == static_cast<float>(j + 1) &&
            p.ls_pdf[i] == static_cast<float>(c.pdf) &&
            p.ls_x[i] == static_cast<float>(c.direction.x) &&
            p.ls_z[i] == static_cast<float>(c.direction.z);
    const Candidate scaled = {
        c.direction, {double{p.ls_r[i]}, double{p.ls_g[i]}, double{p.ls_b[i]}}, c.pdf};
    const double carried = Luminance(Carried(scaled, weighs));
    same &= std::abs(carried * count / sum - 1) < 1e-5;
  }
  CHECK(same);
  for (std::size_t j = 0; j < candidates.size(); ++j) {
    INFO("candidate " << j);
    const double fraction = Luminance(Carried(candidates[j], weighs)) / sum;
    // Those that keep it lie in up to 2^j intervals, each cut off at both ends.
    CHECK(kept[j] == Approx(fraction * kDraws).margin(fraction > 0 ? 1 << (j + 1) : 0));
  }
}

TestRender OptionsFor(const std::string& strategy, std::uint64_t spp) {
  TestRender options;
  options.spp = spp;
  options.strategy = strategy;
  return options;
}

// Lights of several shapes around a point that nothing shadows.
SceneDescription Unshadowed() {
  SceneBuilder b = PointReceiver(Lambert({0.6, 0.5, 0.4}));
  const Index dark = b.AddDiffuse(Grey(0));
  b.AddSphere({1.5, 0, 1}, 0.2, dark, b.AddEmission({9, 9, 9}));
  b.AddDisk({-1, 1, 1}, {1, -1, -1}, 0.4, dark, b.AddEmission({5, 5, 5}));
  b.AddQuad({-1, -2, 0.1}, {2, 0, 0}, {0, 0, 2}, dark, b.AddEmission({3, 3, 3}));
  b.AddPoint({0, 0.3, 2}, {4, 4, 4});
  return b.Build();
}

}  // namespace

TEST_CASE("a candidate is kept in proportion to its weight", "[light]") {
  const EachTarget target;
  for (const bool weighs : {false, true}) {
    const Candidates all = Known();
    CAPTURE(weighs);
    Vertices vertices(weighs);
    vertices.Run(all);
    CheckKept(vertices, all, weighs);
    const Candidates backwards(all.rbegin(), all.rend());
    Vertices reversed(weighs);
    reversed.Run(backwards);
    CheckKept(reversed, backwards, weighs);
  }
}

TEST_CASE("no shadow ray is traced where all candidates have weight zero", "[light]") {
  Vertices vertices(true);
  const Candidates all = Known();
  vertices.Run({all[3], all[1]});
  const PathColumns& p = vertices.fixture.wave.path;
  for (std::uint32_t i : {0u, 77u, kDraws - 1}) {
    CHECK(p.ls_r[i] == 0);
    CHECK(p.ls_light[i] == 1);
    CHECK(p.ls_x[i] == static_cast<float>(all[1].direction.x));
  }
}

TEST_CASE("candidate weights over 60 decades give no NaN", "[light]") {
  Vertices vertices(false);
  Candidates all = {Known()[0], Known()[2], Known()[4]};
  all[0].light = Grey(1e-30), all[1].light = Grey(3e37), all[2].light = Grey(1e30);
  vertices.Run(all);
  const PathColumns& p = vertices.fixture.wave.path;
  int kept = 0;
  for (std::uint32_t i = 0; i < kDraws; ++i) {
    CHECK(std::isfinite(p.ls_g[i]));
    kept += p.ls_light[i] == 1;
  }
  CHECK(kept == kDraws);
}

TEST_CASE("numbers of further candidates are shifted on their grid", "[light]") {
  Vertices vertices(false);
  PathColumns& p = vertices.fixture.wave.path;
  constexpr std::uint32_t kGrid = 1 << 24;
  const auto number = [&](std::uint32_t i) { return i * 40503u * 2654435761u >> 8; };
  for (std::uint32_t i = 0; i < kDraws; ++i) {
    p.u_light_0[i] = static_cast<float>(number(i)) * 0x1p-24f;
  }
  p.u_light_0[5] = 0, p.u_light_0[6] = 1 - 0x1p-24f;
  std::vector<float> before(p.u_light_0, p.u_light_0 + kDraws);
  vertices.Run({Known()[0]});
  // Every number by the same step modulo 1, exactly: a permutation of the grid.
  const auto on_grid = [&](float u) { return static_cast<std::uint32_t>(u * kGrid); };
  const std::uint32_t step = (on_grid(p.u_light_0[0]) - on_grid(before[0])) % kGrid;
  CHECK(step > 0);
  bool same = true;
  for (std::uint32_t i = 0; i < kDraws; ++i) {
    same &= p.u_light_0[i] >= 0 && p.u_light_0[i] < 1 &&
            on_grid(p.u_light_0[i]) * 0x1p-24f == p.u_light_0[i] &&
            (on_grid(before[i]) + step) % kGrid == on_grid(p.u_light_0[i]);
  }
  CHECK(same);
}

TEST_CASE("light is sampled once per candidate, and one sample is kept", "[light]") {
  const TestRender options = OptionsFor("light-candidates=resampled:3", 4);
  const Rendered r = RenderDescription(Unshadowed(), options);
  std::map<std::string, std::uint64_t> items;
  for (const StageProfile& stage : r.result.stages) items[stage.name] = stage.items;
  CHECK(items.at("light_keep") > 0);
  CHECK(items.at("light_candidates") == items.at("light_keep"));
  CHECK(items.at("light_consider") == 3 * items.at("light_keep"));
  CHECK(items.at("light_select_table") == 3 * items.at("light_keep"));
}

TEST_CASE("without occlusion, M candidates have the variance of M light samples",
          "[light]") {
  const SceneDescription scene = Unshadowed();
  constexpr std::uint64_t kSpp = 16384;
  const std::string plain = "directions=light,points=independent,seen-lights=paths";
  const Rendered one = RenderWith(scene, plain, kSpp);
  for (const int count : {2, 8}) {
    INFO(count);
    const Rendered resampled = RenderWith(
        scene, fmt::format("{},light-candidates=resampled:{}", plain, count), kSpp, 2);
    CHECK(Compare(one, resampled).same);
    CHECK(Compare(one, resampled).detectable_bias < 0.02);
    // Luminance is what candidates are chosen by; other colours of grey lights follow it.
    CHECK(MeanVariance(resampled) < 1.1 / count * MeanVariance(one));
    // At most one of each path of 4 x 4 pixels.
    CHECK(resampled.result.rays_shadow <= 16 * kSpp);
  }
}

TEST_CASE("resampled light does not depend on threads and wavefront", "[light]") {
  for (const std::string strategy :
       {"light-candidates=resampled:3,light-selection=tree,roulette=adjoint",
        "light-candidates=resampled,pairs=antithetic"}) {
    CheckDeterminism(Unshadowed(), strategy, 8);
  }
}

TEST_CASE("resampling without effect is reported", "[light]") {
  const auto notes = [](const SceneDescription& description) {
    SceneDescription copy = description;
    ApplyStrategy("light-candidates=resampled", {}, copy.strategy);
    const PreparedScene scene = PrepareScene(copy);
    const Plan plan = MakePlan(scene, {});
    CHECK(plan.notes.empty() ==
          (plan.paths().first_repeated < plan.paths().last_repeated));
    return plan.notes;
  };
  SceneBuilder point = PointReceiver(Lambert(Grey(0.5)));
  CHECK(notes(point.Build()).size() == 1);
  point.AddPoint({0, 0, 2}, {4, 4, 4});
  const auto alike = notes(point.Build());
  REQUIRE(alike.size() == 1);
  CHECK(alike[0].find("all samples of the only light are alike") != std::string::npos);
  CHECK(notes(Unshadowed()).empty());
}

}  // namespace lanelight::test

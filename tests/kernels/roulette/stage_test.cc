// Single decisions: what roulette and splitting do to throughputs, names and budgets.
#include <catch2/catch.hpp>
#include <random>
#include <set>

#include "kernels/stages.h"
#include "src/scene/prepare/tables.h"
#include "tests/support/wave_fixture.h"

namespace lanelight {
namespace {

constexpr std::uint32_t kPaths = 512;

CompiledScene Floor() {
  Geometry g;
  g.planes = {MakePlane({0, 0, 0}, {0, 0, 1})};
  return MakeScene(std::move(g));
}

// Paths of random throughput on a floor, at a depth.
struct Paths {
  explicit Paths(std::uint32_t depth) : fixture(scene, kPaths * kMaxSplitPaths) {
    PathColumns& p = fixture.wave.path;
    std::mt19937 engine(3);
    std::uniform_real_distribution<float> uniform;
    for (std::uint32_t i = 0; i < kPaths; ++i) {
      p.pixel[i] = i, p.sample[i] = 0, p.output[i] = i * kMaxSplitPaths;
      p.depth[i] = depth, p.branch[i] = 0, p.budget[i] = kMaxSplitPaths;
      p.beta_r[i] = 3 * std::pow(uniform(engine), 4.0f);
      p.beta_g[i] = 3 * std::pow(uniform(engine), 4.0f);
      p.beta_b[i] = 3 * std::pow(uniform(engine), 4.0f);
      p.l_r[i] = p.l_g[i] = p.l_b[i] = 5;
      p.eta_scale[i] = 1, p.u_roulette[i] = uniform(engine);
      p.p_x[i] = uniform(engine), p.p_y[i] = uniform(engine), p.p_z[i] = 0;
      p.ng_x[i] = p.ng_y[i] = 0, p.ng_z[i] = 1;
      p.d_x[i] = p.d_y[i] = 0, p.d_z[i] = -1;
      before.push_back({p.beta_r[i], p.beta_g[i], p.beta_b[i]});
    }
    fixture.run.tables = &tables;
    fixture.run.roulette = {0.25f, 0, 2};
    Queue& free = fixture.wave.queue(QueueId::kFree);
    for (std::uint32_t i = kPaths * kMaxSplitPaths; i-- > kPaths;) {
      free.items[free.size++] = i;
    }
  }
  Vec3f Beta(std::uint32_t slot) const {
    const PathColumns& p = fixture.wave.path;
    return {p.beta_r[slot], p.beta_g[slot], p.beta_b[slot]};
  }
  float Largest(std::uint32_t slot) const {
    const Vec3f b = Beta(slot);
    return std::max({b.x, b.y, b.z});
  }
  Queue& queue(QueueId id) { return fixture.wave.queue(id); }

  CompiledScene scene = Floor();
  StrategyTables tables;
  WaveFixture fixture;
  std::vector<Vec3f> before;
};

void CheckSurvivors(StageOn stage, const FeatureSet& features, float floor,
                    std::uint32_t depth, bool decides) {
  Paths paths(depth);
  paths.fixture.run.roulette.floor = floor;
  paths.fixture.QueueAll(QueueId::kScattered, kPaths);
  paths.fixture.Run(stage, features);
  const Queue& alive = paths.queue(QueueId::kScattered);
  CHECK(alive.size + paths.queue(QueueId::kDone).size == kPaths);
  CHECK((alive.size < kPaths) == decides);
  for (std::uint32_t i = 0; i < alive.size; ++i) {
    const std::uint32_t slot = alive.items[i];
    const Vec3f b = paths.before[slot];
    const float largest = std::max({b.x, b.y, b.z});
    if (!decides) {
      CHECK(paths.Largest(slot) == largest);
    } else if (floor == 0) {
      // roulette=throughput: nothing is scaled above 1.
      CHECK(paths.Largest(slot) <= std::max(1.00001f, largest));
    } else {
      CHECK(paths.Largest(slot) <= largest / floor * 1.00001f);
    }
  }
}

// A cache of one cell whose paths are all worth `value` in a pixel of brightness 1.
void SetValues(Paths& paths, float value) {
  PathValues& v = paths.tables.path_values;
  v.survive.assign(v.grid.cells(), value);
  v.inverse_pixel.assign(kPaths * 3, 1 / std::sqrt(3.0f));
}

}  // namespace

TEST_CASE("survivors' weights are bounded", "[roulette]") {
  for (std::uint32_t depth : {1u, 2u, 5u}) {
    CheckSurvivors(ThroughputRouletteStage, {}, 0, depth, depth >= 2);
    CheckSurvivors(ThroughputRouletteStage, {}, 0.05f, depth, depth >= 2);
  }
}

TEST_CASE("splitting divides branch indices, budgets and throughput", "[roulette]") {
  Paths paths(1);
  SetValues(paths, 2);
  paths.fixture.QueueAll(QueueId::kSurface, kPaths);
  paths.fixture.Run(AdjointRouletteStage, {});
  const PathColumns& p = paths.fixture.wave.path;
  const Queue& alive = paths.queue(QueueId::kSurface);
  CHECK(alive.size > kPaths / 4);
  CHECK(paths.queue(QueueId::kDone).size > 0);
  std::vector<std::uint32_t> budget(kPaths), copies(kPaths), names(kPaths);
  std::vector<float> gathered(kPaths);
  std::set<std::uint32_t> slots;
  for (std::uint32_t i = 0; i < alive.size; ++i) {
    const std::uint32_t slot = alive.items[i], of = p.pixel[slot];
    CHECK(slots.insert(slot).second);
    CHECK(p.output[slot] == of * kMaxSplitPaths + p.branch[slot]);
    CHECK(p.branch[slot] + p.budget[slot] <= kMaxSplitPaths);
    for (std::uint32_t k = 0; k < p.budget[slot]; ++k) {
      const std::uint32_t name = 1u << (p.branch[slot] + k);
      CHECK((names[of] & name) == 0);
      names[of] |= name;
    }
    budget[of] += p.budget[slot];
    gathered[of] += p.l_g[slot];
    ++copies[of];
    // Weight 1 / r: bounded, and the same for all copies.
    CHECK(p.beta_g[slot] <= paths.before[of].y * 20.001f);
    CHECK(p.beta_g[slot] == p.beta_g[of]);
  }
  for (std::uint32_t i = 0; i < kPaths; ++i) {
    if (copies[i] == 0) continue;
    CHECK(budget[i] == kMaxSplitPaths);
    CHECK(gathered[i] == 5);
    // k = floor(r + u), r = before / after.
    const double r = double(paths.before[i].y) / p.beta_g[i];
    CHECK(copies[i] >= std::floor(r - 1e-4));
    CHECK(copies[i] <= std::ceil(r + 1e-4));
  }
}

TEST_CASE("the mean number of split paths is r", "[roulette]") {
  // Below and above the window of adjoint, to its nearer edge.
  for (const auto& [beta, r] : {std::pair{0.2f, 0.6}, {2.4f, 1.44}, {1.2f, 1.0}}) {
    double copies = 0;
    constexpr int kRuns = 64;
    for (int run = 0; run < kRuns; ++run) {
      Paths paths(3);
      SetValues(paths, 1);
      PathColumns& p = paths.fixture.wave.path;
      paths.fixture.run.seed = static_cast<std::uint32_t>(run);
      for (std::uint32_t i = 0; i < kPaths; ++i) {
        p.beta_r[i] = p.beta_g[i] = p.beta_b[i] = beta;
      }
      paths.fixture.QueueAll(QueueId::kSurface, kPaths);
      paths.fixture.Run(AdjointRouletteStage, {});
      copies += paths.queue(QueueId::kSurface).size;
    }
    const double n = double(kPaths) * kRuns;
    const double fraction = r - std::floor(r);
    const double error = std::sqrt(fraction * (1 - fraction) / n);
    // Five standard errors of a Bernoulli variable.
    CHECK(std::abs(copies / n - r) <= 5 * error + 1e-6);
  }
}

TEST_CASE("camera hits always survive, and unknown cells use throughput roulette",
          "[roulette]") {
  Paths first(0);
  SetValues(first, 0);
  first.fixture.QueueAll(QueueId::kSurface, kPaths);
  first.fixture.Run(AdjointRouletteStage, {});
  CHECK(first.queue(QueueId::kSurface).size == kPaths);

  for (std::uint32_t depth : {1u, 2u}) {
    Paths unknown(depth);
    SetValues(unknown, -1);
    unknown.fixture.QueueAll(QueueId::kSurface, kPaths);
    unknown.fixture.Run(AdjointRouletteStage, {});
    const Queue& alive = unknown.queue(QueueId::kSurface);
    CHECK((alive.size < kPaths) == (depth == 2));
    for (std::uint32_t i = 0; i < alive.size; ++i) {
      const Vec3f b = unknown.before[alive.items[i]];
      CHECK(unknown.Largest(alive.items[i]) <=
            std::max(1.00001f, std::max({b.x, b.y, b.z})));
    }
  }
}

}  // namespace lanelight

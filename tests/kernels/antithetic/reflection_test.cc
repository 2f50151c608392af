// pairs=antithetic on a hand-made wavefront: the numbers of odd samples are reflected, of
// even ones untouched, and of the dimensions that are not paired as well.
#include <catch2/catch.hpp>
#include <random>

#include "kernels/stages.h"
#include "src/scene/prepare/parameters.h"
#include "tests/support/each_target.h"
#include "tests/support/wave_fixture.h"

namespace lanelight {
namespace {

constexpr std::uint32_t kPaths = 101;
constexpr float kUnit = 0x1p-24f;

// The change of a number in an odd sample.
enum class Change { kNone, kReflect, kRotate };

// The columns, and what each choice of pairs does to them at a depth.
struct Column {
  float* PathColumns::* column;
  Change change;          // if paired
  const char* paired_by;  // letters of the choices below
};
// a: all, p: pixel, l: light, b: bsdf, f: first-bounce (at depth 0)
constexpr Column kColumns[] = {{&PathColumns::u_film_0, Change::kReflect, "ap"},
                               {&PathColumns::u_film_1, Change::kReflect, "ap"},
                               {&PathColumns::u_lens_0, Change::kReflect, "ap"},
                               {&PathColumns::u_lens_1, Change::kReflect, "ap"},
                               {&PathColumns::u_lobe, Change::kReflect, "abf"},
                               {&PathColumns::u_bsdf_0, Change::kReflect, "abf"},
                               {&PathColumns::u_bsdf_1, Change::kRotate, "abf"},
                               {&PathColumns::u_select, Change::kReflect, "alf"},
                               {&PathColumns::u_light_0, Change::kReflect, "alf"},
                               {&PathColumns::u_light_1, Change::kReflect, "alf"},
                               {&PathColumns::u_roulette, Change::kReflect, "a"}};

// On the grid of 24 bits: k goes to 2^24 - 1 - k, or half way round.
float Expected(float u, Change change) {
  const auto k = static_cast<std::uint32_t>(u * 0x1p24f);
  switch (change) {
    case Change::kReflect:
      return static_cast<float>(0xffffffu - k) * kUnit;
    case Change::kRotate:
      return static_cast<float>((k + 0x800000u) & 0xffffffu) * kUnit;
    case Change::kNone:
      break;
  }
  return u;
}

struct PairedPaths {
  CompiledScene scene;
  WaveFixture fixture;
  std::vector<std::vector<float>> before;

  PairedPaths() : fixture(scene, kPaths) {
    std::mt19937 engine(7);
    PathColumns& p = fixture.wave.path;
    for (std::uint32_t i = 0; i < kPaths; ++i) {
      p.sample[i] = engine() % 64, p.depth[i] = engine() % 3;
    }
    for (const Column& c : kColumns) {
      float* column = p.*c.column;
      for (std::uint32_t i = 0; i < kPaths; ++i) {
        column[i] = static_cast<float>(engine() >> 8) * kUnit;
      }
      column[3] = 0, column[4] = 1 - kUnit, column[5] = 0.5f, column[6] = 0.5f - kUnit;
      before.emplace_back(column, column + kPaths);
    }
  }
  // Both stages, as the plan runs them, on every path but those of Left().
  void Run(const std::string& choice) {
    Strategy strategy;
    ApplyStrategy("pairs=antithetic:" + choice, {}, strategy);
    fixture.run.pairs = MakeAntitheticParameters(strategy);
    for (QueueId id : {QueueId::kCamera, QueueId::kSurface}) {
      Queue& queue = fixture.wave.queue(id);
      queue.size = 0;
      for (std::uint32_t i = kPaths; i-- > 0;) {
        if (!Left(i)) queue.items[queue.size++] = i;
      }
    }
    fixture.Run(AntitheticCameraStage, {Feature::kAntitheticPairs});
    fixture.Run(AntitheticBounceStage, {Feature::kAntitheticPairs});
  }
  static bool Left(std::uint32_t i) { return i % 10 == 9; }
};

}  // namespace

TEST_CASE("antithetic: odd samples are reflected in the paired dimensions only",
          "[pairs]") {
  const std::pair<const char*, char> choices[] = {
      {"all", 'a'}, {"pixel", 'p'}, {"light", 'l'}, {"bsdf", 'b'}, {"first-bounce", 'f'}};
  const EachTarget target;
  for (const auto& [choice, letter] : choices) {
    PairedPaths paths;
    paths.Run(choice);
    const PathColumns& p = paths.fixture.wave.path;
    for (std::size_t c = 0; c < std::size(kColumns); ++c) {
      const Column& column = kColumns[c];
      const bool paired = std::string(column.paired_by).find(letter) != std::string::npos;
      for (std::uint32_t i = 0; i < kPaths; ++i) {
        CAPTURE(choice, c, i, p.sample[i], p.depth[i]);
        const bool odd = p.sample[i] % 2 == 1 && !PairedPaths::Left(i);
        const bool at_depth = letter != 'f' || p.depth[i] == 0;
        const Change change = paired && odd && at_depth ? column.change : Change::kNone;
        REQUIRE((p.*column.column)[i] == Expected(paths.before[c][i], change));
      }
    }
  }
}

}  // namespace lanelight

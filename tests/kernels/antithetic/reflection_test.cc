// pairs=antithetic on a hand-made wavefront: the numbers of odd samples are reflected,
// and those of even ones untouched.
#include <catch2/catch.hpp>
#include <random>

#include "kernels/stages.h"
#include "tests/support/each_target.h"
#include "tests/support/wave_fixture.h"

namespace lanelight {
namespace {

constexpr std::uint32_t kPaths = 101;
constexpr float kUnit = 0x1p-24f;

// The change of a number in an odd sample.
enum class Change { kNone, kReflect, kRotate };

// The columns, and what happens to them in odd samples.
struct Column {
  float* PathColumns::* column;
  Change change = Change::kReflect;
};
constexpr Column kColumns[] = {{&PathColumns::u_film_0},
                               {&PathColumns::u_film_1},
                               {&PathColumns::u_lens_0},
                               {&PathColumns::u_lens_1},
                               {&PathColumns::u_lobe},
                               {&PathColumns::u_bsdf_0},
                               {&PathColumns::u_bsdf_1, Change::kRotate},
                               {&PathColumns::u_select},
                               {&PathColumns::u_light_0},
                               {&PathColumns::u_light_1},
                               {&PathColumns::u_roulette}};

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
      p.sample[i] = engine() % 64;
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
  void Run() {
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

TEST_CASE("antithetic: the numbers of odd samples are reflected", "[pairs]") {
  const EachTarget target;
  PairedPaths paths;
  paths.Run();
  const PathColumns& p = paths.fixture.wave.path;
  for (std::size_t c = 0; c < std::size(kColumns); ++c) {
    const Column& column = kColumns[c];
    for (std::uint32_t i = 0; i < kPaths; ++i) {
      CAPTURE(c, i, p.sample[i]);
      const bool odd = p.sample[i] % 2 == 1 && !PairedPaths::Left(i);
      const Change change = odd ? column.change : Change::kNone;
      REQUIRE((p.*column.column)[i] == Expected(paths.before[c][i], change));
    }
  }
}

}  // namespace lanelight

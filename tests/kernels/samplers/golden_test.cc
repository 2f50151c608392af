// The numbers of every dimension, written down: a new dimension, field or stage changes
// none of them. A change here changes every image, and is made alone.
#include <catch2/catch.hpp>

#include "kernels/stages.h"
#include "tests/support/each_target.h"
#include "tests/support/wave_fixture.h"

namespace lanelight {
namespace {

struct Golden {
  std::uint32_t depth, branch;
  float film[2], lens[2], bsdf[2], lobe, light[2], select, roulette, time, wavelength;
};

// Of pixel 12345, sample 678, seed 9; multiples of 2^-24.
constexpr float kUnit = 0x1p-24f;
constexpr Golden kGolden[] = {
    {0,
     0,
     {1717628, 10816061},
     {15408127, 9053166},
     {5372126, 12143234},
     6793788,
     {13307703, 16640117},
     10594590,
     15814949,
     14957396,
     13241101},
    {1,
     0,
     {14198913, 2813180},
     {13118741, 16747625},
     {1263800, 2874292},
     7889349,
     {14900568, 6400564},
     4851418,
     13149130,
     4561972,
     9519082},
    {5,
     0,
     {6624500, 709905},
     {11825225, 16322827},
     {13587271, 12670984},
     4812647,
     {5022210, 908252},
     12085126,
     3648586,
     6918565,
     5187760},
    {1,
     3,
     {16566969, 12267020},
     {998285, 14883601},
     {4081796, 13253068},
     8936409,
     {2467076, 14269220},
     15652006,
     3787818,
     13798588,
     3245890},
    {1048575,
     7,
     {8457260, 15778913},
     {15580445, 2141555},
     {16572938, 924653},
     8141322,
     {11843031, 6029700},
     7430235,
     16256241,
     15639547,
     11616592},
};

void CheckGolden(const Golden& g) {
  const CompiledScene scene;
  WaveFixture f(scene, 1);
  f.run.seed = 9;
  PathColumns& p = f.wave.path;
  AlignedVector<float> wavelength(1);  // which the fixture leaves out
  p.wavelength = wavelength.data();
  p.pixel[0] = 12345, p.sample[0] = 678;
  p.depth[0] = g.depth, p.branch[0] = g.branch;
  f.QueueAll(QueueId::kCamera, 1);
  f.QueueAll(QueueId::kVertex, 1);
  f.Run(IndependentCameraStage, {});
  f.Run(IndependentBounceStage, {});
  const float* found[] = {p.u_film_0,   p.u_film_1, p.u_lens_0,  p.u_lens_1,  p.u_bsdf_0,
                          p.u_bsdf_1,   p.u_lobe,   p.u_light_0, p.u_light_1, p.u_select,
                          p.u_roulette, p.time,     p.wavelength};
  const float expected[] = {g.film[0],  g.film[1], g.lens[0],   g.lens[1],  g.bsdf[0],
                            g.bsdf[1],  g.lobe,    g.light[0],  g.light[1], g.select,
                            g.roulette, g.time,    g.wavelength};
  for (int i = 0; i < 13; ++i) {
    INFO("number " << i << " is " << static_cast<int>(found[i][0] / kUnit) << " units");
    CHECK(found[i][0] == expected[i] * kUnit);
  }
}

}  // namespace

TEST_CASE("golden: the numbers of every dimension", "[points]") {
  const EachTarget target;
  for (const Golden& g : kGolden) {
    CAPTURE(g.depth, g.branch);
    CheckGolden(g);
  }
}

TEST_CASE("golden: ranges of dimensions do not overlap", "[points]") {
  const Dimension all[] = {Dimension::kFilm,      Dimension::kLens,  Dimension::kBsdf,
                           Dimension::kLobe,      Dimension::kLight, Dimension::kSelect,
                           Dimension::kRoulette,  Dimension::kMix,   Dimension::kTime,
                           Dimension::kWavelength};
  std::uint64_t used_bits = 0;
  for (Dimension d : all) {
    const auto first = static_cast<std::uint32_t>(d);
    const std::uint32_t count = d == Dimension::kMix ? kMixDimensions : 1;
    REQUIRE(first + count <= kDimensionsPerBounce);
    for (std::uint32_t i = first; i < first + count; ++i) {
      CHECK((used_bits >> i & 1) == 0);
      used_bits |= std::uint64_t{1} << i;
    }
  }
}

}  // namespace lanelight

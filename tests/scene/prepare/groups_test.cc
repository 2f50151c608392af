// Sequences of the samplers, what counts as an observation, and what is said about it.
#include "src/scene/prepare/parameters.h"

#include <catch2/catch.hpp>

#include "src/render/run/run.h"
#include "tests/kernels/samplers/draw.h"

namespace lanelight::test {
namespace {

std::string TextOf(SampleSequence sampler, std::uint64_t spp, bool pairs = false) {
  Strategy strategy;
  strategy.sampler = sampler;
  if (pairs) strategy.pairs = Pairs::kAntithetic;
  return PointsText(strategy, spp);
}

// Samples of each replicate, counted one by one.
void CheckCounts(const SampleGroups& groups) {
  std::uint64_t counts[kReplicates] = {};
  for (std::uint64_t n = 0; n <= 300; ++n) {
    std::uint64_t observations = 0;
    for (std::uint32_t r = 0; r < kReplicates; ++r) {
      CAPTURE(groups.unit, n, r);
      REQUIRE(groups.InReplicate(n, r) == counts[r]);
      observations += counts[r] > 0;
    }
    if (groups.replicates) REQUIRE(groups.Observations(n) == observations);
    ++counts[groups.Replicate(n)];
  }
}

}  // namespace

TEST_CASE("sequence lengths match the samplers' limits", "[points]") {
  for (SampleSequence sampler : kAllSequences) {
    INFO(Name(sampler));
    CHECK(MakeSamplerParameters(sampler).group_shift == LogSequence(sampler));
    // Sample counts begin anew after whole turns.
    CHECK(kSamplesPerSeed % (std::uint64_t{kReplicates} << LogSequence(sampler)) == 0);
    CHECK(LogSequence(sampler) < 24);  // PermuteOctaves
  }
  CHECK(LogSequence(SampleSequence::kIndependent) == 0);
  CHECK(1u << LogSequence(SampleSequence::kHalton) < 6561);
  CHECK(LogSequence(SampleSequence::kSobol) == 20);
}

TEST_CASE("independent samples or pairs are observations, others by replicate",
          "[points]") {
  for (SampleSequence sampler : kAllSequences) {
    for (Pairs pairs : {Pairs::kNone, Pairs::kAntithetic}) {
      Strategy strategy;
      strategy.sampler = sampler;
      strategy.pairs = pairs;
      const SampleGroups groups = GroupsOf(strategy);
      CHECK(groups.replicates == (sampler != SampleSequence::kIndependent));
      CHECK(groups.unit == (pairs == Pairs::kAntithetic ? 2u : 1u));
      CheckCounts(groups);
    }
  }
  CHECK(SampleGroups{1, false}.Observations(7) == 7);
  CHECK(SampleGroups{2, false}.Observations(7) == 3);
  CHECK(SampleGroups{2, true}.Observations(7) == 4);
  CHECK(SampleGroups{2, true}.Observations(6) == 3);
  CHECK(SampleGroups{1, true}.Observations(std::uint64_t{1} << 40) == 4);
}

TEST_CASE("the efficient sample counts are reported", "[points]") {
  CHECK(TextOf(SampleSequence::kIndependent, 7) == "independent");
  CHECK(TextOf(SampleSequence::kIndependent, 7, true) == "independent, antithetic pairs");
  CHECK(TextOf(SampleSequence::kStratified, 64) ==
        "stratified, 4 randomisations of 16 points");
  CHECK(TextOf(SampleSequence::kSobol, 8) == "sobol, 4 randomisations of 2 points");
  CHECK(TextOf(SampleSequence::kSobol, 0) == "sobol, 4 randomisations");
  CHECK(TextOf(SampleSequence::kHalton, 7) ==
        "halton, not stratified (needs 8 samples per pixel), so the same as independent");
  CHECK(TextOf(SampleSequence::kSobol, 100) ==
        "sobol, 4 randomisations of 25 points (64 or 128 samples are better stratified)");
  CHECK(TextOf(SampleSequence::kSobol, 9) ==
        "sobol, 4 randomisations of 2 or 3 points (8 or 16 samples are better "
        "stratified)");
  CHECK(TextOf(SampleSequence::kHalton, 16384) ==
        "halton, 4 randomisations of 4096 points");
  for (std::uint64_t spp : {16385, 20000, 32768}) {
    CHECK(TextOf(SampleSequence::kHalton, spp) ==
          "halton, 8 randomisations of up to 4096 points, the most that it stratifies");
  }
  CHECK(TextOf(SampleSequence::kHalton, 32769)
            .starts_with("halton, 12 randomisations of up to"));
  CHECK(TextOf(SampleSequence::kStratified, 128, true) ==
        "stratified, 4 randomisations of 16 pairs, antithetic pairs");
  CHECK(TextOf(SampleSequence::kHalton, 15, true) ==
        "halton, 4 randomisations of 2 pairs, antithetic pairs");
  CHECK(TextOf(SampleSequence::kHalton, 14, true).find("needs 16 samples") !=
        std::string::npos);
}

}  // namespace lanelight::test

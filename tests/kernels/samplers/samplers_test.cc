// Sample points of every sampler: uniform in two dimensions and in one, on the grid that
// antithetic reflection requires, and equal on all SIMD targets. They are independent of
// those of other keys, replicates, pixels and seeds.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "src/base/stat/distributions.h"
#include "src/base/stat/hypothesis.h"
#include "src/scene/prepare/parameters.h"
#include "src/vocabulary/path/dimensions.h"
#include "tests/base/stat/chi2.h"
#include "tests/base/stat/kolmogorov.h"
#include "tests/kernels/samplers/draw.h"
#include "tests/support/each_target.h"

namespace lanelight::test {
namespace {

constexpr std::uint32_t kPixels = 1 << 15;
constexpr double kFamily = 1e-6;

// p-value of the hypothesis that (a, b) are uniform over the unit square.
double UniformP(const std::vector<float>& a, const std::vector<float>& b) {
  constexpr std::size_t kSide = 16;
  std::vector<double> cells(kSide * kSide);
  for (std::size_t i = 0; i < a.size(); ++i) {
    ++cells[static_cast<std::size_t>(a[i] * kSide) * kSide +
            static_cast<std::size_t>(b[i] * kSide)];
  }
  const double expected = double(a.size()) / double(cells.size());
  return stat::ChiSquareTest(cells, std::vector<double>(cells.size(), expected)).p;
}

double KsP(const std::vector<float>& u) {
  return stat::KsUniformPValue(std::vector<double>(u.begin(), u.end()));
}

// One sample of many pixels.
SamplerQuery Across(SampleSequence sampler, std::uint32_t sample) {
  return {sampler, 3, 10, 20, sample, 1, kPixels};
}

// p-value of the hypothesis that two products have no correlation over pixels.
double CorrelationP(const std::vector<double>& a, const std::vector<double>& b) {
  double sa = 0, sb = 0, sab = 0, saa = 0, sbb = 0;
  const double n = double(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    sa += a[i];
    sb += b[i];
    sab += a[i] * b[i];
    saa += a[i] * a[i];
    sbb += b[i] * b[i];
  }
  const double r =
      (sab - sa * sb / n) / std::sqrt((saa - sa * sa / n) * (sbb - sb * sb / n));
  return 2 * stat::NormalCdf(-std::abs(r) * std::sqrt(n));
}

// For each pixel, the product of the centred first coordinates of two samples: what the
// order and the strata of the two have in common.
std::vector<double> Products(const SamplerQuery& q, std::uint32_t other) {
  SamplerQuery second = q;
  second.first_sample = other;
  const Drawn a = Draw(q), b = Draw(second);
  std::vector<double> products(a.u0.size());
  for (std::size_t i = 0; i < products.size(); ++i) {
    products[i] = (a.u0[i] - 0.5) * (b.u0[i] - 0.5);
  }
  return products;
}

}  // namespace

TEST_CASE("points: equal on all targets, on the grid of 2^-24, below 1", "[points]") {
  for (SampleSequence sampler : kAllSequences) {
    const std::uint32_t sequence = std::max(kReplicates << LogSequence(sampler), 1500u);
    for (std::uint32_t first : {0u, sequence - 1500, (1u << 31) - 3000}) {
      const SamplerQuery query = {sampler, 9, 123, 4, first, 2999};
      Drawn reference;
      std::vector<float> numbers;
      for (const std::string& target : AvailableTargets()) {
        ForceTarget(target);
        const Drawn p = Draw(query);
        const std::vector<float> n = DrawNumbers(query);
        if (reference.u0.empty()) reference = p, numbers = n;
        REQUIRE(p.u0 == reference.u0);
        REQUIRE(p.u1 == reference.u1);
        REQUIRE(n == numbers);
      }
      ForceTarget("");
      for (const auto& column : {reference.u0, reference.u1, numbers}) {
        for (float u : column) {
          REQUIRE(u >= 0);
          REQUIRE(u < 1);
          REQUIRE(u * 0x1p24f == std::floor(u * 0x1p24f));
        }
      }
    }
  }
}

TEST_CASE("points: every sample is uniform over pixels", "[points]") {
  const double level = stat::SidakLevel(kFamily, 7 * 5 * 4);
  for (SampleSequence sampler : kAllSequences) {
    for (std::uint32_t sample : {0u, 1u, 4u, 53u, (1u << 31) - 1}) {
      INFO(Name(sampler) << ", sample " << sample);
      const Drawn p = Draw(Across(sampler, sample));
      CHECK(UniformP(p.u0, p.u1) > level);
      CHECK(KsP(p.u0) > level);
      CHECK(KsP(p.u1) > level);
      CHECK(KsP(DrawNumbers(Across(sampler, sample))) > level);
    }
  }
}

TEST_CASE("points: other keys, replicates, sequences, pixels and seeds are independent",
          "[points]") {
  const double level = stat::SidakLevel(kFamily, 7 * 5 * 3);
  for (SampleSequence sampler : kAllSequences) {
    const SamplerQuery base = Across(sampler, 2);
    SamplerQuery key = base, replicate = base, sequence = base, pixel = base, seed = base;
    key.key = 21;
    replicate.first_sample += 1;
    sequence.first_sample += kReplicates << LogSequence(sampler);
    pixel.pixel += 1;
    seed.seed = 4;
    const Drawn a = Draw(base);
    for (const SamplerQuery& q : {key, replicate, sequence, pixel, seed}) {
      INFO(Name(sampler));
      const Drawn b = Draw(q);
      CHECK(UniformP(a.u0, b.u0) > level);
      CHECK(UniformP(a.u1, b.u0) > level);
      CHECK(UniformP(a.u1, b.u1) > level);
    }
  }
}

TEST_CASE("points: the orders of samples of two keys are independent", "[points]") {
  const double level = stat::SidakLevel(kFamily, 7 * 2 * 4);
  for (SampleSequence sampler : kAllSequences) {
    // Of one replicate: across its blocks, and within one.
    for (std::uint32_t first : {0u, 4 * kReplicates}) {
      for (std::uint32_t rounds : {1u, 2u, 3u, 11u}) {
        SamplerQuery q = Across(sampler, first), key = q;
        key.key = 21;
        const std::uint32_t other = first + rounds * kReplicates;
        INFO(Name(sampler) << ", samples " << first << " and " << other);
        CHECK(CorrelationP(Products(q, other), Products(key, other)) > level);
      }
    }
  }
}

TEST_CASE("planted: shared orders and a missing corner are rejected", "[points]") {
  const double level = stat::SidakLevel(kFamily, 105);
  // Strata in the same order in two dimensions, independently jittered within.
  const SamplerQuery q = Across(SampleSequence::kStratified, 0);
  SamplerQuery jitter = Across(SampleSequence::kIndependent, 0);
  jitter.key = 99;
  const std::vector<double> products = Products(q, kReplicates);
  std::vector<double> shared = Products(jitter, kReplicates);
  for (std::size_t i = 0; i < shared.size(); ++i) {
    shared[i] = products[i] + 0.2 * shared[i];
  }
  CHECK(CorrelationP(products, shared) < level);
  const Drawn p = Draw(q);
  CHECK(UniformP(p.u0, p.u0) < level);
  // Numbers that leave out the last hundredth, as strata of a wrong width would.
  std::vector<float> narrow = p.u0;
  for (float& u : narrow) u *= 0.96f;
  CHECK(KsP(narrow) < level);
  CHECK(UniformP(narrow, p.u1) < level);
}

namespace {

struct Lcg {  // PCG-4D, scalar, written from the paper's equations
  std::uint32_t v[4];
  void Mix() {
    v[0] += v[1] * v[3];
    v[1] += v[2] * v[0];
    v[2] += v[0] * v[1];
    v[3] += v[1] * v[2];
  }
  Lcg(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d)
      : v{a, b, c, d} {
    for (auto& x : v) x = x * 1664525u + 1013904223u;
    Mix();
    for (auto& x : v) x ^= x >> 16;
    Mix();
  }
};

}  // namespace

TEST_CASE("independent points equal the scalar PCG-4D", "[points]") {
  const Drawn p = Draw({SampleSequence::kIndependent, 42, 1000, 17, 5, 100});
  for (std::uint32_t i = 0; i < 100; ++i) {
    const Lcg h(1000, 5 + i, 17, 42);
    CHECK(p.u0[i] == float(h.v[0] >> 8) * 0x1p-24f);
    CHECK(p.u1[i] == float(h.v[1] >> 8) * 0x1p-24f);
  }
}

TEST_CASE("samples are assigned to replicates in turn", "[points]") {
  constexpr std::uint32_t kCount = 70, kEnd = 1u << 31;
  std::vector<std::uint32_t> group(kCount + 16), index(group), unpaired(group);
  const EachTarget target;
  for (std::uint32_t shift : {0u, 1u, 4u, 10u, 12u, 20u}) {
    const std::uint32_t sequence = kReplicates << shift;
    // At the start, where a sequence ends, and at the end.
    for (std::uint32_t first : {0u, std::max(sequence, 40u) - 40,
                                kEnd / 3 / sequence * sequence - 33, kEnd - kCount}) {
      ProbeGroups(TestTarget(), shift, first, kCount,
                  {group.data(), index.data(), unpaired.data()});
      for (std::uint32_t i = 0; i < kCount; ++i) {
        const std::uint32_t sample = first + i, round = sample / kReplicates;
        const std::uint32_t sampler = 1u << shift;
        REQUIRE(group[i] == round / sampler * kReplicates + sample % kReplicates);
        REQUIRE(index[i] == round % sampler);
        const std::uint32_t pair = sample / 2, of_replicate = pair / kReplicates;
        REQUIRE(unpaired[i] == (2 * of_replicate + sample % 2) * kReplicates +
                                   SampleGroups{2, true}.Replicate(sample));
      }
    }
  }
}

TEST_CASE("unpaired numbers differ and belong to the replicate of their pair",
          "[points]") {
  constexpr std::uint32_t kCount = 4096;
  std::vector<std::uint32_t> group(kCount + 16), index(group), unpaired(group);
  ProbeGroups(TestTarget(), 20, 0, kCount, {group.data(), index.data(), unpaired.data()});
  unpaired.resize(kCount);
  const SampleGroups pairs{2, true}, single{1, true};
  for (std::uint32_t i = 0; i < kCount; ++i) {
    REQUIRE(single.Replicate(unpaired[i]) == pairs.Replicate(i));
    REQUIRE(single.Replicate(i / 2) == pairs.Replicate(i));  // paired ones
  }
  // Any whole turns of pairs draw a prefix of the sequences.
  for (std::uint32_t round = 8; round <= kCount; round += 8) {
    std::vector<std::uint32_t> prefix(unpaired.begin(), unpaired.begin() + round);
    std::sort(prefix.begin(), prefix.end());
    for (std::uint32_t i = 0; i < round; ++i) REQUIRE(prefix[i] == i);
  }
}

// The mean is off by six deviations of independent points in 2e-9 of the cases.
TEST_CASE("points: numbers at large sample, pixel and event indices are uniform",
          "[points]") {
  constexpr std::uint32_t kCount = 4096;
  for (const SampleSequence sampler : kAllSequences) {
    std::vector<SamplerQuery> queries;
    for (const std::uint32_t sample : {1u, 1000u, 100'000u, 10'000'000u, 0x7ffff000u}) {
      queries.push_back({sampler, 1, 7, 3, sample, kCount});
    }
    for (const std::uint32_t pixel : {1u, 65535u, 65536u, 0xffffffffu}) {
      queries.push_back({sampler, 1, pixel, 3, 5, kCount});
    }
    for (const std::uint32_t event : {1u, 100u, 10'000u, 0xfffffu}) {
      const std::uint32_t key = event << kDepthShift;
      queries.push_back({sampler, 1, 11,
                         key + static_cast<std::uint32_t>(Dimension::kBsdf), 0, kCount});
    }
    for (const SamplerQuery& query : queries) {
      const Drawn drawn = Draw(query);
      for (const std::vector<float>& u : {drawn.u0, drawn.u1}) {
        double sum = 0;
        for (const float x : u) sum += x >= 0 && x < 1 ? x : kCount;
        INFO("points " << static_cast<int>(sampler) << ", query "
                       << &query - queries.data());
        CHECK(std::abs(sum / kCount - 0.5) < 6 / std::sqrt(12.0 * kCount));
      }
    }
  }
}

}  // namespace lanelight::test

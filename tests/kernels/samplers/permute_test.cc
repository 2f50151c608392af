// Random permutations: bijections, uniform over images, pairs and, for few elements, over
// whole permutations.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <numeric>

#include "tests/kernels/probe/sampler_probe.h"
#include "src/base/stat/hypothesis.h"
#include "tests/base/stat/chi2.h"
#include "tests/support/each_target.h"

namespace lanelight::test {
namespace {

using Permutation = std::vector<std::uint32_t>;

// Keys without a pattern that the permutation could share.
std::uint32_t KeyOf(std::uint32_t i) {
  std::uint64_t v = (i + 1) * 0xa0761d1f5b3c9e47ull;
  v ^= v >> 29;
  v *= 0xd39f1b7ac4e26855ull;
  return static_cast<std::uint32_t>(v >> 32);
}

Permutation Permuted(std::uint32_t count, std::uint32_t key, bool octaves = false) {
  Permutation p(count + 16);
  ProbePermutation(TestTarget(), count, key, octaves, p.data());
  p.resize(count);
  return p;
}

bool IsBijection(Permutation p, std::uint32_t first, std::uint32_t last) {
  std::sort(p.begin() + first, p.begin() + last);
  for (std::uint32_t i = first; i < last; ++i) {
    if (p[i] != i) return false;
  }
  return true;
}

// p-value of the hypothesis that `cell` of a random permutation is uniform over `cells`.
template <class Make, class Cell>
double UniformP(const Make& make, const Cell& cell, std::size_t cells) {
  constexpr std::uint32_t kKeys = 40000;
  std::vector<double> observed(cells);
  for (std::uint32_t i = 0; i < kKeys; ++i) ++observed[cell(make(KeyOf(i)))];
  return stat::ChiSquareTest(observed,
                             std::vector<double>(cells, double(kKeys) / double(cells)))
      .p;
}

// Number of the ordered pair (p[i], p[j]) among all of unequal numbers below n.
auto PairCell(std::uint32_t n, std::size_t i, std::size_t j) {
  return [=](const Permutation& p) {
    return std::size_t{p[i]} * (n - 1) + p[j] - (p[j] > p[i] ? 1 : 0);
  };
}

// Rank of the whole permutation of few elements.
std::size_t Rank(const Permutation& p) {
  std::size_t rank = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto smaller =
        std::count_if(p.begin() + static_cast<std::ptrdiff_t>(i), p.end(),
                      [&](std::uint32_t v) { return v < p[i]; });
    rank = rank * (p.size() - i) + static_cast<std::size_t>(smaller);
  }
  return rank;
}

constexpr int kTests = 20;

}  // namespace

TEST_CASE("permutations are bijections", "[points]") {
  const EachTarget target;
  for (std::uint32_t n = 1; n <= 1u << 17; n *= 2) {
    for (std::uint32_t key = 0; key < (n < 200 ? 200u : 5u); ++key) {
      REQUIRE(IsBijection(Permuted(n, KeyOf(key)), 0, n));
    }
  }
  Permutation repeated = Permuted(128, 1);
  repeated[3] = repeated[70];
  CHECK_FALSE(IsBijection(repeated, 0, 128));
}

TEST_CASE("permutations of octaves keep every prefix", "[points]") {
  const EachTarget target;
  for (std::uint32_t key = 0; key < 50; ++key) {
    const std::uint32_t n = key < 2 ? 1u << 20 : 1024;
    const Permutation p = Permuted(n, KeyOf(key), true);
    REQUIRE(p[0] == 0);
    for (std::uint32_t first = 1; first < n; first *= 2) {
      REQUIRE(IsBijection(p, first, 2 * first));
    }
  }
}

TEST_CASE("permutations are uniform over images, pairs and wholes", "[points]") {
  const double level = stat::SidakLevel(1e-6, kTests);
  const auto check = [&](double p, std::uint32_t n) {
    INFO("p " << p << " of " << n);
    CHECK(p > level);
  };
  for (std::uint32_t n : {2, 4}) {
    const auto make = [&](std::uint32_t key) { return Permuted(n, key); };
    check(UniformP(make, Rank, n == 2 ? 2 : 24), n);
  }
  for (std::uint32_t n : {8, 16, 32}) {
    const auto make = [&](std::uint32_t key) { return Permuted(n, key); };
    for (std::size_t other : {std::size_t{1}, std::size_t{n / 2}, std::size_t{n - 1}}) {
      check(UniformP(make, PairCell(n, 0, other), n * (n - 1)), n);
    }
  }
  for (std::uint32_t n : {128, 256}) {
    const auto make = [&](std::uint32_t key) { return Permuted(n, key); };
    check(UniformP(make, [&](const Permutation& p) { return p[n / 3]; }, n), n);
  }
}

TEST_CASE("permutations of octaves are uniform and unlike each other", "[points]") {
  const double level = stat::SidakLevel(1e-6, kTests);
  const auto make = [](std::uint32_t key) { return Permuted(32, key, true); };
  const auto octave = [&](std::uint32_t first) {
    return [=](std::uint32_t key) {
      Permutation p = Permuted(2 * first, key, true);
      p.erase(p.begin(), p.begin() + first);
      for (std::uint32_t& v : p) v -= first;
      return p;
    };
  };
  CHECK(UniformP(octave(2), Rank, 2) > level);
  CHECK(UniformP(octave(4), Rank, 24) > level);
  CHECK(UniformP(octave(8), PairCell(8, 0, 1), 56) > level);
  CHECK(UniformP(octave(16), PairCell(16, 3, 11), 240) > level);
  // Images in one octave say nothing about those in another.
  const auto across = [](const Permutation& p) {
    return std::size_t{p[4] - 4} * 8 + (p[8] - 8);
  };
  CHECK(UniformP(make, across, 32) > level);
  const auto far = [](const Permutation& p) {
    return std::size_t{p[9] - 8} * 16 + (p[17] - 16);
  };
  CHECK(UniformP(make, far, 128) > level);
}

TEST_CASE("planted: an affine permutation is rejected", "[points]") {
  const double level = stat::SidakLevel(1e-6, kTests);
  const auto affine = [](std::uint32_t n) {
    return [=](std::uint32_t key) {
      Permutation p(n);
      for (std::uint32_t i = 0; i < n; ++i) {
        p[i] = (i * (key >> 16 | 1) + key % 1024) & (n - 1);
      }
      return p;
    };
  };
  CHECK(UniformP(affine(4), Rank, 24) < level);
  CHECK(UniformP(affine(16), PairCell(16, 0, 8), 240) < level);
}

}  // namespace lanelight::test

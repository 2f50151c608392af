// What each sampler stratifies, counted exactly, on every target.
#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "src/base/stat/hypothesis.h"
#include "src/scene/prepare/parameters.h"
#include "tests/base/stat/chi2.h"
#include "tests/kernels/samplers/draw.h"
#include "tests/support/test_target.h"

namespace lanelight::test {
namespace {

// A number of a stratum that does not begin on the grid of 2^-24 may lie on the last grid
// point before it.
constexpr double kGrid = 0x1p-24 * 1.01;

// The values, sorted, fill `cells` equal intervals evenly.
bool EvenIntervals(std::vector<float> values, std::size_t cells) {
  std::sort(values.begin(), values.end());
  const double n = double(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double cell = std::floor(double(k) * double(cells) / n);
    if (values[k] < cell / double(cells) - kGrid) return false;
    if (values[k] >= (cell + 1) / double(cells)) return false;
  }
  return true;
}

// Each cell of an a x b grid holds as many points as any other.
bool EvenCells(const Drawn& p, std::size_t a, std::size_t b) {
  const std::size_t n = p.u0.size();
  if (!EvenIntervals(p.u1, b)) return false;
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t i, std::size_t j) { return p.u1[i] < p.u1[j]; });
  const std::size_t row = n / b;
  for (std::size_t y = 0; y < b; ++y) {
    std::vector<float> values;
    for (std::size_t k = 0; k < row; ++k) values.push_back(p.u0[order[y * row + k]]);
    if (!EvenIntervals(values, a)) return false;
  }
  return true;
}

Drawn Prefix(const Drawn& p, std::size_t first, std::size_t n) {
  const auto cut = [&](const std::vector<float>& u) {
    const auto from = u.begin() + static_cast<std::ptrdiff_t>(first);
    return std::vector<float>(from, from + static_cast<std::ptrdiff_t>(n));
  };
  return {cut(p.u0), cut(p.u1)};
}

bool IsNet(const Drawn& p) {
  for (std::size_t a = 1; a <= p.u0.size(); a *= 2) {
    if (!EvenCells(p, a, p.u0.size() / a)) return false;
  }
  return true;
}

// Calls body(the first `count` points of a replicate), of a few pixels, of the first
// sequence and of a later one, on all targets.
template <class Body>
void ForReplicates(SampleSequence sampler, std::uint32_t count, Body&& body) {
  for (const std::string& target : AvailableTargets()) {
    ForceTarget(target);
    for (std::uint32_t pixel : {0u, 77777u}) {
      for (std::uint32_t replicate = 0; replicate < kReplicates; ++replicate) {
        const std::uint32_t sequence = pixel % 100 << LogSequence(sampler);
        body(SamplerQuery{sampler, 7, pixel, 3, sequence * kReplicates + replicate, count,
                          1, kReplicates});
      }
    }
  }
  ForceTarget("");
}

// Calls body(first, size) for all aligned blocks of powers of two.
template <class Body>
void ForBlocks(std::size_t count, Body&& body) {
  for (std::size_t n = 1; n <= count; n *= 2) {
    for (std::size_t first = 0; first < count; first += n) body(first, n);
  }
}

std::size_t FloorRoot(std::size_t n) {
  return std::size_t{1} << (std::bit_width(n) - 1) / 2;
}

// Points in each of the boxes of 1 / a times 1 / b, in order of their number. Points
// stand for the middle of their grid cell: boxes of thirds do not begin on the grid.
std::vector<int> BoxCounts(const Drawn& p, std::size_t a, std::size_t b) {
  std::vector<int> counts(a * b);
  const auto cell = [](float u, std::size_t n) {
    return static_cast<std::size_t>((double(u) + 0x1p-25) * double(n));
  };
  for (std::size_t i = 0; i < p.u0.size(); ++i) {
    ++counts[cell(p.u0[i], a) * b + cell(p.u1[i], b)];
  }
  std::sort(counts.begin(), counts.end());
  return counts;
}

// The same of the first n Halton points: each box holds the i of one remainder modulo
// a b.
std::vector<int> HaltonCounts(std::size_t n, std::size_t a, std::size_t b) {
  std::vector<int> counts(a * b);
  for (std::size_t i = 0; i < n; ++i) ++counts[i % (a * b)];
  std::sort(counts.begin(), counts.end());
  return counts;
}

bool HasHaltonCounts(const Drawn& p) {
  const std::size_t n = p.u0.size();
  for (std::size_t a = 1; a <= n; a *= 2) {
    for (std::size_t b = 1; b <= 243; b *= 3) {
      if (BoxCounts(p, a, b) != HaltonCounts(n, a, b)) return false;
    }
  }
  return true;
}

}  // namespace

TEST_CASE("stratified: one of any aligned 2^m points per stratum", "[points]") {
  ForReplicates(SampleSequence::kStratified, 512, [&](const SamplerQuery& q) {
    const Drawn d = Draw(q);
    const std::vector<float> numbers = DrawNumbers(q);
    ForBlocks(512, [&](std::size_t first, std::size_t n) {
      REQUIRE(EvenCells(Prefix(d, first, n), n / FloorRoot(n), FloorRoot(n)));
      REQUIRE(EvenIntervals(Prefix({numbers, numbers}, first, n).u0, n));
    });
  });
}

TEST_CASE("sobol: every aligned power-of-two block is a net", "[points]") {
  ForReplicates(SampleSequence::kSobol, 256, [&](const SamplerQuery& q) {
    const Drawn d = Draw(q);
    ForBlocks(256, [&](std::size_t first, std::size_t n) {
      REQUIRE(IsNet(Prefix(d, first, n)));
    });
  });
}

TEST_CASE("halton: a prefix of 2^m points fills boxes as Halton's do", "[points]") {
  ForReplicates(SampleSequence::kHalton, 1024, [&](const SamplerQuery& q) {
    const Drawn d = Draw(q);
    for (std::size_t n = 1; n <= 1024; n *= 2) {
      REQUIRE(EvenIntervals(Prefix(d, 0, n).u0, n));
      REQUIRE(HasHaltonCounts(Prefix(d, 0, n)));
    }
  });
}

TEST_CASE("replicates and sequences are different randomisations", "[points]") {
  for (SampleSequence sampler : kAllSequences) {
    if (sampler == SampleSequence::kIndependent) continue;
    INFO(Name(sampler));
    Drawn all;
    std::vector<Drawn> parts;
    for (std::uint32_t sequence : {0u, kReplicates << LogSequence(sampler)}) {
      for (std::uint32_t r = 0; r < 2; ++r) {
        parts.push_back(Draw({sampler, 1, 5, 0, sequence + r, 16, 1, kReplicates}));
        all.u0.insert(all.u0.end(), parts.back().u0.begin(), parts.back().u0.end());
        all.u1.insert(all.u1.end(), parts.back().u1.begin(), parts.back().u1.end());
      }
    }
    // They do not continue each other.
    CHECK_FALSE(EvenCells(all, 8, 8));
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = 0; k < i; ++k) CHECK(parts[i].u0 != parts[k].u0);
    }
  }
}

namespace {

// p-value of the hypothesis that the lowest of samples [8, 16) of a replicate is any one
// of them, over pixels.
double OrderP(SampleSequence sampler, bool numbers, bool sorted = false) {
  constexpr std::uint32_t kPixels = 20000, kBlock = 8;
  const SamplerQuery q{sampler, 3,       10,         20, kReplicates * kBlock,
                       kBlock,  kPixels, kReplicates};
  const std::vector<float> u = numbers ? DrawNumbers(q) : Draw(q).u0;
  std::vector<double> observed(kBlock);
  for (std::size_t pixel = 0; pixel < kPixels; ++pixel) {
    std::size_t lowest = 0;
    for (std::size_t i = 1; i < kBlock; ++i) {
      if (u[i * kPixels + pixel] < u[lowest * kPixels + pixel]) lowest = i;
    }
    ++observed[sorted && pixel % 8 == 0 ? 0 : lowest];
  }
  return stat::ChiSquareTest(observed,
                             std::vector<double>(kBlock, double(kPixels) / kBlock))
      .p;
}

}  // namespace

TEST_CASE("the order of strata is random", "[points]") {
  const double level = stat::SidakLevel(1e-6, 2 * std::size(kAllSequences));
  for (SampleSequence sampler : kAllSequences) {
    INFO(Name(sampler));
    CHECK(OrderP(sampler, false) > level);
    CHECK(OrderP(sampler, true) > level);
  }
  CHECK(OrderP(SampleSequence::kStratified, false, true) < level);  // planted
}

TEST_CASE("planted: a repeated index and random strata are detected", "[points]") {
  const auto of_64 = [](SampleSequence sampler) {
    return SamplerQuery{sampler, 1, 5, 0, 0, 64, 1, kReplicates};
  };
  for (SampleSequence sampler : {SampleSequence::kStratified, SampleSequence::kSobol}) {
    Drawn d = Draw(of_64(sampler));
    REQUIRE(EvenCells(d, 8, 8));
    d.u0[11] = d.u0[12];
    d.u1[11] = d.u1[12];
    CHECK_FALSE(EvenCells(d, 8, 8));
  }
  CHECK_FALSE(EvenCells(Draw(of_64(SampleSequence::kIndependent)), 8, 8));
  // Right in two dimensions, not in one.
  CHECK_FALSE(EvenIntervals(Draw(of_64(SampleSequence::kStratified)).u0, 64));
  // Strata are no net, a Halton prefix no net of base 2, nor a net one of Halton's.
  const Drawn halton = Draw(of_64(SampleSequence::kHalton));
  CHECK_FALSE(IsNet(Draw(of_64(SampleSequence::kStratified))));
  CHECK_FALSE(IsNet(halton));
  CHECK(HasHaltonCounts(halton));
  CHECK_FALSE(HasHaltonCounts(Draw(of_64(SampleSequence::kSobol))));
}

}  // namespace lanelight::test

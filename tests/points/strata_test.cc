// What each sampler stratifies, counted exactly, on every target.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "kernels/simd/target.h"
#include "src/prepare/lattice.h"
#include "tests/points/draw.h"

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

// Calls body(group of points) for groups of a few pixels, on all targets.
template <class Body>
void ForGroups(Points points, std::uint32_t size, Body&& body) {
  for (const std::string& target : AvailableTargets()) {
    ForceTarget(target);
    for (std::uint32_t pixel : {0u, 1u, 77777u}) {
      for (std::uint32_t group : {0u, 1u, 5u}) {
        body(PointsQuery{points, 7, pixel, size, 3, group * size, size});
      }
    }
  }
  ForceTarget("");
}

constexpr std::uint32_t kSizes[] = {1, 2, 6, 9, 12, 25, 30, 64, 90, 240, 1024};

}  // namespace

TEST_CASE("stratified: one point per stratum of two and of one dimension", "[points]") {
  for (std::uint32_t n : kSizes) {
    const PointsParameters p = MakePointsParameters(Points::kStratified, n);
    REQUIRE(p.columns.count * p.rows.count == n);
    ForGroups(Points::kStratified, n, [&](const PointsQuery& q) {
      REQUIRE(EvenCells(Draw(q), p.columns.count, p.rows.count));
      REQUIRE(EvenIntervals(DrawNumbers(q), n));
    });
  }
}

TEST_CASE("cmj: one point per stratum of two, and of each dimension", "[points]") {
  for (std::uint32_t n : kSizes) {
    const PointsParameters p = MakePointsParameters(Points::kCmj, n);
    ForGroups(Points::kCmj, n, [&](const PointsQuery& q) {
      const Drawn d = Draw(q);
      REQUIRE(EvenCells(d, p.columns.count, p.rows.count));
      REQUIRE(EvenIntervals(d.u0, n));
      REQUIRE(EvenIntervals(d.u1, n));
    });
  }
}

TEST_CASE("pmj02: every prefix of 2^k points is a net", "[points]") {
  ForGroups(Points::kPmj02, 1024, [&](const PointsQuery& q) {
    const Drawn d = Draw(q);
    for (std::size_t n = 1; n <= 1024; n *= 2) REQUIRE(IsNet(Prefix(d, 0, n)));
  });
  ForGroups(Points::kPmj02, 16, [&](const PointsQuery& q) { REQUIRE(IsNet(Draw(q))); });
}

TEST_CASE("sobol: every aligned power-of-two block is a net", "[points]") {
  ForGroups(Points::kSobol, 256, [&](const PointsQuery& q) {
    const Drawn d = Draw(q);
    for (std::size_t n = 1; n <= 256; n *= 2) {
      for (std::size_t first = 0; first < 256; first += n) {
        REQUIRE(IsNet(Prefix(d, first, n)));
      }
    }
  });
}

TEST_CASE("halton: one point per box of 2^-a times 3^-b", "[points]") {
  for (std::uint32_t n : {1, 2, 3, 6, 12, 36, 64, 81, 216, 864}) {
    ForGroups(Points::kHalton, n, [&](const PointsQuery& q) {
      const Drawn d = Draw(q);
      for (std::size_t a = 1; n % a == 0; a *= 2) {
        for (std::size_t b = 1; n % (a * b) == 0; b *= 3) REQUIRE(EvenCells(d, a, b));
      }
    });
  }
}

TEST_CASE("lattice: without the shift, exactly the lattice", "[points]") {
  for (std::uint32_t n : {1, 2, 3, 7, 16, 100, 233, 1000}) {
    const double z = LatticeGenerator(n);
    ForGroups(Points::kLattice, n, [&](const PointsQuery& q) {
      const Drawn d = Draw(q);
      std::vector<int> seen(n);
      for (std::size_t i = 0; i < n; ++i) {
        const double x = (double(d.u0[i]) - d.u0[0]) * n;
        const double y = (double(d.u1[i]) - d.u1[0]) * n;
        const double index = std::round(x), expected = index * z;
        REQUIRE(std::abs(x - index) < 2 * kGrid * n);
        REQUIRE(std::abs(std::remainder(y - expected, n)) < 2 * kGrid * n);
        ++seen[static_cast<std::size_t>(index + n) % n];
      }
      REQUIRE(std::all_of(seen.begin(), seen.end(), [](int s) { return s == 1; }));
    });
  }
}

TEST_CASE("groups are different randomisations and orders", "[points]") {
  for (Points points : kAllPoints) {
    if (points == Points::kIndependent) continue;
    const Drawn d = Draw({points, 1, 5, 16, 0, 0, 64});
    // Independently randomised groups do not continue each other.
    CHECK_FALSE(EvenCells(d, 8, 8));
    for (std::size_t g = 1; g < 4; ++g)
      CHECK(Prefix(d, 0, 16).u0 != Prefix(d, 16 * g, 16).u0);
  }
}

TEST_CASE("planted: a repeated index and strata left to chance are seen", "[points]") {
  for (Points points : {Points::kStratified, Points::kCmj, Points::kPmj02}) {
    Drawn d = Draw({points, 1, 5, 64, 0, 0, 64});
    REQUIRE(EvenCells(d, 8, 8));
    d.u0[11] = d.u0[12];
    d.u1[11] = d.u1[12];
    CHECK_FALSE(EvenCells(d, 8, 8));
  }
  CHECK_FALSE(EvenCells(Draw({Points::kIndependent, 1, 5, 1, 0, 0, 64}), 8, 8));
  // Right in two dimensions, not in one.
  CHECK_FALSE(EvenIntervals(Draw({Points::kStratified, 1, 5, 64, 0, 0, 64}).u0, 64));
  // A lattice is no net, and a Halton group no net of base 2.
  CHECK_FALSE(IsNet(Draw({Points::kLattice, 1, 5, 64, 0, 0, 64})));
  CHECK_FALSE(IsNet(Draw({Points::kHalton, 1, 5, 64, 0, 0, 64})));
}

}  // namespace lanelight::test

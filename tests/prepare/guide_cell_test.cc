// Cells of a guide: the quadtree, its tables, and extremes of what it is made of.
#include "src/prepare/guide_cell.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "src/prepare/guide_square.h"

namespace lanelight {
namespace {

using Masses = std::vector<double>;

std::uint32_t Append(const Masses& masses, double even, float fraction, Guide& guide) {
  return AppendGuideCell(std::span<const double, kGuideSquares>(masses), even, fraction,
                         guide);
}

// Masses over many decades, most of them in a few squares.
Masses Lopsided(unsigned seed, double decades) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> exponent(-decades, 0);
  Masses masses(kGuideSquares);
  for (double& m : masses) m = std::pow(10, exponent(random));
  return masses;
}

// Masses of a cell's squares, by its bounds.
Masses MassesOf(const Guide& guide, std::uint32_t cell) {
  const float* rows = &guide.cumulative[cell * kGuideBounds];
  Masses masses(kGuideSquares);
  for (std::size_t y = 0; y < kGuideGrid; ++y) {
    const float* row = rows + kGuideGrid * (y + 1);
    const double height = double{rows[y]} - (y > 0 ? double{rows[y - 1]} : 0);
    for (std::size_t x = 0; x < kGuideGrid; ++x) {
      const double width = double{row[x]} - (x > 0 ? double{row[x - 1]} : 0);
      masses[y * kGuideGrid + x] = height * width;
    }
  }
  return masses;
}

// What must hold for any cell.
void CheckCell(const Guide& guide, std::uint32_t cell) {
  REQUIRE(guide.cumulative.size() == guide.cells() * kGuideBounds);
  REQUIRE(guide.density.size() == guide.cells() * kGuideSquares);
  const Masses masses = MassesOf(guide, cell);
  double sum = 0;
  for (std::size_t s = 0; s < kGuideSquares; ++s) {
    const double density = double{guide.density[cell * kGuideSquares + s]};
    REQUIRE(masses[s] > 0);
    CHECK(density * 4 / kGuideSquares == Approx(masses[s]).epsilon(1e-6).margin(0));
    sum += masses[s];
  }
  CHECK(sum == Approx(1).epsilon(1e-12));
}

TEST_CASE("guide cells: densities are what sampling does", "[guide]") {
  Guide guide;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const double even = seed % 2 == 0 ? 0.01 : 0.05;
    CheckCell(guide, Append(Lopsided(seed, 2.0 * seed), even, 0.5f, guide));
  }
  CHECK(guide.cells() == 8);
}

TEST_CASE("guide cells: extremes of masses", "[guide]") {
  Guide guide;
  Masses masses(kGuideSquares, 0.0);
  const std::uint32_t none = Append(masses, 0.05, 0, guide);
  const Masses even = MassesOf(guide, none);
  for (std::size_t s = 0; s < kGuideSquares; ++s) {
    CHECK(even[s] == Approx(CosineMasses()[s]).epsilon(1e-5));
  }
  masses[77] = 1e308;  // one bright record, and next to it what a double can hold
  masses[76] = 1e308;
  masses[0] = 5e-324;
  const std::uint32_t bright = Append(masses, 0.05, 0.9f, guide);
  masses.assign(kGuideSquares, 5e-324);
  const std::uint32_t faint = Append(masses, 0.05, 0.9f, guide);
  for (const std::uint32_t cell : {none, bright, faint}) CheckCell(guide, cell);
  CHECK(MassesOf(guide, bright)[77] ==
        Approx(0.95 / 2 + 0.05 * CosineMasses()[77]).epsilon(1e-4));
}

TEST_CASE("guide cells: squares of little mass are taken together", "[guide]") {
  // Within a leaf the density is the cosine's: count how many there are, and how heavy.
  Guide guide;
  const Masses masses = Lopsided(99, 6);
  Append(masses, 0.05, 0.5f, guide);
  const Masses flat = MassesOf(guide, 0);
  const auto quotient = [&](std::size_t s) { return flat[s] / CosineMasses()[s]; };
  double heaviest_joined = 0, sum = 0;
  for (double m : masses) sum += m;
  std::size_t alone = 0;
  for (std::size_t y = 0; y < kGuideGrid; y += 2) {
    for (std::size_t x = 0; x < kGuideGrid; x += 2) {
      const std::size_t s = y * kGuideGrid + x;
      const bool joined = std::abs(quotient(s) / quotient(s + 1) - 1) < 1e-3;
      double block = 0;
      for (std::size_t q : {s, s + 1, s + kGuideGrid, s + kGuideGrid + 1}) {
        block += masses[q] / sum;
        // A square of its own has its own mass.
        const double own = 0.95 * masses[q] / sum + 0.05 * CosineMasses()[q];
        if (!joined) CHECK(flat[q] == Approx(own).epsilon(1e-3));
      }
      alone += joined ? 0 : 1;
      if (joined) heaviest_joined = std::max(heaviest_joined, block);
    }
  }
  // 21 splits make 64 leaves; the first five of them cannot reach single squares.
  CHECK(alone >= 3);
  CHECK(alone <= 16);
  CHECK(heaviest_joined < 1.0 / 16);
}

TEST_CASE("guide cells: what knows nothing is the cosine and never proposes", "[guide]") {
  const Guide guide = UnknowingGuide();
  CheckCell(guide, 0);
  REQUIRE(guide.nodes.size() == 1);
  CHECK(guide.nodes[0].next == Guide::Node::kLeaf);
  CHECK(guide.fraction[0] == 0);
}

}  // namespace
}  // namespace lanelight

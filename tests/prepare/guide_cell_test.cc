// Cells of a guide: the quadtree, its tables, and extremes of what it is made of.
#include "src/prepare/guide_cell.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

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

// What must hold for any cell.
void CheckCell(const Guide& guide, std::uint32_t cell) {
  REQUIRE(guide.cumulative.size() == guide.cells() * kGuideLeaves);
  REQUIRE(guide.leaf.size() == guide.cells() * kGuideSquares);
  double before = 0, integral = 0;
  std::size_t covered = 0;
  for (std::uint32_t i = 0; i < kGuideLeaves; ++i) {
    const std::size_t at = std::size_t{cell} * kGuideLeaves + i;
    const std::uint32_t square = guide.square[at];
    const std::uint32_t x = square & 255, y = square >> 8 & 255, side = square >> 16;
    const double share = double(side) * side / double(kGuideSquares);
    const double mass = double{guide.cumulative[at]} - before;
    REQUIRE(guide.pdf_sa[at] > 0);
    CHECK(guide.pdf_sa[at] * share * 4 * std::numbers::pi ==
          Approx(mass).epsilon(1e-6).margin(0));
    integral += guide.pdf_sa[at] * share * 4 * std::numbers::pi;
    before = guide.cumulative[at];
    for (std::uint32_t v = y; v < y + side; ++v) {
      for (std::uint32_t u = x; u < x + side; ++u, ++covered) {
        REQUIRE(guide.leaf[(std::size_t{cell} * kGuideGrid + v) * kGuideGrid + u] == i);
      }
    }
  }
  CHECK(covered == kGuideSquares);
  CHECK(guide.cumulative[std::size_t{cell} * kGuideLeaves + kGuideLeaves - 1] == 1.0f);
  CHECK(integral == Approx(1).epsilon(1e-6));
}

TEST_CASE(
    "guide cells: leaves cover the square once, their densities are what sampling does",
    "[guide]") {
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
  for (std::size_t at = 0; at < kGuideLeaves; ++at) {  // 8 x 8 equal squares
    CHECK(guide.square[at] >> 16 == 4);
    CHECK(guide.pdf_sa[at] == Approx(0.25 / std::numbers::pi));
  }
  masses[777] = 1e308;  // one bright record, and next to it what a double can hold
  masses[776] = 1e308;
  masses[0] = 5e-324;
  const std::uint32_t bright = Append(masses, 0.05, 0.9f, guide);
  masses.assign(kGuideSquares, 5e-324);
  const std::uint32_t faint = Append(masses, 0.05, 0.9f, guide);
  for (const std::uint32_t cell : {none, bright, faint}) CheckCell(guide, cell);
  const std::uint8_t leaf = guide.leaf[bright * kGuideSquares + 777];
  const std::size_t at = bright * kGuideLeaves + leaf;
  CHECK(guide.square[at] == (777 % kGuideGrid | 777 / kGuideGrid << 8 | 1 << 16));
  CHECK(guide.pdf_sa[at] * 4 * std::numbers::pi / kGuideSquares ==
        Approx(0.95 / 2 + 0.05 / kGuideSquares).epsilon(1e-4));
}

// Mass of the block of squares at x, y: its own share of 0.95, and the even rest.
double Blended(const Masses& masses, std::uint32_t x, std::uint32_t y,
               std::uint32_t side) {
  double sum = 0, inside = 0;
  for (double m : masses) sum += m;
  for (std::uint32_t v = y; v < y + side; ++v) {
    for (std::uint32_t u = x; u < x + side; ++u) inside += masses[v * kGuideGrid + u];
  }
  return 0.95 * inside / sum + 0.05 * side * side / double(kGuideSquares);
}

TEST_CASE("guide cells: no leaf that could be split is heavier than one that was",
          "[guide]") {
  Guide guide;
  const Masses masses = Lopsided(99, 6);
  Append(masses, 0.05, 0.5f, guide);
  double heaviest_whole = 0, lightest_split = 1;
  for (std::uint32_t side = 2; side <= kGuideGrid; side *= 2) {
    for (std::uint32_t y = 0; y < kGuideGrid; y += side) {
      for (std::uint32_t x = 0; x < kGuideGrid; x += side) {
        const std::uint32_t leaf = guide.square[guide.leaf[y * kGuideGrid + x]];
        const double mass = Blended(masses, x, y, side);
        if (leaf >> 16 == side) heaviest_whole = std::max(heaviest_whole, mass);
        if (leaf >> 16 < side) lightest_split = std::min(lightest_split, mass);
      }
    }
  }
  CHECK(heaviest_whole > 0);
  CHECK(heaviest_whole <= lightest_split * (1 + 1e-12));
}

TEST_CASE("guide cells: what knows nothing is even and never proposes", "[guide]") {
  const Guide guide = UnknowingGuide();
  CheckCell(guide, 0);
  REQUIRE(guide.nodes.size() == 1);
  CHECK(guide.nodes[0].next == Guide::Node::kLeaf);
  CHECK(guide.fraction[0] == 0);
}

}  // namespace
}  // namespace lanelight

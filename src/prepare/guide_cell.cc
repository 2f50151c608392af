#include "src/prepare/guide_cell.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "src/core/check.h"
#include "src/prepare/guide_square.h"

namespace lanelight {
namespace {

static_assert((kGuideLeaves - 1) % 3 == 0, "a split makes three leaves more");
static_assert(kGuideGrid == 16, "Z order of up to 8 bits; masses of a pyramid below");

struct Leaf {
  std::uint32_t x = 0, y = 0, side = kGuideGrid;  // in squares of the grid
  double mass = 0;
};

// Sums over squares of 1, 2, 4 ... of the grid, always in the same order.
class Pyramid {
 public:
  explicit Pyramid(std::vector<double> squares) {
    levels_.push_back(std::move(squares));
    for (std::uint32_t side = 2; side <= kGuideGrid; side *= 2) Reduce(kGuideGrid / side);
  }
  double Mass(std::uint32_t x, std::uint32_t y, std::uint32_t side) const {
    std::size_t level = 0;
    for (std::uint32_t s = side; s > 1; s /= 2) ++level;
    return levels_[level][std::size_t{y / side} * (kGuideGrid / side) + x / side];
  }

 private:
  void Reduce(std::size_t width) {
    const std::vector<double>& fine = levels_.back();
    std::vector<double> coarse(width * width);
    for (std::size_t y = 0; y < width; ++y) {
      for (std::size_t x = 0; x < width; ++x) {
        const double* upper = &fine[4 * y * width + 2 * x];
        const double* lower = upper + 2 * width;
        coarse[y * width + x] = (upper[0] + upper[1]) + (lower[0] + lower[1]);
      }
    }
    levels_.push_back(std::move(coarse));
  }
  std::vector<std::vector<double>> levels_;
};

// The masses, scaled to a sum of 1 with the even share.
std::vector<double> Blend(std::span<const double, kGuideSquares> masses, double even) {
  double largest = 0;
  for (double m : masses) {
    LL_CHECK(m >= 0 && std::isfinite(m));
    largest = std::max(largest, m);
  }
  std::vector<double> blend(masses.begin(), masses.end());
  double sum = 0;
  // Over the largest first: neither the sum nor a quotient overflows or vanishes.
  const auto& cosine = CosineMasses();
  for (std::size_t s = 0; s < kGuideSquares; ++s) {
    sum += blend[s] = largest > 0 ? blend[s] / largest : cosine[s];
  }
  for (std::size_t s = 0; s < kGuideSquares; ++s) {
    blend[s] = (1 - even) * blend[s] / sum + even * cosine[s];
  }
  return blend;
}

// Bits of x and y in turns, y's above x's.
std::uint32_t ZOrder(const Leaf& leaf) {
  std::uint32_t z = 0;
  for (int bit = 0; bit < 8; ++bit) {
    z |= (leaf.x >> bit & 1) << (2 * bit) | (leaf.y >> bit & 1) << (2 * bit + 1);
  }
  return z;
}

// `a` is to be split before `b`.
bool SplitsBefore(const Leaf& a, const Leaf& b) {
  if ((a.side > 1) != (b.side > 1)) return a.side > 1;
  if (a.mass != b.mass) return a.mass > b.mass;
  if (a.side != b.side) return a.side > b.side;
  return ZOrder(a) < ZOrder(b);
}

std::vector<Leaf> Divide(const Pyramid& pyramid) {
  std::vector<Leaf> leaves = {{0, 0, kGuideGrid, pyramid.Mass(0, 0, kGuideGrid)}};
  while (leaves.size() < kGuideLeaves) {
    const auto heaviest = std::min_element(leaves.begin(), leaves.end(), SplitsBefore);
    const Leaf parent = *heaviest;
    leaves.erase(heaviest);
    const std::uint32_t side = parent.side / 2;
    for (std::uint32_t quarter = 0; quarter < 4; ++quarter) {
      const std::uint32_t x = parent.x + (quarter & 1) * side;
      const std::uint32_t y = parent.y + (quarter >> 1) * side;
      leaves.push_back({x, y, side, pyramid.Mass(x, y, side)});
    }
  }
  std::sort(leaves.begin(), leaves.end(),
            [](const Leaf& a, const Leaf& b) { return ZOrder(a) < ZOrder(b); });
  return leaves;
}

// What the leaves say of the squares: within a leaf, the cosine.
std::vector<double> Flatten(const std::vector<Leaf>& leaves) {
  const Pyramid cosine({CosineMasses().begin(), CosineMasses().end()});
  std::vector<double> squares(kGuideSquares);
  for (const Leaf& leaf : leaves) {
    const double scale = leaf.mass / cosine.Mass(leaf.x, leaf.y, leaf.side);
    for (std::uint32_t y = leaf.y; y < leaf.y + leaf.side; ++y) {
      for (std::uint32_t x = leaf.x; x < leaf.x + leaf.side; ++x) {
        const std::size_t s = std::size_t{y} * kGuideGrid + x;
        squares[s] = scale * CosineMasses()[s];
      }
    }
  }
  return squares;
}

// Kernels find squares with the densities that they really have: their numbers are
// multiples of kBoundStep, and so are the bounds.
constexpr double kBoundStep = 1.0 / (1 << 24);
using Bounds = std::array<double, kGuideGrid>;

Bounds BoundsOf(const double* masses) {
  Bounds bounds;
  double sum = 0, total = 0, before = 0;
  for (std::size_t i = 0; i < kGuideGrid; ++i) total += masses[i];
  for (std::size_t i = 0; i < kGuideGrid; ++i) {
    sum += masses[i];
    bounds[i] =
        i + 1 == kGuideGrid ? 1 : std::round(sum / total / kBoundStep) * kBoundStep;
    LL_CHECK_GT(bounds[i], before);
    before = bounds[i];
  }
  return bounds;
}

void Append(const Bounds& bounds, Guide& guide) {
  for (double bound : bounds) guide.cumulative.push_back(static_cast<float>(bound));
}

void AppendSquares(const std::vector<double>& squares, Guide& guide) {
  Bounds rows;
  for (std::size_t y = 0; y < kGuideGrid; ++y) {
    const double* row = &squares[y * kGuideGrid];
    rows[y] = std::accumulate(row, row + kGuideGrid, 0.0);
  }
  Append(BoundsOf(rows.data()), guide);
  for (std::size_t y = 0; y < kGuideGrid; ++y) {
    Append(BoundsOf(&squares[y * kGuideGrid]), guide);
  }
}

}  // namespace

std::uint32_t AppendGuideCell(std::span<const double, kGuideSquares> masses, double even,
                              float fraction, Guide& guide) {
  LL_CHECK(even >= 0.01 && even <= 1);
  LL_CHECK(fraction >= 0 && fraction < 1);
  const std::vector<Leaf> leaves = Divide(Pyramid(Blend(masses, even)));
  AppendSquares(Flatten(leaves), guide);
  guide.fraction.push_back(fraction);
  const auto cell = static_cast<std::uint32_t>(guide.cells() - 1);
  guide.density.resize(guide.cells() * kGuideSquares);
  SetGuideDensities(guide, cell);
  return cell;
}

void SetGuideDensities(Guide& guide, std::uint32_t cell) {
  const float* rows = &guide.cumulative[cell * kGuideBounds];
  for (std::size_t y = 0; y < kGuideGrid; ++y) {
    const float* row = rows + kGuideGrid * (y + 1);
    const double height = double{rows[y]} - (y > 0 ? double{rows[y - 1]} : 0);
    for (std::size_t x = 0; x < kGuideGrid; ++x) {
      const double width = double{row[x]} - (x > 0 ? double{row[x - 1]} : 0);
      guide.density[cell * kGuideSquares + y * kGuideGrid + x] =
          static_cast<float>(height * width * (kGuideSquares / 4.0));
    }
  }
}

Guide UnknowingGuide() {
  Guide guide;
  const std::vector<double> none(kGuideSquares, 0.0);
  const std::uint32_t cell =
      AppendGuideCell(std::span<const double, kGuideSquares>(none), 1, 0, guide);
  guide.nodes.push_back({0, Guide::Node::kLeaf | cell << 3});
  return guide;
}

}  // namespace lanelight

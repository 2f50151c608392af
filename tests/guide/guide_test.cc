// The routines of a guide: cells of points, densities, directions.
#include <catch2/catch.hpp>
#include <limits>

#include "kernels/probe/guide_probe.h"
#include "src/prepare/guide_square.h"
#include "src/stat/hypothesis.h"
#include "tests/guide/random_guide.h"
#include "tests/shade/probe_batch.h"
#include "tests/stat/chi2.h"
#include "tests/support/test_target.h"

namespace lanelight::test {
namespace {

constexpr std::uint32_t kCells = 8;  // that the lanes of a vector are in

struct Columns {
  std::uint32_t n;
  std::vector<float> point[3], normal[3], direction[3], u0, u1, pdf;
  std::vector<std::uint32_t> cell;

  explicit Columns(std::uint32_t count) : n(count) {
    const std::size_t size = (count + kGuidePadding - 1) / kGuidePadding * kGuidePadding;
    for (auto* v : {&point[0], &point[1], &point[2], &normal[0], &normal[1], &normal[2],
                    &direction[0], &direction[1], &direction[2], &u0, &u1, &pdf}) {
      v->assign(size, 0.f);
    }
    cell.assign(size, 0);
  }
  void Set(std::vector<float>* column, std::uint32_t i, Vec3d v) {
    for (int c = 0; c < 3; ++c) column[c][i] = static_cast<float>(v[c]);
  }
  GuideBatch View(const Guide& guide) {
    GuideBatch b;
    b.guide = &guide, b.n = n, b.cell = cell.data(), b.pdf_sa = pdf.data();
    b.u0 = u0.data(), b.u1 = u1.data();
    for (int c = 0; c < 3; ++c) {
      b.point[c] = point[c].data(), b.normal[c] = normal[c].data();
      b.direction[c] = direction[c].data();
    }
    return b;
  }
  Vec3f P(std::uint32_t i) const { return {point[0][i], point[1][i], point[2][i]}; }
  Vec3f N(std::uint32_t i) const { return {normal[0][i], normal[1][i], normal[2][i]}; }
};

const Vec3d kUp = {0, 0, 1};  // directions of cells are about it

// Probability of a square of a cell, by its bounds.
double Mass(const Guide& guide, std::uint32_t cell, std::size_t square) {
  const float* rows = &guide.cumulative[cell * kGuideBounds];
  const auto between = [](const float* bounds, std::size_t i) {
    return double{bounds[i]} - (i > 0 ? double{bounds[i - 1]} : 0);
  };
  const std::size_t y = square / kGuideGrid, x = square % kGuideGrid;
  return between(rows, y) * between(rows + kGuideGrid * (y + 1), x);
}

// In the frame that the lanes' directions are in.
GuideSquarePoint SquarePoint(Vec3d local) {
  // That of kUp has its axes along x and y.
  return ToGuideSquare(kUp, local);
}

std::size_t SquareOf(Vec3d local) {
  const GuideSquarePoint at = SquarePoint(local);
  const auto part = [](double x) {
    return std::min(static_cast<std::size_t>(x * kGuideGrid),
                    std::size_t{kGuideGrid - 1});
  };
  return part(at.v) * kGuideGrid + part(at.u);
}

void CheckCells(const Guide& guide, Columns& columns) {
  ForEachTarget([&](const std::string& target) {
    ProbeGuideCells(TestTarget(), columns.View(guide));
    INFO(target);
    for (std::uint32_t i = 0; i < columns.n; ++i) {
      REQUIRE(columns.cell[i] == CellByHand(guide, columns.P(i), columns.N(i)));
    }
  });
}

}  // namespace

TEST_CASE("guide: lanes find the cells that a descent by hand finds", "[guide]") {
  reference::Random random(5);
  for (int levels : {0, 1, 5, 12}) {
    const Guide guide = RandomGuide({.seed = 7u + unsigned(levels), .levels = levels});
    Columns columns(4099);
    for (std::uint32_t i = 0; i < columns.n; ++i) {
      columns.Set(columns.point, i, 2.5 * RandomDirection(random));
      columns.Set(columns.normal, i, RandomDirection(random));
    }
    CheckCells(guide, columns);
    std::vector<bool> met(guide.cells());
    for (std::uint32_t cell : columns.cell) met[cell] = true;
    if (levels == 5) CHECK(std::count(met.begin(), met.end(), true) > 8);
  }
}

TEST_CASE("guide: a bound belongs to the cell above it", "[guide]") {
  const Guide guide = RandomGuide({.seed = 3, .levels = 6});
  Columns columns(static_cast<std::uint32_t>(3 * guide.nodes.size()));
  const float infinity = std::numeric_limits<float>::infinity();
  for (std::uint32_t i = 0; i < columns.n; ++i) {
    const Guide::Node& node = guide.nodes[i / 3];
    const std::uint32_t axis = node.next & 7;
    const float at[] = {std::nextafter(node.at, -infinity), node.at,
                        std::nextafter(node.at, infinity)};
    if (axis < 3) columns.point[axis][i] = at[i % 3];
    if (axis >= 3 && axis < 6) columns.normal[axis - 3][i] = at[i % 3];
  }
  CheckCells(guide, columns);
  // At the root: on the bound as above it, below it not.
  const Guide::Node& root = guide.nodes[0];
  REQUIRE((root.next & 7) != Guide::Node::kLeaf);
  CHECK(columns.cell[0] != columns.cell[1]);
  CHECK(columns.cell[1] == columns.cell[2]);
}

TEST_CASE("guide: what is no number has a cell", "[guide]") {
  const Guide guide = RandomGuide({.seed = 3, .levels = 6});
  Columns columns(64);
  const float values[] = {std::numeric_limits<float>::quiet_NaN(),
                          std::numeric_limits<float>::infinity(),
                          -std::numeric_limits<float>::infinity(), 0};
  for (std::uint32_t i = 0; i < columns.n; ++i) {
    for (int c = 0; c < 3; ++c) {
      columns.point[c][i] = values[i >> (2 * c) & 3];
      columns.normal[c][i] = values[(i >> c) & 3];
      columns.direction[c][i] = values[i >> (2 * c) & 3];
    }
  }
  CheckCells(guide, columns);
  ForEachTarget([&](const std::string&) {
    ProbeGuidePdfs(TestTarget(), columns.View(guide));  // reads what it has
    for (std::uint32_t i = 0; i < columns.n; ++i) REQUIRE(!(columns.pdf[i] < 0));
  });
}

TEST_CASE("guide: the density of every cell integrates to 1", "[guide]") {
  const Guide guide = RandomGuide({.seed = 11, .levels = 2, .decades = 12, .even = 0.01});
  // Over points of the disk by the sine of the elevation, z dz = r dr, which is the
  // cosine's measure: pdf_sa / cosine is to be integrated, which jumps at borders only.
  constexpr std::uint32_t kSide = 24 * kGuideGrid;
  Columns columns(kSide * kSide);
  std::vector<double> share(columns.n);
  for (std::uint32_t i = 0; i < columns.n; ++i) {
    const double u = (i % kSide + 0.5) / kSide, v = (i / kSide + 0.5) / kSide;
    const Vec3d d = FromGuideSquare(kUp, u, v);
    columns.Set(columns.direction, i, d);
    // Solid angle of a point of the grid over [-1, 1]^2.
    share[i] = 4.0 / columns.n / SquarePoint(d).to_solid_angle;
  }
  ForEachTarget([&](const std::string& target) {
    for (std::uint32_t cell = 0; cell < guide.cells(); ++cell) {
      std::fill(columns.cell.begin(), columns.cell.end(), cell);
      ProbeGuidePdfs(TestTarget(), columns.View(guide));
      double sum = 0;
      for (std::uint32_t i = 0; i < columns.n; ++i) sum += columns.pdf[i] * share[i];
      INFO(target << ", cell " << cell);
      CHECK(sum == Approx(1).epsilon(1e-5));
      if (target == "EMU128") break;  // the same code, thirty times slower
    }
  });
}

TEST_CASE("guide: nothing is below the surface", "[guide]") {
  const Guide guide = RandomGuide({.seed = 12, .levels = 3});
  Columns columns(4096);
  reference::Random random(3);
  for (std::uint32_t i = 0; i < columns.n; ++i) {
    Vec3d d = RandomDirection(random);
    d.z = i % 16 == 0 ? 0 : -std::abs(d.z);
    columns.Set(columns.direction, i, Normalize(d));
  }
  ForEachTarget([&](const std::string&) {
    ProbeGuidePdfs(TestTarget(), columns.View(guide));
    for (std::uint32_t i = 0; i < columns.n; ++i) REQUIRE(columns.pdf[i] == 0);
  });
}

namespace {

// Samples of one cell, or of cells in turns, so that the lanes of a vector are in
// different ones; counted by square and cell.
Columns Samples(const Guide& guide, std::uint32_t cells, std::uint32_t n) {
  Columns columns(n);
  reference::Random random(19);
  const auto unit = [&] { return static_cast<float>(random.Bits() >> 40) * 0x1p-24f; };
  for (std::uint32_t i = 0; i < columns.cell.size(); ++i) {
    columns.cell[i] = i % cells;
    columns.u0[i] = unit(), columns.u1[i] = unit();
  }
  ProbeGuideSamples(TestTarget(), columns.View(guide));
  return columns;
}

std::vector<double> Counts(const Columns& columns, std::uint32_t cells) {
  std::vector<double> counts(cells * kGuideSquares);
  for (std::uint32_t i = 0; i < columns.n; ++i) {
    const Vec3d d = {columns.direction[0][i], columns.direction[1][i],
                     columns.direction[2][i]};
    REQUIRE(Length(d) == Approx(1).epsilon(1e-5));
    REQUIRE(d.z >= 0);
    counts[columns.cell[i] * kGuideSquares + SquareOf(d)] += 1;
  }
  return counts;
}

std::vector<double> Expected(const Guide& guide, std::uint32_t cells, std::uint32_t n) {
  std::vector<double> expected(cells * kGuideSquares);
  for (std::uint32_t cell = 0; cell < cells; ++cell) {
    const double samples = n / cells + (cell < n % cells ? 1 : 0);
    for (std::size_t square = 0; square < kGuideSquares; ++square) {
      expected[cell * kGuideSquares + square] = samples * Mass(guide, cell, square);
    }
  }
  return expected;
}

}  // namespace

TEST_CASE("guide: directions have the density of their cell", "[guide][stat]") {
  const Guide guide = RandomGuide({.seed = 13, .levels = 5, .decades = 3});
  REQUIRE(guide.cells() >= kCells);
  const double level =
      stat::SidakLevel(1e-4, 2 * static_cast<int>(AvailableTargets().size()));
  constexpr std::uint32_t kSamples = 1 << 18;
  ForEachTarget([&](const std::string& target) {
    for (const std::uint32_t cells : {1u, kCells}) {
      const Columns columns = Samples(guide, cells, kSamples);
      const std::vector<double> counts = Counts(columns, cells);
      INFO(target << ", lanes in " << cells << " cells");
      CHECK(stat::ChiSquareTest(counts, Expected(guide, cells, kSamples)).p > level);
    }
  });
}

TEST_CASE("guide: a sample that is not of its density is found", "[guide][stat]") {
  const Guide guide = RandomGuide({.seed = 13, .levels = 5, .decades = 3});
  constexpr std::uint32_t kSamples = 1 << 20;
  const std::vector<double> counts = Counts(Samples(guide, 1, kSamples), 1);
  const std::vector<double> expected = Expected(guide, 1, kSamples);
  CHECK(stat::ChiSquareTest(counts, expected).p > 1e-4);
  // Every other square 3 % too heavy, as where bounds are off.
  std::vector<double> wrong = expected;
  double sum = 0;
  for (std::size_t i = 0; i < wrong.size(); ++i) sum += wrong[i] *= i % 2 ? 1.03 : 1;
  for (double& w : wrong) w *= kSamples / sum;
  CHECK(stat::ChiSquareTest(counts, wrong).p < 1e-9);
  // The density of another cell.
  std::vector<double> other = Expected(guide, 2, 2 * kSamples);
  other.erase(other.begin(), other.begin() + kGuideSquares);
  CHECK(stat::ChiSquareTest(counts, other).p < 1e-9);
}

TEST_CASE("guide: a sample's density is that of its direction", "[guide]") {
  const Guide guide = RandomGuide({.seed = 17, .levels = 5, .decades = 6});
  ForEachTarget([&](const std::string& target) {
    REQUIRE(guide.cells() >= kCells);
    Columns columns = Samples(guide, kCells, 1 << 14);
    const std::vector<float> sampled = columns.pdf;
    ProbeGuidePdfs(TestTarget(), columns.View(guide));
    std::uint32_t other = 0;
    for (std::uint32_t i = 0; i < columns.n; ++i) {
      // Near the horizon a float's direction has lost digits of the cosine.
      const double z = double{columns.direction[2][i]};
      other += std::abs(sampled[i] / columns.pdf[i] - 1) > 1e-5 / (z * z) ? 1 : 0;
    }
    INFO(target);
    CHECK(other < columns.n / 500);  // rounding at the edges of squares
  });
}

TEST_CASE("guide: the ends of the numbers stay within the last square", "[guide]") {
  const Guide guide = RandomGuide({.seed = 23, .levels = 3});
  Columns columns(16);
  for (std::uint32_t i = 0; i < 16; ++i) {
    columns.u0[i] = i % 2 == 0 ? 0 : 1 - 0x1p-24f;
    columns.u1[i] = i / 2 % 2 == 0 ? 0 : 1 - 0x1p-24f;
    columns.cell[i] = static_cast<std::uint32_t>(i / 4 % guide.cells());
  }
  ForEachTarget([&](const std::string&) {
    ProbeGuideSamples(TestTarget(), columns.View(guide));
    for (std::uint32_t i = 0; i < 16; ++i) {
      const Vec3d d = {columns.direction[0][i], columns.direction[1][i],
                       columns.direction[2][i]};
      const bool right = i / 2 % 2 == 1, high = i % 2 == 1;
      CHECK((right ? d.x : -d.x) > 0.7 * (1 - 1e-3));
      CHECK((high ? d.y : -d.y) > 0.7 * (1 - 1e-3));
      CHECK(std::isfinite(columns.direction[0][i]));
    }
  });
}

}  // namespace lanelight::test

// light-points=projected on single triangles and rectangles: where samples lie, and their
// density, against plain formulas in double precision; the irradiance that they estimate
// against its closed form; what the warp does to its variance.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "src/base/stat/distributions.h"
#include "src/base/stat/hypothesis.h"
#include "tests/base/stat/chi2.h"
#include "tests/kernels/lights/projected_truth.h"
#include "tests/support/each_target.h"

namespace lanelight::test {
namespace {

constexpr int kSquares = 8;  // along each side of the square
const FeatureSet kProjected = {Feature::kProjectedLights};

// The receiver looks at the light, past it to two sides, along its plane, and away.
std::vector<Vec3d> NormalsFor(const Flat& f) {
  const Vec3d at = Normalize(f.At(0.3, 0.4)), x = Normalize(Cross(at, f.y));
  const Vec3d y = Cross(at, x);
  return {at,
          Normalize(at + x * 2.0),
          Normalize(at - x * 1.5 + y * 3.0),
          Normalize(f.x),
          Normalize(x + y * 0.2),
          -f.Normal(),
          f.Normal(),
          -at};
}

struct Case {
  Flat f;
  Vec3d n;
};

// unclear: with lights that are sampled by area, and rectangles of which rounding decides
// the side that u0 goes along.
std::vector<Case> Cases(bool unclear) {
  std::vector<Case> cases;
  for (const Flat& exact : FlatLights()) {
    const Flat f = Rounded(exact);
    if (!unclear && AngleOf(f) < 2e-7) continue;
    if (!unclear && f.rectangle && std::abs(FartherAlongX(f)) < 1e-6) continue;
    for (const Vec3d n : NormalsFor(f)) {
      cases.push_back({f, VecCast<double>(VecCast<float>(n))});
    }
  }
  return cases;
}

double Clearance(const Case& c) {
  return std::abs(Dot(c.f.Normal(), Normalize(c.f.corner)));
}

// Irradiance of unit radiance, of a polygon above the receiver: Lambert 1760.
double Irradiance(const Case& c) {
  std::vector<Vec3d> v = {c.f.At(0, 0), c.f.At(1, 0), c.f.At(1, 1), c.f.At(0, 1)};
  if (!c.f.rectangle) v.erase(v.begin() + 2);
  double sum = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Vec3d a = v[i], b = v[(i + 1) % v.size()], edge = Cross(a, b);
    sum += std::atan2(Length(edge), Dot(a, b)) * Dot(Normalize(edge), c.n);
  }
  return std::abs(sum) / 2;
}

// Least cosine of its corners.
double Lowest(const Case& c) {
  double minimum = c.f.rectangle ? Cosine(c.n, c.f.At(1, 1)) : 1;
  for (const Vec3d v : {c.f.At(0, 0), c.f.At(1, 0), c.f.At(0, 1)}) {
    minimum = std::min(minimum, Cosine(c.n, v));
  }
  return minimum;
}

struct Moments {
  double mean = 0, variance = 0;
};

// Of irradiance estimates (1) and of the part of the light's directions that is found
// (0): cosine^power / density.
Moments Estimate(const Draw& draw, std::uint32_t count, Vec3d n, int power) {
  const PathColumns& p = draw.fixture.wave.path;
  double sum = 0, square = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double cosine = Cosine(n, {p.ls_x[i], p.ls_y[i], p.ls_z[i]});
    const double value = (power > 0 ? std::max(cosine, 0.0) : 1) * kPmf / p.ls_pdf[i];
    sum += value, square += value * value;
  }
  const double mean = sum / count;
  return {mean, std::max(square / count - mean * mean, 0.0)};
}

}  // namespace

TEST_CASE("projected samples have the density that they report", "[lights]") {
  constexpr std::uint32_t kCount = 259;
  const EachTarget target;
  for (const Case& c : Cases(false)) {
    CAPTURE(c.f.name, c.f.rectangle, c.n.x, c.n.y, c.n.z);
    const Draw draw(c.f, kCount, kProjected, true, c.n);
    const CornerCosines corners(c.f, c.n);
    // Where points are is rounded: by 4e-7 rad of the receiver's view, over what it
    // sees; the clearance of shadow rays adds to that at a grazing angle.
    const double size = std::sqrt(AngleOf(c.f) * Clearance(c));
    const double tolerance = 4e-6 * (1 + 1 / Clearance(c)) + 2e-5 / size;
    for (std::uint32_t i = 0; i < kCount; ++i) {
      const Vec3d at = draw.Where(i);
      const double u = corners.Density(Invert(c.f, at.x, at.y));
      CHECK(draw.fixture.wave.path.ls_pdf[i] * AngleOf(c.f) / kPmf ==
            Approx(u).epsilon(tolerance));
      CHECK(u > 1 / 7.76);
    }
  }
}

TEST_CASE("projected samples follow their density", "[lights]") {
  constexpr std::uint32_t kCount = 1 << 14;
  const std::vector<std::string> targets = AvailableTargets();
  const std::vector<Case> cases = Cases(false);
  // False alarms: 1e-6 for all together.
  const double level = stat::SidakLevel(1e-6, int(targets.size() * cases.size()));
  const EachTarget target;
  for (const Case& c : cases) {
    CAPTURE(c.f.name, c.f.rectangle, c.n.x, c.n.y, c.n.z);
    const Draw draw(c.f, kCount, kProjected, true, c.n);
    const CornerCosines corners(c.f, c.n);
    std::vector<double> observed(kSquares * kSquares, 0), expected = observed;
    for (std::uint32_t i = 0; i < kCount; ++i) {
      const Vec3d at = draw.Where(i);
      const Square u = Invert(c.f, at.x, at.y);
      const int a = std::clamp(static_cast<int>(u.u0 * kSquares), 0, kSquares - 1);
      const int b = std::clamp(static_cast<int>(u.u1 * kSquares), 0, kSquares - 1);
      observed[static_cast<std::size_t>(a * kSquares + b)] += 1;
    }
    for (int i = 0; i < kSquares * kSquares; ++i) {
      // Bilinear: its mean over a cell is its value in the middle.
      const Square u = {(i / kSquares + 0.5) / kSquares, (i % kSquares + 0.5) / kSquares};
      expected[static_cast<std::size_t>(i)] =
          kCount * corners.Density(u) / (kSquares * kSquares);
    }
    CHECK(stat::ChiSquareTest(observed, expected).p > level);
  }
}

TEST_CASE("projected samples find irradiance and every direction", "[lights]") {
  constexpr std::uint32_t kCount = 1 << 14;
  std::vector<Case> cases = Cases(true);
  // Two tests of each, normal deviates, false alarms 1e-6 together.
  const double level = stat::SidakLevel(1e-6, int(2 * cases.size()));
  const double bound = stat::NormalQuantile(1 - level / 2);
  int irradiances = 0;
  for (const Case& c : cases) {
    CAPTURE(c.f.name, c.f.rectangle, c.n.x, c.n.y, c.n.z);
    const Draw draw(c.f, kCount, kProjected, true, c.n);
    const double rounding =
        4e-6 * (1 + 1 / Clearance(c)) + (AngleOf(c.f) < kMinSolidAngle ? 1e-3 : 0);
    const auto check = [&](int power, double want) {
      const Moments m = Estimate(draw, kCount, c.n, power);
      CHECK(std::abs(m.mean - want) <
            bound * std::sqrt(m.variance / kCount) + rounding * want);
    };
    check(0, AngleOf(c.f));  // the density integrates to one, and is never zero
    if (Lowest(c) < 1e-3) continue;
    check(1, Irradiance(c));
    ++irradiances;
  }
  CHECK(irradiances > 20);
}

TEST_CASE("hits on lights compute the density of projected samples", "[lights]") {
  constexpr std::uint32_t kCount = 67;
  const EachTarget target;
  for (const Case& c : Cases(true)) {
    CAPTURE(c.f.name, c.f.rectangle, c.n.x, c.n.y, c.n.z);
    Draw draw(c.f, kCount, kProjected, true, c.n);
    draw.Hit(kCount, {Feature::kMis, Feature::kProjectedHits});
    const double size = std::sqrt(AngleOf(c.f) * Clearance(c));
    const double tolerance = AngleOf(c.f) > kMinSolidAngle
                                 ? 4e-6 * (1 + 1 / Clearance(c)) + 2e-5 / size
                                 : 1e-4 * (1 + 0.1 / Clearance(c));
    for (std::uint32_t i = 0; i < kCount; ++i) {
      CHECK(draw.fixture.wave.path.l_r[i] == Approx(1).epsilon(tolerance));
    }
  }
}

TEST_CASE("lights below the receiver and tiny ones are not warped", "[lights]") {
  constexpr std::uint32_t kCount = 1024;
  for (const Flat& exact : FlatLights()) {
    const Flat f = Rounded(exact);
    const Vec3d away = -Normalize(f.At(0.4, 0.4));
    const bool tiny = AngleOf(f) < kMinSolidAngle;
    if (!tiny && Lowest({f, -away}) < 0.01) continue;  // some of it is above
    CAPTURE(f.name, f.rectangle);
    const Draw draw(f, kCount, kProjected, true, tiny ? -away : away);
    const Draw plain(f, kCount);
    for (std::uint32_t i = 0; i < kCount; ++i) {
      CHECK(draw.fixture.wave.path.ls_pdf[i] ==
            Approx(plain.fixture.wave.path.ls_pdf[i]).epsilon(tiny ? 0 : 1e-6));
    }
  }
}

TEST_CASE("a warp by the cosine lowers the variance of oblique light", "[lights]") {
  constexpr std::uint32_t kCount = 1 << 16;
  // A window that reaches down to the floor, and one that lies aslant.
  const Flat window = {"window", {1, -1, 0.001}, {0, 2, 0}, {0, 0, 2}, true};
  const Flat aslant = {"aslant", {0.5, -1, 0.1}, {0.3, 1.5, 0.2}, {0.5, -0.3, 1}, false};
  for (const Flat& f : {window, aslant}) {
    CAPTURE(f.name);
    const Vec3d up = {0, 0, 1};
    const Draw warped(f, kCount, kProjected, true, up), plain(f, kCount);
    const double with = Estimate(warped, kCount, up, 1).variance;
    const double without = Estimate(plain, kCount, up, 1).variance;
    CHECK(with < 0.25 * without);
  }
}

}  // namespace lanelight::test

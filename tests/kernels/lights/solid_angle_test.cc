// Light samples by solid angle on single triangles and rectangles: their density against
// the solid angle in double precision, where they lie against the solid angles of parts
// of the light, from tiny and grazing to huge and surrounding; and where area takes over.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "src/base/stat/hypothesis.h"
#include "tests/base/stat/chi2.h"
#include "tests/kernels/lights/flat_light.h"
#include "tests/support/each_target.h"

namespace lanelight::test {
namespace {

constexpr int kBins = 8;  // along each side

// The bound that kernels/warp/solid_angle-inl.h states; of lights that are too small,
// which are seen straight on here, how much the density by area may vary.
double ErrorOfAngle(const Flat& f) {
  const double cosine = std::abs(Dot(f.Normal(), Normalize(f.corner)));
  const double error = 2e-6 * (1 + 1 / cosine);
  if (AngleOf(f) > kMinSolidAngle) return error;
  return error + 4 * (Length(f.x) + Length(f.y)) / Length(f.corner);
}

double PValue(const Draw& draw, std::uint32_t count) {
  const Flat& f = draw.light;
  const double total = AngleOf(f);
  std::vector<double> observed(2 * kBins * kBins, 0), expected = observed;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3d at = draw.Where(i) * double{kBins};
    const int a = std::clamp(static_cast<int>(at.x), 0, kBins - 1);
    const int b = std::clamp(static_cast<int>(at.y), 0, kBins - 1);
    const bool upper = at.x - a + at.y - b > 1 && (f.rectangle || a + b < kBins - 1);
    observed[static_cast<std::size_t>(2 * (a * kBins + b) + upper)] += 1;
  }
  for (int i = 0; i < kBins * kBins; ++i) {
    const int a = i / kBins, b = i % kBins;
    const auto corner = [&](int u, int v) {
      return f.At(double(a + u) / kBins, double(b + v) / kBins);
    };
    if (!f.rectangle && a + b > kBins - 1) continue;
    const double fraction = count / total;
    expected[2 * i] = fraction * TriangleAngle(corner(0, 0), corner(1, 0), corner(0, 1));
    if (!f.rectangle && a + b == kBins - 1) continue;
    expected[2 * i + 1] =
        fraction * TriangleAngle(corner(1, 1), corner(0, 1), corner(1, 0));
  }
  return stat::ChiSquareTest(observed, expected).p;
}

}  // namespace

TEST_CASE("the density of samples by solid angle is one over it", "[lights]") {
  const EachTarget target;
  for (const Flat& exact : FlatLights()) {
    const Flat f = Rounded(exact);
    CAPTURE(f.name, f.rectangle, AngleOf(f));
    const Draw draw(f, 67);
    const PathColumns& p = draw.fixture.wave.path;
    const double omega = AngleOf(f);
    for (std::uint32_t i = 0; i < 67; ++i) {
      CHECK(p.ls_pdf[i] == Approx(kPmf / omega).epsilon(ErrorOfAngle(f)));
      // Radiance times solid angle without any noise: what is left is visibility.
      CHECK(p.ls_r[i] == Approx(2 * omega / kPmf).epsilon(ErrorOfAngle(f)));
      CHECK(p.ls_b[i] == Approx(5 * omega / kPmf).epsilon(ErrorOfAngle(f)));
    }
  }
}

TEST_CASE("samples by solid angle are uniform over it", "[lights]") {
  constexpr std::uint32_t kCount = 1 << 15;
  const std::vector<std::string> targets = AvailableTargets();
  const std::vector<Flat> lights = FlatLights();
  // False alarms: 1e-6 for all together.
  const double level = stat::SidakLevel(1e-6, int(targets.size() * lights.size()));
  const EachTarget target;
  for (const Flat& exact : lights) {
    const Flat f = Rounded(exact);
    CAPTURE(f.name, f.rectangle);
    CHECK(PValue(Draw(f, kCount), kCount) > level);
    for (std::uint32_t i = 0; i < 4; ++i) CHECK(std::isfinite(Draw(f, 4).Where(i).x));
  }
}

TEST_CASE("hits on lights compute the density of samples", "[lights]") {
  constexpr std::uint32_t kCount = 67;
  std::vector<Flat> lights = FlatLights();
  // By area, whose density varies by a tenth over it.
  for (const bool rectangle : {true, false}) {
    lights.push_back(
        {"too small, flat", {1, 0, 0.01}, {1e-3, 0, 0}, {0, 1e-3, 0}, rectangle});
  }
  const EachTarget target;
  for (const Flat& exact : lights) {
    const Flat f = Rounded(exact);
    CAPTURE(f.name, f.rectangle);
    Draw draw(f, kCount);
    draw.Hit(kCount, {Feature::kMis, Feature::kSolidAngleLights});
    const double cosine = std::abs(Dot(f.Normal(), Normalize(f.corner)));
    // As dense as the ray: half of the radiance. By area, the ray has missed the light
    // by the clearance of the shadow ray.
    const double tolerance =
        AngleOf(f) > kMinSolidAngle ? 4e-6 * (1 + 1 / cosine) : 1e-4 * (1 + 0.1 / cosine);
    for (std::uint32_t i = 0; i < kCount; ++i) {
      CHECK(draw.fixture.wave.path.l_r[i] == Approx(1).epsilon(tolerance));
    }
  }
}

TEST_CASE("samples by area are not uniform over the solid angle", "[lights]") {
  constexpr std::uint32_t kCount = 1 << 15;
  for (const Flat& f : FlatLights()) {
    if (std::string(f.name) != "aside") continue;
    CHECK(PValue(Draw(f, kCount, {}), kCount) < 1e-9);
  }
}

TEST_CASE("samples lie on the light", "[lights]") {
  for (const Flat& exact : FlatLights()) {
    const Flat f = Rounded(exact);
    CAPTURE(f.name, f.rectangle);
    const Draw draw(f, 4096);
    // Rounding of receiver, light and shadow ray, in units of the shorter side; of a
    // triangle, whose plane meets a direction, more where that is flat.
    const double reach = Length(f.corner) + Length(f.x) + Length(f.y);
    const double cosine = std::abs(Dot(f.Normal(), f.corner)) / reach;
    const double slack = 1e-6 * reach / std::min(Length(f.x), Length(f.y)) +
                         (f.rectangle ? 0 : 2e-7 / cosine);
    double low = 0, high = 0;
    for (std::uint32_t i = 0; i < 4096; ++i) {
      const Vec3d at = draw.Where(i);
      low = std::min({low, at.x, at.y});
      high = std::max(high, f.rectangle ? std::max(at.x, at.y) : at.x + at.y);
    }
    CHECK(low > -slack);
    CHECK(high < 1 + slack);
    CHECK(high > 0.9);
  }
}

TEST_CASE("lights that are too small for solid angles are sampled by area", "[lights]") {
  // 0.9 and 1.1 of the threshold, straight on and at a cosine of 0.01.
  for (const double part : {0.9, 1.1}) {
    for (const double height : {1.0, 0.01}) {
      for (const bool rectangle : {true, false}) {
        const double away = height < 1 ? 1 : 0, omega = part * kMinSolidAngle;
        const double d = std::hypot(away, height);
        const double side = std::sqrt(omega * d * d * d / height * (rectangle ? 1 : 2));
        const Flat f = {"", {away, 0, height}, {side, 0, 0}, {0, side, 0}, rectangle};
        const Draw angle(f, 2048), area(f, 2048, {});
        CAPTURE(part, height, rectangle);
        double largest = 0;
        for (std::uint32_t i = 0; i < 2048; ++i) {
          const float a = angle.fixture.wave.path.ls_pdf[i];
          const float b = area.fixture.wave.path.ls_pdf[i];
          largest = std::max(largest, std::abs(double(a) / double(b) - 1));
        }
        if (part < 1) CHECK(largest == 0);
        if (part > 1) CHECK(largest > 0);
        // What the switch costs: the noise of a density that varies by so much.
        CHECK(largest < 4 * side * (1 + away / height));
      }
    }
  }
}

TEST_CASE("a light does not shine backwards by solid angle", "[lights]") {
  for (const bool rectangle : {true, false}) {
    // cross(x, y) = +z, away from the receiver.
    const Flat f = {"", {-0.5, -0.5, 1}, {1, 0, 0}, {0, 1, 0}, rectangle};
    const Flat back = {"", {-0.5, -0.5, -1}, {1, 0, 0}, {0, 1, 0}, rectangle};
    const Draw away(f, 64, Draw::Angle(), false), toward(back, 64, Draw::Angle(), false);
    for (std::uint32_t i = 0; i < 64; ++i) {
      CHECK(away.fixture.wave.path.ls_r[i] == 0);
      CHECK(toward.fixture.wave.path.ls_r[i] > 0);
    }
  }
}

TEST_CASE("lights do not light themselves", "[lights]") {
  // Around the receiver, at a height that is rounding: p_error is 1e-8 here.
  for (const Feature points : {Feature::kSolidAngleLights, Feature::kProjectedLights}) {
    for (const bool rectangle : {true, false}) {
      for (const bool two_sided : {true, false}) {
        for (const double height : {0.0, 1e-8, -1e-8}) {
          const Flat f = {"", {-0.25, -0.25, height}, {1, 0, 0}, {0, 1, 0}, rectangle};
          const Draw draw(f, 259, {points}, two_sided);
          CAPTURE(rectangle, two_sided, height);
          for (std::uint32_t i = 0; i < 259; ++i) {
            CHECK(draw.fixture.wave.path.ls_r[i] == 0);
          }
        }
      }
    }
  }
}

TEST_CASE("samples are finite in the plane and at the corners of a light", "[lights]") {
  for (const bool rectangle : {true, false}) {
    for (const Vec3d corner : {Vec3d{0, 0, 0}, Vec3d{-0.5, 0, 0}, Vec3d{1, 1, 0},
                               Vec3d{-0.5, -0.5, 0}, Vec3d{-1, -1, 0}}) {
      const Flat f = {"", corner, {1, 0, 0}, {0, 1, 0}, rectangle};
      const Draw draw(f, 64);
      const PathColumns& p = draw.fixture.wave.path;
      for (std::uint32_t i = 0; i < 64; ++i) {
        CHECK(std::isfinite(p.ls_r[i]));
        CHECK(p.ls_r[i] >= 0);
      }
    }
  }
}

}  // namespace lanelight::test

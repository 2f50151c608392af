// Light samples by solid angle on single triangles and rectangles: their density against
// the solid angle in double precision, where they lie against the solid angles of parts
// of the light, from tiny and grazing to huge and surrounding; and where area takes over.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "kernels/simd/target.h"
#include "kernels/stages.h"
#include "src/prepare/parameters.h"
#include "src/stat/hypothesis.h"
#include "tests/lights/light_truth.h"
#include "tests/stat/chi2.h"
#include "tests/support/wave_fixture.h"

namespace lanelight::test {
namespace {

constexpr float kPmf = 0.75f;
constexpr double kLeast = 1e-7;  // as in kernels/warp/solid_angle-inl.h
constexpr int kCells = 8;        // along each side

// A light from `corner` along two sides, which for a rectangle are at right angles.
struct Flat {
  const char* name;
  Vec3d corner, x, y;
  bool rectangle;

  Vec3d At(double u, double v) const { return corner + x * u + y * v; }
  Vec3d Normal() const { return Normalize(Cross(x, y)); }
  double Area() const { return Length(Cross(x, y)) / (rectangle ? 1 : 2); }
};

double TriangleAngle(Vec3d a, Vec3d b, Vec3d c) {
  const double la = Length(a), lb = Length(b), lc = Length(c);
  const double det = std::abs(Dot(a, Cross(b - a, c - a)));
  return 2 *
         std::atan2(det, la * lb * lc + Dot(a, b) * lc + Dot(b, c) * la + Dot(c, a) * lb);
}

// Seen from the origin: the parallelogram between two corners of the sides' coordinates.
double PartAngle(const Flat& f, double u0, double v0, double u1, double v1) {
  return TriangleAngle(f.At(u0, v0), f.At(u1, v0), f.At(u0, v1)) +
         TriangleAngle(f.At(u1, v1), f.At(u0, v1), f.At(u1, v0));
}

double AngleOf(const Flat& f) {
  if (f.rectangle) return PartAngle(f, 0, 0, 1, 1);
  return TriangleAngle(f.corner, f.corner + f.x, f.corner + f.y);
}

CompiledScene SceneOf(const Flat& f, bool two_sided) {
  const auto corner = [&](double u, double v) { return VecCast<float>(f.At(u, v)); };
  Geometry g;
  g.triangles = {MakeTriangle(corner(0, 0), corner(1, 0), corner(0, 1))};
  if (f.rectangle) {
    g.triangles.push_back(MakeTriangle(corner(1, 1), corner(0, 1), corner(1, 0)));
  }
  CompiledScene scene = MakeScene(std::move(g));
  scene.lights.lights = {FlatLight(
      f.rectangle ? LightShape::kRectangle : LightShape::kTriangle, f.corner, f.x, f.y)};
  LightRecord& light = scene.lights.lights[0];
  light.pmf = kPmf;
  light.two_sided = two_sided;
  light.radiance[0] = 2, light.radiance[1] = 3, light.radiance[2] = 5;
  for (TriangleRecord& t : scene.geometry.triangles) t.light = 0;
  return scene;
}

// Light samples of a receiver at the origin.
struct Draw {
  const Flat& light;
  CompiledScene scene;
  WaveFixture fixture;

  Draw(const Flat& f, std::uint32_t count, const FeatureSet& features = Angle(),
       bool two_sided = true)
      : light(f), scene(SceneOf(f, two_sided)), fixture(scene, count) {
    PathColumns& p = fixture.wave.path;
    p.light_pmf = nullptr;
    std::mt19937 engine(53);
    for (std::uint32_t i = 0; i < count; ++i) {
      p.p_x[i] = p.p_y[i] = p.p_z[i] = 0, p.p_error[i] = 1e-8f;
      p.u_light_0[i] = static_cast<float>(engine() >> 8) * 0x1p-24f;
      p.u_light_1[i] = static_cast<float>(engine() >> 8) * 0x1p-24f;
    }
    p.u_light_0[0] = p.u_light_1[0] = p.u_light_0[1] = p.u_light_1[2] = 0;  // corners
    p.u_light_1[1] = p.u_light_0[2] = p.u_light_0[3] = p.u_light_1[3] = 1 - 0x1p-24f;
    fixture.QueueAll(QueueId::kLit, count);
    fixture.Run(f.rectangle ? SampleRectangleLightStage() : SampleTriangleLightStage(),
                features);
  }
  static FeatureSet Angle() { return {Feature::kSolidAngleLights}; }

  // Where on the light, in units of its sides. Shadow rays end a little in front of it.
  Vec3d Where(std::uint32_t i) const {
    const PathColumns& p = fixture.wave.path;
    const Vec3d w = {p.ls_x[i], p.ls_y[i], p.ls_z[i]};
    const Vec3d q = w * double{p.ls_distance[i]} - light.corner,
                n = Cross(light.x, light.y);
    const double n2 = Dot(n, n);
    return {Dot(Cross(q, light.y), n) / n2, Dot(Cross(light.x, q), n) / n2, 0};
  }
};

// From grazing to straight on, from 1.2e-4 rad (by area) and 5e-4 rad (by solid angle) to
// 1000 times the distance, from beside the light to 1e-3 of its size above it.
std::vector<Flat> Lights() {
  struct Place {
    const char* name;
    Vec3d corner;
    double x, y, turn;
  };
  const Place places[] = {{"straight on", {-0.6, -0.3, 1}, 1, 0.8, 0},
                          {"aside", {0.9, 0.4, 1}, 1, 0.5, 0.3},
                          {"far aside", {3, -7, 0.5}, 1, 2, 1},
                          {"small", {0.1, 0.2, 2}, 0.02, 0.03, 0.5},
                          {"tiny", {0.3, -0.2, 1}, 5e-4, 6e-4, 0.2},
                          {"too small", {0.3, -0.2, 1}, 1.2e-4, 1.5e-4, 0.2},
                          {"thin", {-1, 0.5, 1}, 2, 1e-3, 0.7},
                          {"grazing", {1, 0.5, 0.01}, 1, 1, 0.2},
                          {"grazing, ahead", {1, -0.5, 0.01}, 2, 1, 0},
                          {"surrounding", {-0.45, -0.6, 1e-3}, 1, 1.1, 0},
                          {"at the edge", {-0.5, 1e-3, 1e-3}, 1, 1, 0},
                          {"at the corner", {1e-2, 1e-2, 1e-2}, 1, 1, 0},
                          {"huge", {-400, -600, 1}, 1000, 1000, 0.4},
                          {"long", {-500, 1, 1}, 1000, 0.1, 0}};
  std::vector<Flat> lights;
  for (const Place& p : places) {
    const double c = std::cos(p.turn), s = std::sin(p.turn);
    // Turned about the axis to (1, 2, 3), so that no coordinate is a round number.
    const Transform turn = Transform::Rotate(70, {1, 2, 3});
    const Vec3d x = turn.Vector({p.x * c, p.x * s, 0});
    const Vec3d y = turn.Vector({-p.y * s, p.y * c, 0});
    for (bool rectangle : {true, false}) {
      lights.push_back({p.name, turn.Point(p.corner), x, y, rectangle});
    }
  }
  return lights;
}

// What the kernels see: positions and edges are floats.
Flat Rounded(Flat f) {
  const auto round = [](Vec3d v) { return VecCast<double>(VecCast<float>(v)); };
  const Vec3d x = round(f.corner + f.x), y = round(f.corner + f.y);
  f.corner = round(f.corner);
  if (f.rectangle) return f;
  f.x = x - f.corner, f.y = y - f.corner;
  return f;
}

// The bound that kernels/warp/solid_angle-inl.h states; of lights that are too small,
// which are seen straight on here, how much the density by area may vary.
double ErrorOfAngle(const Flat& f) {
  const double cosine = std::abs(Dot(f.Normal(), Normalize(f.corner)));
  const double error = 2e-6 * (1 + 1 / cosine);
  if (AngleOf(f) > kLeast) return error;
  return error + 4 * (Length(f.x) + Length(f.y)) / Length(f.corner);
}

// Scattered rays along the light samples, of their density.
void HitSamples(Draw& draw, std::uint32_t count) {
  PathColumns& p = draw.fixture.wave.path;
  for (std::uint32_t i = 0; i < count; ++i) {
    p.o_x[i] = p.o_y[i] = p.o_z[i] = 0;
    p.d_x[i] = p.ls_x[i], p.d_y[i] = p.ls_y[i], p.d_z[i] = p.ls_z[i];
    p.t[i] = p.ls_distance[i], p.bsdf_pdf[i] = p.ls_pdf[i];
    p.prim[i] = draw.light.rectangle ? i % 2 : 0;
    p.beta_r[i] = p.beta_g[i] = p.beta_b[i] = 1;
    p.l_r[i] = p.l_g[i] = p.l_b[i] = 0;
  }
  Strategy strategy;
  ApplyStrategy("directions=mis:balance", {}, strategy);
  draw.fixture.run.mis = MakeMisParameters(strategy);
  draw.fixture.QueueAll(QueueId::kHit, count);
  draw.fixture.Run(
      draw.light.rectangle ? EmissionRectangleStage() : EmissionTriangleStage(),
      {Feature::kMis, Feature::kSolidAngleLights});
}

double PValue(const Draw& draw, std::uint32_t count) {
  const Flat& f = draw.light;
  const double total = AngleOf(f);
  std::vector<double> observed(2 * kCells * kCells, 0), expected = observed;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3d at = draw.Where(i) * double{kCells};
    const int a = std::clamp(static_cast<int>(at.x), 0, kCells - 1);
    const int b = std::clamp(static_cast<int>(at.y), 0, kCells - 1);
    const bool upper = at.x - a + at.y - b > 1 && (f.rectangle || a + b < kCells - 1);
    observed[static_cast<std::size_t>(2 * (a * kCells + b) + upper)] += 1;
  }
  for (int i = 0; i < kCells * kCells; ++i) {
    const int a = i / kCells, b = i % kCells;
    const auto corner = [&](int u, int v) {
      return f.At(double(a + u) / kCells, double(b + v) / kCells);
    };
    if (!f.rectangle && a + b > kCells - 1) continue;
    const double share = count / total;
    expected[2 * i] = share * TriangleAngle(corner(0, 0), corner(1, 0), corner(0, 1));
    if (!f.rectangle && a + b == kCells - 1) continue;
    expected[2 * i + 1] = share * TriangleAngle(corner(1, 1), corner(0, 1), corner(1, 0));
  }
  return stat::ChiSquareTest(observed, expected).p;
}

}  // namespace

TEST_CASE("the density of samples by solid angle is one over it", "[lights]") {
  for (const std::string& target : AvailableTargets()) {
    ForceTarget(target);
    for (const Flat& exact : Lights()) {
      const Flat f = Rounded(exact);
      CAPTURE(target, f.name, f.rectangle, AngleOf(f));
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
  ForceTarget("");
}

TEST_CASE("samples by solid angle are uniform over it", "[lights]") {
  constexpr std::uint32_t kCount = 1 << 15;
  const std::vector<std::string> targets = AvailableTargets();
  const std::vector<Flat> lights = Lights();
  // False alarms: 1e-6 for all together.
  const double level = stat::SidakLevel(1e-6, int(targets.size() * lights.size()));
  for (const std::string& target : targets) {
    ForceTarget(target);
    for (const Flat& exact : lights) {
      const Flat f = Rounded(exact);
      CAPTURE(target, f.name, f.rectangle);
      CHECK(PValue(Draw(f, kCount), kCount) > level);
      for (std::uint32_t i = 0; i < 4; ++i) CHECK(std::isfinite(Draw(f, 4).Where(i).x));
    }
  }
  ForceTarget("");
}

TEST_CASE("light that rays hit knows the density of samples", "[lights]") {
  constexpr std::uint32_t kCount = 67;
  std::vector<Flat> lights = Lights();
  // By area, whose density varies by a tenth over it.
  for (const bool rectangle : {true, false}) {
    lights.push_back(
        {"too small, flat", {1, 0, 0.01}, {1e-3, 0, 0}, {0, 1e-3, 0}, rectangle});
  }
  for (const std::string& target : AvailableTargets()) {
    ForceTarget(target);
    for (const Flat& exact : lights) {
      const Flat f = Rounded(exact);
      CAPTURE(target, f.name, f.rectangle);
      Draw draw(f, kCount);
      HitSamples(draw, kCount);
      const double cosine = std::abs(Dot(f.Normal(), Normalize(f.corner)));
      // As dense as the ray: half of the radiance. By area, the ray has missed the light
      // by the clearance of the shadow ray.
      const double tolerance =
          AngleOf(f) > kLeast ? 4e-6 * (1 + 1 / cosine) : 1e-4 * (1 + 0.1 / cosine);
      for (std::uint32_t i = 0; i < kCount; ++i) {
        CHECK(draw.fixture.wave.path.l_r[i] == Approx(1).epsilon(tolerance));
      }
    }
  }
  ForceTarget("");
}

TEST_CASE("samples by area are not uniform over the solid angle", "[lights]") {
  constexpr std::uint32_t kCount = 1 << 15;
  for (const Flat& f : Lights()) {
    if (std::string(f.name) != "aside") continue;
    CHECK(PValue(Draw(f, kCount, {}), kCount) < 1e-9);
  }
}

TEST_CASE("samples lie on the light", "[lights]") {
  for (const Flat& exact : Lights()) {
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
        const double away = height < 1 ? 1 : 0, omega = part * kLeast;
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

TEST_CASE("no bad numbers in the plane and at the corners of a light", "[lights]") {
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

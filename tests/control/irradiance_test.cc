// Closed-form irradiance of area lights against quadrature in double, on every SIMD
// target: lights from 1e-6 of their distance to twice it, receivers that face them, see
// them at a grazing angle, or have them cut by their horizon.
#include <catch2/catch.hpp>

#include "tests/support/test_target.h"
#include "tests/control/quadrature.h"
#include "tests/control/receivers.h"
#include "tests/support/wave_fixture.h"

namespace lanelight {
namespace {

// Relative to the irradiance of a receiver that faces the light.
constexpr double kTolerance = 5e-7;

CompiledScene SceneOfOneLight(Geometry geometry, LightShape shape, bool two_sided) {
  CompiledScene scene = MakeScene(std::move(geometry));
  LightRecord light = {};
  light.shape = static_cast<std::uint32_t>(shape);
  light.two_sided = two_sided ? 1 : 0;
  for (float& r : light.radiance) r = 1;
  if (shape == LightShape::kSphere) {
    light.size[0] = ConeFrom(scene.geometry.spheres[0].radius);
  }
  scene.lights.lights.push_back(light);
  return scene;
}

struct Outcome {
  int compared = 0, cut = 0;
  double worst = 0;
};

// `exact(p, n)` is the reference, `facing(p)` the scale.
template <class Exact, class Scale>
void Compare(Receivers& r, const CompiledScene& scene, Exact&& exact, Scale&& scale,
             Outcome& out) {
  r.Probe(scene);
  for (std::size_t i = 0; i < r.size(); ++i) {
    if (r.takes_part[i] == 0) {
      CHECK(r.above[0][i] == 0);
      CHECK(r.below[0][i] == 0);
      continue;
    }
    const Vec3d p = Receivers::At(r.p, i), n = Receivers::At(r.n, i);
    const double above = exact(p, n), below = exact(p, -n), unit = scale(p);
    const double error = std::max(std::abs(above - double(r.above[1][i])),
                                  std::abs(below - double(r.below[1][i]))) /
                         unit;
    if (error > kTolerance) {
      FAIL_CHECK("error " << error << ": " << above << " " << r.above[1][i] << ", "
                          << below << " " << r.below[1][i] << " of " << unit);
    }
    out.worst = std::max(out.worst, error);
    ++out.compared;
    if (above > 1e-3 * unit && below > 1e-3 * unit) ++out.cut;
  }
}

void ForEachTarget(const std::function<void()>& body) {
  for (const std::string& target : AvailableTargets()) {
    ForceTarget(target);
    INFO(target);
    body();
  }
  ForceTarget("");
}

void TestTriangles() {
  Random random(11);
  Outcome out;
  for (int light = 0; light < 60; ++light) {
    // Near the origin, so that tiny ones do not dissolve in the spacing of floats.
    const double size = std::pow(10, light < 30 ? random.U(-6, -1) : random.U(-1, 0.3));
    Geometry g;
    Vec3f c[3];
    for (Vec3f& corner : c) corner = VecCast<float>(random.Direction() * size);
    g.triangles.push_back(MakeTriangle(c[0], c[1], c[2]));
    const CompiledScene scene =
        SceneOfOneLight(std::move(g), LightShape::kTriangle, light % 2 == 1);
    Receivers r;
    for (int i = 0; i < 16; ++i) {
      const double distance = 1.2 * size + random.U(0.5, 2);
      const Vec3d at = random.Direction() * distance;
      r.Add(at, random.Normal(Normalize(-at), size / distance));
    }
    const auto exact = [&](Vec3d p, Vec3d n) {
      const Vec3d q[3] = {VecCast<double>(c[0]) - p, VecCast<double>(c[1]) - p,
                          VecCast<double>(c[2]) - p};
      return quadrature::Triangle(q, n);
    };
    Compare(r, scene, exact, [&](Vec3d p) { return exact(p, Normalize(-p)); }, out);
  }
  INFO("worst error " << out.worst);
  CHECK(out.compared > 400);
  CHECK(out.cut > 25);
}

// As rays see them: two triangles, which here differ, so that none stands for the other.
void TestRectangles() {
  Random random(17);
  Outcome out;
  for (int light = 0; light < 20; ++light) {
    const double size = std::pow(10, random.U(-3, 0.3));
    Vec3f c[4];
    for (Vec3f& corner : c) corner = VecCast<float>(random.Direction() * size);
    const Vec3d n =
        Normalize(Cross(VecCast<double>(c[1] - c[0]), VecCast<double>(c[2] - c[0])));
    // The other triangle in the same plane and on the same side of the diagonal.
    c[3] = c[1] + (c[2] - c[0]) * 0.75f;
    Geometry g;
    g.triangles = {MakeTriangle({9, 9, 9}, {9, 8, 9}, {9, 9, 8}),
                   MakeTriangle(c[0], c[1], c[2]), MakeTriangle(c[3], c[2], c[1])};
    CompiledScene scene = SceneOfOneLight(std::move(g), LightShape::kRectangle, true);
    scene.lights.lights[0].primitive = 1, scene.lights.lights[0].second_primitive = 2;
    Receivers r;
    for (int i = 0; i < 16; ++i) {
      const double distance = 2.5 * size + random.U(0.5, 2);
      const Vec3d at = Normalize(random.Direction() + n * 0.5) * distance;
      r.Add(at, random.Normal(Normalize(-at), size / distance));
    }
    const auto exact = [&](Vec3d p, Vec3d normal) {
      double sum = 0;
      for (const int half : {0, 1}) {
        const int at[2][3] = {{0, 1, 2}, {3, 2, 1}};
        Vec3d q[3];
        for (int k = 0; k < 3; ++k) q[k] = VecCast<double>(c[at[half][k]]) - p;
        sum += quadrature::Triangle(q, normal);
      }
      return sum;
    };
    Compare(r, scene, exact, [&](Vec3d p) { return exact(p, Normalize(-p)); }, out);
  }
  INFO("worst error " << out.worst);
  CHECK(out.compared > 150);
}

void TestSpheres() {
  Random random(12);
  Outcome out;
  for (int light = 0; light < 40; ++light) {
    const double size = std::pow(10, light < 20 ? random.U(-6, -1) : random.U(-1, 0.3));
    const auto radius = static_cast<float>(size);
    Geometry g;
    g.spheres.push_back(MakeSphere({0, 0, 0}, radius));
    const CompiledScene scene = SceneOfOneLight(std::move(g), LightShape::kSphere, false);
    Receivers r;
    for (int i = 0; i < 16; ++i) {
      const double distance = 1.01 * size + std::pow(10, random.U(-1, 0.5));
      const Vec3d at = random.Direction() * distance;
      r.Add(at, random.Normal(Normalize(-at), size / distance));
    }
    const auto exact = [&](Vec3d p, Vec3d n) {
      return quadrature::Sphere(-p, double(radius), n);
    };
    Compare(r, scene, exact, [&](Vec3d p) { return exact(p, Normalize(-p)); }, out);
  }
  INFO("worst error " << out.worst);
  CHECK(out.compared > 600);
  CHECK(out.cut > 60);
}

void TestDisks() {
  Random random(13);
  Outcome out;
  for (int light = 0; light < 30; ++light) {
    const double size = std::pow(10, light < 15 ? random.U(-6, -1) : random.U(-1, 0));
    Geometry g;
    const Vec3d axis = random.Direction();
    g.disks.push_back(MakeDisk({0, 0, 0}, VecCast<float>(axis), static_cast<float>(size),
                               light % 3 == 0 ? static_cast<float>(size * 0.6) : 0.0f));
    const DiskRecord disk = g.disks[0];
    const CompiledScene scene =
        SceneOfOneLight(std::move(g), LightShape::kDisk, light % 2 == 1);
    Receivers r;
    for (int i = 0; i < 16; ++i) {
      const double distance = 0.5 * size + random.U(0.5, 2);
      const Vec3d at = random.Direction() * distance;
      r.Add(at, random.Normal(Normalize(-at), size / distance));
    }
    const Vec3d normal = {disk.normal[0], disk.normal[1], disk.normal[2]};
    const auto whole = [&](Vec3d p, Vec3d n) {
      return quadrature::Disk(-p, normal, double(disk.inner_radius), double(disk.radius),
                              n);
    };
    const auto exact = [&](Vec3d p, Vec3d n) {
      return Dot(n, -p) > 0 ? whole(p, n) : 0.0;
    };
    Compare(r, scene, exact, [&](Vec3d p) { return whole(p, Normalize(-p)); }, out);
  }
  INFO("worst error " << out.worst);
  CHECK(out.compared > 150);
  CHECK(out.cut == 0);
}

}  // namespace

TEST_CASE("irradiance of triangles, clipped at the horizon", "[control]") {
  ForEachTarget(TestTriangles);
}

TEST_CASE("irradiance of rectangles of two triangles", "[control]") {
  ForEachTarget(TestRectangles);
}

TEST_CASE("irradiance of spheres, clipped at the horizon", "[control]") {
  ForEachTarget(TestSpheres);
}

TEST_CASE("irradiance of disks and rings above the horizon", "[control]") {
  ForEachTarget(TestDisks);
}

TEST_CASE("lights take part only where they emit and the formula holds", "[control]") {
  Geometry g;
  g.disks.push_back(MakeDisk({0, 0, 1}, {0, 0, -1}, 1));
  const CompiledScene disk = SceneOfOneLight(std::move(g), LightShape::kDisk, false);
  Receivers r;
  r.Add({0, 0, 0}, {0, 0, 1});    // in front, whole
  r.Add({0, 0, 0}, {0, 0, -1});   // in front, below the horizon: takes part with 0
  r.Add({0, 0, 0}, {1, 0, 0});    // the rim crosses the horizon
  r.Add({0, 0, 2}, {0, 0, -1});   // behind
  r.Add({0.2, 0, 1}, {0, 0, 1});  // in the plane
  r.Probe(disk);
  CHECK(std::vector<float>(r.takes_part.begin(), r.takes_part.begin() + 5) ==
        std::vector<float>{1, 1, 0, 0, 0});
  // Facing disk of radius 1 at distance 1: pi r^2 / (r^2 + h^2).
  CHECK(double(r.above[0][0]) == Approx(std::numbers::pi / 2));
  CHECK(r.above[0][1] == 0);
  CHECK(double(r.below[0][1]) == Approx(std::numbers::pi / 2));
  Geometry s;
  s.spheres.push_back(MakeSphere({0, 0, 0}, 1));
  const CompiledScene sphere = SceneOfOneLight(std::move(s), LightShape::kSphere, false);
  Receivers inside;
  inside.Add({0.5, 0, 0}, {1, 0, 0});
  inside.Add({0, 0, 1}, {0, 0, 1});
  inside.Add({0, 0, 2}, {0, 0, -1});
  inside.Probe(sphere);
  CHECK(std::vector<float>(inside.takes_part.begin(), inside.takes_part.begin() + 3) ==
        std::vector<float>{0, 0, 1});
  CHECK(double(inside.above[0][2]) == Approx(std::numbers::pi / 4));
}

}  // namespace lanelight

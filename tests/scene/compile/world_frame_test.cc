// The frame that a scene is moved and scaled into.
#include <catch2/catch.hpp>

#include <cmath>

#include "tests/scene/compile/bent_strip.h"

namespace lanelight {
namespace {

TEST_CASE("compile: frame", "[scene][compile]") {
  SceneDescription d = SquareScene();
  d.shapes[0].world_from_object =
      Transform::Translate({100, 200, 300}) * Transform::Scale({10, 10, 10});
  d.camera.world_from_camera = Transform::Translate({1e6, 0, 0});  // does not count
  const CompiledScene scene = CompileScene(d);
  CHECK(scene.center == Vec3d{100, 200, 300});
  // Half diagonal 10 sqrt 2 = 14.14 -> 1.77.
  CHECK(scene.scale == 0.125);
  CHECK(Vertex(scene.geometry.triangles[0], 0) == Vec3d{-1.25, -1.25, 0});
  CHECK(scene.geometry.bounds_min.x == Approx(-1.25));
  CHECK(scene.geometry.bounds_min.x < -1.25f);
  CHECK(scene.geometry.bounds_max.y > 1.25f);
}

TEST_CASE("compile: a scene of planes alone is framed by the camera",
          "[scene][compile]") {
  SceneDescription d = SquareScene();
  d.shapes = {PlaneShape(0)};
  d.shapes[0].world_from_object = Transform::Translate({0, 0, -6});
  d.camera.world_from_camera = Transform::Translate({50, 0, 0});
  const CompiledScene scene = CompileScene(d);
  CHECK(scene.center == Vec3d{50, 0, -3});  // between the camera and its foot
  CHECK(scene.scale == 0.5);                // half diagonal 3 -> 1.5
  CHECK(scene.geometry.planes[0].point[2] == Approx(-1.5));
}

// All floats of a scene that depend on positions.
std::vector<float> Coordinates(const CompiledScene& scene) {
  std::vector<float> out;
  for (const TriangleRecord& t : scene.geometry.triangles) {
    for (const auto& p : t.p) out.insert(out.end(), p, p + 3);
  }
  for (const SphereRecord& s : scene.geometry.spheres) {
    out.insert(out.end(), s.center, s.center + 3);
    out.push_back(s.radius);
  }
  for (const InstanceRecord& i : scene.geometry.instances) {
    out.insert(out.end(), i.scene_from_object, i.scene_from_object + 12);
  }
  for (const LightRecord& l : scene.lights.lights) {
    out.insert(out.end(), l.position, l.position + 3);
    out.push_back(l.area);
  }
  for (int i = 0; i < 3; ++i) out.push_back(scene.view.camera.origin[i]);
  return out;
}

TEST_CASE("compile: scaling by powers of two and offsets do not change the image",
          "[scene][compile]") {
  const std::vector<float> expected = Coordinates(CompileScene(Varied(Transform())));
  for (int exponent : {-100, -30, 30, 100}) {
    const double s = std::ldexp(1.0, exponent);
    const auto got = Coordinates(CompileScene(Varied(Transform::Scale({s, s, s}))));
    CHECK(got == expected);
  }
  // Far away the positions in the file are rounded, to 1e-9 of the size here.
  for (double offset : {1e3, 1e7}) {
    const auto got = Coordinates(
        CompileScene(Varied(Transform::Translate({offset, -2 * offset, offset}))));
    REQUIRE(got.size() == expected.size());
    for (std::size_t i = 0; i < got.size(); ++i) {
      CHECK(std::abs(got[i] - expected[i]) <= 2.4e-7 * (1 + std::abs(expected[i])));
    }
  }
}

TEST_CASE("compile: any scale from 1e-9 to 1e9", "[scene][compile]") {
  const CompiledScene unit = CompileScene(Varied(Transform()));
  const std::vector<float> expected = Coordinates(unit);
  for (double s : {1e-9, 1e-3, 1e9}) {
    const CompiledScene scene = CompileScene(Varied(Transform::Scale({s, s, s})));
    const double ratio = s * scene.scale / unit.scale;  // in (1/2, 2)
    CHECK(ratio > 0.5);
    CHECK(ratio < 2);
    const TriangleRecord& a = unit.geometry.triangles[1];
    const TriangleRecord& b = scene.geometry.triangles[1];
    for (int k = 0; k < 3; ++k) {
      CHECK(Length(Vertex(a, k) * ratio - Vertex(b, k)) < 3e-7);
    }
    // The point light's irradiance on the scene does not depend on units, if its
    // intensity is given in the same ones: scale^2.
    CHECK(scene.lights.lights[1].radiance[0] / unit.lights.lights[1].radiance[0] ==
          Approx(ratio * ratio / s / s));
  }
}

TEST_CASE("compile: a tiny mesh placed far away keeps its shape", "[scene][compile]") {
  // The vertices are exact in their own coordinates; the translation is huge. Rounding in
  // world coordinates would leave 1e-9 / 1e-4 = 1e-5 of relative error.
  SceneDescription d = SquareScene();
  const double size = 1e-4 / 3;
  d.shapes[0].world_from_object = Transform::Translate({1e7 / 3, -1e7 / 7, 1e7}) *
                                  Transform::Scale({size, size, size});
  const CompiledScene scene = CompileScene(d);
  const TriangleRecord& t = scene.geometry.triangles[0];
  const Vec3d edge = Vertex(t, 1) - Vertex(t, 0);
  CHECK(edge.x == Approx(2 * size * scene.scale).epsilon(3e-7));
}

}  // namespace
}  // namespace lanelight

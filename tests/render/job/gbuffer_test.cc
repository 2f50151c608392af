// --gbuffer against what a plane is known to show: points on it, its normals and
// coordinates, how its depth changes from pixel to pixel.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "src/base/core/transform.h"
#include "tests/render/run/render_fixture.h"

namespace lanelight {
namespace {

constexpr int kWidth = 24, kHeight = 18;
enum Plane { kHit, kP, kN = 4, kNs = 7, kU = 10, kV, kDzDx, kDzDy };

// Returns a scene with a tilted rectangle in the left half of the picture, for a camera
// of half units that moves to the right by `move`. Its u and v are a third of x and a
// half of y, its shading normals (0, 0.6, -0.8).
std::string Scene(const char* space, double far, double move = 0) {
  return fmt::format(R"(
    Scale 2 2 2
    LookAt {0} 1 -4  {0} 0.5 0  0 1 0
    ActiveTransform EndTime Translate {5} 0 0 ActiveTransform All
    Camera "perspective" "float fov" 40
    PixelFilter "box"
    Film "gbuffer" "string coordinatesystem" "{1}" "integer xresolution" {2}
      "integer yresolution" {3}
    WorldBegin
    LightSource "point" "point3 from" [ {0} 3 -3 ]
    Translate {4} 0 0
    Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ]
      "point3 P" [ -9 -9 0.5  0 -9 0.5  0 9 9.5  -9 9 9.5 ]
      "point2 uv" [ -3 -4.5  0 -4.5  0 4.5  -3 4.5 ]
      "normal N" [ 0 0.6 -0.8  0 0.6 -0.8  0 0.6 -0.8  0 0.6 -0.8 ])",
                     far + 0.3, space, kWidth, kHeight, far, -move);
}

struct Buffer {
  FilmAccumulator film;
  double At(int x, int y, int plane) const { return film.Gbuffer(x, y, plane); }
  Vec3d Vector(int x, int y, int plane) const {
    return {At(x, y, plane), At(x, y, plane + 1), At(x, y, plane + 2)};
  }
};

Buffer RenderBuffer(const char* space, double far = 0, std::uint64_t spp = 64,
                    double move = 0) {
  TestRender t;
  t.spp = spp;
  t.sampler = SampleSequence::kSobol;
  t.auxiliary = Auxiliary::kGbuffer;
  return {RenderText(Scene(space, far, move), t).film};
}

void CheckVector(Vec3d v, Vec3d wanted, double margin) {
  CAPTURE(v.x, v.y, v.z, wanted.x, wanted.y, wanted.z);
  CHECK(Length(v - wanted) < margin);
}

// Pixels whose samples, and whose neighbours' to the right and below, all hit.
template <class F>
void ForEachInside(const Buffer& b, F&& check) {
  int count = 0;
  for (int y = 0; y + 1 < kHeight; ++y) {
    for (int x = 0; x + 1 < kWidth; ++x) {
      if (b.At(x, y, kHit) < 1 || b.At(x + 1, y, kHit) < 1 || b.At(x, y + 1, kHit) < 1) {
        continue;
      }
      INFO("pixel " << x << ", " << y);
      check(x, y);
      ++count;
    }
  }
  CHECK(count > kWidth * kHeight / 4);
}

}  // namespace

TEST_CASE("gbuffer: points, normals and coordinates of a plane, in the world",
          "[render]") {
  for (const double far : {0.0, 1e4}) {
    const Buffer b = RenderBuffer("world", far);
    const double digits = 1e-5 + 2e-7 * far;
    CAPTURE(far);
    ForEachInside(b, [&](int x, int y) {
      const Vec3d p = b.Vector(x, y, kP);
      // Up to the tilt: z = 5 + y / 2.
      CHECK(p.z - 5 - p.y / 2 == Approx(0).margin(digits));
      CHECK(b.At(x, y, kU) == Approx((p.x - far) / 3).margin(digits));
      CHECK(b.At(x, y, kV) == Approx(p.y / 2).margin(digits));
      CheckVector(b.Vector(x, y, kN), Vec3d{0, 1, -2} / std::sqrt(5.0), 1e-5);
      CheckVector(b.Vector(x, y, kNs), {0, 0.6, -0.8}, 1e-5);
    });
  }
}

TEST_CASE("gbuffer: camera space is the transformed world space", "[render]") {
  const Buffer world = RenderBuffer("world"), camera = RenderBuffer("camera");
  const SceneDescription scene = ParseSceneText(Scene("camera", 0), "test.pbrt", ".");
  const Transform to_camera = scene.camera.world_from_camera.Inverse();
  ForEachInside(world, [&](int x, int y) {
    CHECK(camera.At(x, y, kHit) == 1);
    CheckVector(camera.Vector(x, y, kP), to_camera.Point(world.Vector(x, y, kP)), 1e-4);
    for (const int normal : {kN, kNs}) {
      CheckVector(camera.Vector(x, y, normal),
                  Normalize(to_camera.Vector(world.Vector(x, y, normal))), 1e-5);
    }
    CHECK(camera.At(x, y, kU) == world.At(x, y, kU));
  });
}

TEST_CASE("gbuffer: a camera that moves along a plane sees the same of it",
          "[render][motion]") {
  const double move = 0.4;
  const Buffer still = RenderBuffer("camera", 0, 1024),
               camera = RenderBuffer("camera", 0, 1024, move),
               world = RenderBuffer("world", 0, 1024, move);
  ForEachInside(camera, [&](int x, int y) {
    if (still.At(x, y, kHit) < 1) return;
    CheckVector(camera.Vector(x, y, kP), still.Vector(x, y, kP), 2e-3);
    for (const int normal : {kN, kNs}) {
      CheckVector(camera.Vector(x, y, normal), still.Vector(x, y, normal), 1e-5);
    }
    for (const int slope : {kDzDx, kDzDy}) {
      CHECK(camera.At(x, y, slope) == Approx(still.At(x, y, slope)).margin(2e-3));
    }
    const Vec3d p = world.Vector(x, y, kP);
    CHECK(p.z - 5 - p.y / 2 == Approx(0).margin(1e-5));
    CHECK(world.At(x, y, kU) == Approx(p.x / 3).margin(1e-5));
    CHECK(world.At(x, y, kU) - still.At(x, y, kU) == Approx(move / 2 / 3).margin(2e-3));
    CheckVector(world.Vector(x, y, kN), Vec3d{0, 1, -2} / std::sqrt(5.0), 1e-5);
  });
}

TEST_CASE("gbuffer: slopes lead from pixel to pixel", "[render]") {
  for (const char* space : {"world", "camera"}) {
    CAPTURE(space);
    const Buffer b = RenderBuffer(space, 0, 1024);
    ForEachInside(b, [&](int x, int y) {
      const double z = b.At(x, y, kP + 2);
      const double right = b.At(x + 1, y, kP + 2) - z;
      const double below = b.At(x, y + 1, kP + 2) - z;
      // Trapezoids: what is left is the third derivative, and the samples' noise.
      CHECK((b.At(x, y, kDzDx) + b.At(x + 1, y, kDzDx)) / 2 ==
            Approx(right).epsilon(0.01).margin(0.002));
      CHECK((b.At(x, y, kDzDy) + b.At(x, y + 1, kDzDy)) / 2 ==
            Approx(below).epsilon(0.01).margin(0.002));
      CHECK(std::abs(below) > 0.05);
    });
  }
}

TEST_CASE("gbuffer: pixels without hits are zero, edges are means of hits", "[render]") {
  const Buffer b = RenderBuffer("world");
  int edges = 0;
  for (int y = 0; y < kHeight; ++y) {
    CHECK(b.At(kWidth - 1, y, kHit) == 0);
    CHECK(b.At(kWidth - 1, y, kP + 2) == 0);
    for (int x = 0; x < kWidth; ++x) {
      const double fraction = b.At(x, y, kHit);
      if (fraction == 0 || fraction == 1) continue;
      ++edges;
      CheckVector(b.Vector(x, y, kNs), {0, 0.6, -0.8}, 1e-5);
    }
  }
  CHECK(edges > 5);
}

}  // namespace lanelight

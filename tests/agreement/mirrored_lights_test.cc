// Which side of a round light shines: pbrt-v4 turns the normal of a ray's hit round where
// ReverseOrientation differs from the handedness of the shape's own transform. (Its light
// samples on spheres regard ReverseOrientation alone, so that there a mirrored light is
// seen from inside and lights what is outside. Here both go by what is seen.)
#include <catch2/catch.hpp>

#include "tests/agreement/agreement.h"

namespace lanelight::test {
namespace {

// A round shell about the origin that emits on one side, with floors in and below it: a
// sphere is rendered as such or, cut open, as triangles.
SceneDescription Shell(bool mirrored, bool reversed, bool cut, Vec3d eye) {
  SceneBuilder b(6, 6);
  b.Depth(2).Perspective(eye, {0, 0.01, -0.3}, {0, 0, 1}, 40);
  Shape& shell = b.AddSphere({}, 1, b.AddDiffuse(Grey(0.3)), b.AddEmission({2, 1, 0.5}));
  shell.reverse_orientation = reversed;
  shell.world_from_object =
      Transform::Rotate(20, {1, 2, 0}) * Transform::Scale({1, mirrored ? -1.0 : 1.0, 1});
  if (cut) shell.z_max = 0.6;
  const Index floor = b.AddDiffuse(Grey(0.5));
  b.AddDisk({0, 0, -0.4}, {0, 0, 1}, 0.3, floor);  // inside
  b.AddPlane({0, 0, -1.2}, {0, 0, 1}, floor);      // outside
  return b.Build();
}

constexpr Vec3d kOutside = {0, -6, 3}, kInside = {0, -0.6, 0.3};

}  // namespace

TEST_CASE("mirrored lights emit on the same side as in pbrt", "[lights][agreement]") {
  for (const bool mirrored : {false, true}) {
    for (const bool reversed : {false, true}) {
      for (const bool cut : {false, true}) {
        const bool outward = mirrored == reversed;
        INFO("mirrored " << mirrored << ", reversed " << reversed << ", cut " << cut);
        if (!cut) {
          const SceneDescription unlit =
              Shell(mirrored, reversed, cut, outward ? kInside : kOutside);
          for (const Rgb& pixel : RenderWavefront(unlit, 4).mean) CHECK(pixel == Rgb{});
        }
        const SceneDescription lit =
            Shell(mirrored, reversed, cut, outward ? kOutside : kInside);
        stat::CheckSame(CompareWithReference(lit, 1024, 1024, cut ? 2e-3 : 1e-4), 0.2);
      }
    }
  }
}

}  // namespace lanelight::test

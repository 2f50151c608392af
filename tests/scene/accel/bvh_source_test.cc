// Trees that are taken from the scene that was compiled before.
#include "src/scene/accel/build.h"

#include <catch2/catch.hpp>
#include <cstring>

#include "tests/support/brute_force.h"

namespace lanelight {

TEST_CASE("a cached BVH is reused only for the same shapes", "[accel][tree-source]") {
  brute::Random random(65);
  Geometry shapes = MakeScene(brute::Soup(random, 3000, 1, 0.1f)).geometry;
  const ReusedBvh built = FindBvh(shapes, {}, nullptr);
  CHECK_FALSE(built.report.shared);
  CHECK(built.report.bytes >
        built.accel.nodes.size() * sizeof(WideNode) +
            built.accel.triangle_blocks.size() * sizeof(TriangleBlock));
  const CachedBvh known = {KeyOf(shapes, {}), built.accel};
  const ReusedBvh shared = FindBvh(shapes, {}, &known);
  CHECK(shared.report.shared);
  CHECK(shared.report.bytes == built.report.bytes);
  CHECK(shared.accel.nodes.data() == built.accel.nodes.data());
  CHECK_FALSE(FindBvh(shapes, {.quality = BuildQuality::kFast}, &known).report.shared);
  shapes.triangles[1000].p[0][0] += 1;
  const ReusedBvh moved = FindBvh(shapes, {}, &known);
  CHECK_FALSE(moved.report.shared);
  CHECK(moved.accel.nodes.data() != built.accel.nodes.data());
}

}  // namespace lanelight

#include "src/scene/compile/shape_records.h"

#include <catch2/catch.hpp>

#include "tests/scene/compile/testing.h"

namespace lanelight {
namespace {

PlacedShape Placed(const Shape& shape) {
  PlacedShape placed;
  placed.shape = &shape;
  placed.transform = shape.world_from_object;
  placed.flip = shape.reverse_orientation != shape.world_from_object.SwapsHandedness();
  return placed;
}

const WorldFrame kFrame{{1, 2, 3}, 0.5};

TEST_CASE("compile: sphere record", "[scene][compile]") {
  Shape shape = SphereShape(3, 0);
  shape.world_from_object = Transform::Translate({1, 4, 3}) *
                            Transform::Rotate(90, {0, 0, 1}) *
                            Transform::Scale({2, 2, 2});
  const SphereRecord r = CompileSphere(Placed(shape), kFrame, 7);
  CHECK(ToVec(r.center) == Vec3d{0, 1, 0});
  CHECK(r.radius == Approx(3));  // 3 * 2 / 2
  CHECK(r.material == 7);
  CHECK(r.light == -1);
  CHECK(r.flags == 0);
  CHECK(r.normal_sign == 1);
  CHECK(Length(ToVec(r.x_axis) - Vec3d{0, 1, 0}) < 1e-7);
  CHECK(Length(ToVec(r.z_axis) - Vec3d{0, 0, 1}) < 1e-7);
  CHECK(r.y_sign == 1);
}

TEST_CASE("compile: sphere axes under mirroring", "[scene][compile]") {
  for (bool mirror : {false, true}) {
    for (bool reverse : {false, true}) {
      Shape shape = SphereShape(1, 0);
      shape.reverse_orientation = reverse;
      shape.world_from_object = Transform::Rotate(50, {1, 1, 0}) *
                                Transform::Scale({1, mirror ? -1.0 : 1.0, 1});
      const SphereRecord r = CompileSphere(Placed(shape), kFrame, 0);
      // pbrt decides in object space: mirrored spheres face inward.
      CHECK(r.normal_sign == (mirror != reverse ? -1 : 1));
      const Vec3d y = Cross(ToVec(r.z_axis), ToVec(r.x_axis)) * double(r.y_sign);
      CHECK(Length(y - shape.world_from_object.Vector({0, 1, 0})) < 1e-6);
    }
  }
}

TEST_CASE("compile: disk record", "[scene][compile]") {
  for (bool mirror : {false, true}) {
    for (bool reverse : {false, true}) {
      Shape shape = DiskShape(4, 0);
      shape.inner_radius = 2;
      shape.height = 1;
      shape.reverse_orientation = reverse;
      // Scaling along the axis alone is fine: z is not measured.
      shape.world_from_object = Transform::Translate({1, 2, 3}) *
                                Transform::Rotate(90, {1, 0, 0}) *
                                Transform::Scale({mirror ? -1.0 : 1.0, 1, 5});
      const DiskRecord r = CompileDisk(Placed(shape), kFrame, 3);
      CHECK(Length(ToVec(r.center) - Vec3d{0, -2.5, 0}) < 1e-6);  // z up becomes -y
      CHECK(r.radius == 2);
      CHECK(r.inner_radius == 1);
      const double sign = mirror != reverse ? -1 : 1;
      CHECK(Length(ToVec(r.normal) - Vec3d{0, -sign, 0}) < 1e-6);
      const Vec3d v = Cross(ToVec(r.normal), ToVec(r.u_axis)) * double(r.v_sign);
      CHECK(Length(v - Vec3d{0, 0, 1}) < 1e-6);  // object y
      CHECK(r.u_axis[0] == (mirror ? -1 : 1));
    }
  }
}

TEST_CASE("compile: plane record", "[scene][compile]") {
  Shape shape = PlaneShape(0);
  shape.world_from_object =
      Transform::Translate({5, 6, 7}) * Transform::Rotate(30, {1, 2, 3}) *
      Transform({{{2, 1, 0, 0}, {0, 3, 0, 0}, {0.5, 0, 1, 0}, {0, 0, 0, 1}}});
  const PlaneRecord r = CompilePlane(Placed(shape), kFrame, 1, true);
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {-2.0, 3.5}}) {
    const Vec3d p =
        kFrame.Point(shape.world_from_object.Point({x, y, 0})) - ToVec(r.point);
    CHECK(Dot(p, ToVec(r.u_axis)) == Approx(x).margin(1e-5));
    CHECK(Dot(p, ToVec(r.v_axis)) == Approx(y).margin(1e-5));
    CHECK(Dot(p, ToVec(r.normal)) == Approx(0).margin(1e-5));
  }
  const Vec3d above = shape.world_from_object.Vector({0, 0, 1});
  CHECK(Dot(ToVec(r.normal), above) > 0);
  shape.reverse_orientation = true;
  const PlaneRecord reversed = CompilePlane(Placed(shape), kFrame, 1, false);
  CHECK(Dot(ToVec(reversed.normal), above) < 0);
  // Without uv the reference point is the one nearest to the centre of the scene.
  const Vec3d n = ToVec(reversed.normal), q = ToVec(reversed.point);
  CHECK(Length(Cross(n, q)) < 1e-6);
  CHECK(Dot(q - ToVec(r.point), n) == Approx(0).margin(1e-6));
}

TEST_CASE("compile: shapes that quadrics cannot represent", "[scene][compile]") {
  SceneDescription d = SquareScene();
  d.shapes[0] = DiskShape(1, 0);
  d.shapes[0].inner_radius = 1;
  CHECK(CompileError(d).find("inner radius 1") != std::string::npos);
  d.shapes[0] = SphereShape(-1, 0);
  CHECK(CompileError(d).find("radius -1") != std::string::npos);
}

}  // namespace
}  // namespace lanelight

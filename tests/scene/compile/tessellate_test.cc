// Triangles in place of round shapes: where they are, their normals and coordinates.
#include "src/scene/compile/tessellate.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "src/base/core/pi.h"
#include "tests/scene/compile/testing.h"

namespace lanelight {
namespace {

Shape Cylinder(double radius, double z_min, double z_max, double phi_max) {
  Shape shape = SphereShape(radius, 0);
  shape.kind = ShapeKind::kCylinder;
  shape.z_min = z_min;
  shape.z_max = z_max;
  shape.phi_max = phi_max;
  return shape;
}

Shape PartOfSphere(double radius, double z_min, double z_max, double phi_max) {
  Shape shape = Cylinder(radius, z_min, z_max, phi_max);
  shape.kind = ShapeKind::kSphere;
  return shape;
}

Shape PartOfDisk(double radius, double inner, double height, double phi_max) {
  Shape shape = DiskShape(radius, 0);
  shape.inner_radius = inner;
  shape.height = height;
  shape.phi_max = phi_max;
  return shape;
}

struct Place {
  Vec3d p, n;
  double u, v;
};

// The point of triangle t with these weights of its corners, everything interpolated.
Place At(const TriangleMesh& mesh, std::size_t t, std::array<double, 3> weights) {
  Place at{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t i = mesh.indices[3 * t + k];
    at.p += mesh.positions[i] * weights[k];
    at.n += mesh.normals[i] * weights[k];
    at.u += mesh.uvs[i][0] * weights[k];
    at.v += mesh.uvs[i][1] * weights[k];
  }
  return at;
}

// pbrt-v4's surface coordinates of a point, and the outward normal.
Place Exact(const Shape& shape, Vec3d p) {
  double phi = std::atan2(p.y, p.x);
  if (phi < 0) phi += 2 * kPi;
  Place at{p, {0, 0, 1}, phi / (shape.phi_max * kPi / 180), 0};
  const double across = std::hypot(p.x, p.y);
  if (shape.kind == ShapeKind::kDisk) {
    at.v = (shape.radius - across) / (shape.radius - shape.inner_radius);
  } else if (shape.kind == ShapeKind::kCylinder) {
    at.n = {p.x / across, p.y / across, 0};
    at.v = (p.z - shape.z_min) / (shape.z_max - shape.z_min);
  } else {
    at.n = p / Length(p);
    const auto theta = [&](double z) {
      return std::acos(std::clamp(z / shape.radius, -1.0, 1.0));
    };
    const double low = theta(shape.z_min);
    at.v = (std::acos(at.n.z) - low) / (theta(shape.z_max) - low);
  }
  return at;
}

// How far outside of the surface the point is, in units of the radius.
double Outside(const Shape& shape, Vec3d p) {
  if (shape.kind == ShapeKind::kDisk) return 0;
  const double r = shape.kind == ShapeKind::kSphere ? Length(p) : std::hypot(p.x, p.y);
  return r / shape.radius - 1;
}

const std::vector<Shape>& RoundShapes() {
  static const std::vector<Shape> shapes = {
      Cylinder(2, -1, 3, 360),       Cylinder(0.5, 0, 90, 100),
      PartOfSphere(2, -2, 2, 250),   PartOfSphere(3, -1, 2.5, 360),
      PartOfSphere(1e-3, 0, 1, 360), PartOfDisk(2, 0.5, 1, 300),
      PartOfDisk(3, 0, -1, 120)};
  return shapes;
}

std::vector<std::pair<Shape, double>> RoundCases() {
  std::vector<std::pair<Shape, double>> cases;
  for (const Shape& shape : RoundShapes()) {
    for (const double tolerance : {1e-3, 4e-5}) cases.emplace_back(shape, tolerance);
  }
  return cases;
}

TEST_CASE("tessellation: within the stated tolerance, inside", "[compile]") {
  for (const auto& [shape, tolerance] : RoundCases()) {
    CAPTURE(static_cast<int>(shape.kind), shape.radius, shape.phi_max, tolerance);
    const TriangleMesh mesh = Tessellate(shape, tolerance);
    double minimum = 0, maximum = -1;
    for (std::size_t t = 0; t < mesh.indices.size() / 3; ++t) {
      for (const auto& w :
           {std::array<double, 3>{1. / 3, 1. / 3, 1. / 3},
            std::array<double, 3>{0.5, 0.5, 0}, std::array<double, 3>{0, 0.5, 0.5},
            std::array<double, 3>{0.5, 0, 0.5}}) {
        const double outside = Outside(shape, At(mesh, t, w).p);
        minimum = std::min(minimum, outside);
        maximum = std::max(maximum, outside);
      }
    }
    CHECK(maximum <= 1e-15);
    CHECK(minimum >= -tolerance);
    // And no finer than need be.
    if (shape.kind != ShapeKind::kDisk) CHECK(minimum <= -0.4 * tolerance);
  }
}

TEST_CASE("tessellation: normals and coordinates agree with pbrt", "[compile]") {
  for (const auto& [shape, tolerance] : RoundCases()) {
    CAPTURE(static_cast<int>(shape.kind), shape.radius, shape.phi_max, tolerance);
    const TriangleMesh mesh = Tessellate(shape, tolerance);
    double normal = 0, uv = 0;
    int wrong_side = 0;
    for (std::size_t t = 0; t < mesh.indices.size() / 3; ++t) {
      for (const auto& w :
           {std::array<double, 3>{0.6, 0.3, 0.1}, std::array<double, 3>{0.1, 0.1, 0.8}}) {
        const Place at = At(mesh, t, w);
        const Place exact = Exact(shape, at.p);
        normal = std::max(normal, Length(Normalize(at.n) - exact.n));
        uv = std::max({uv, std::abs(at.u - exact.u), std::abs(at.v - exact.v)});
      }
      for (int k = 0; k < 3; ++k) {  // the winding agrees with the normals
        const std::uint32_t* i = &mesh.indices[3 * t];
        const Vec3d face = Cross(mesh.positions[i[1]] - mesh.positions[i[0]],
                                 mesh.positions[i[2]] - mesh.positions[i[0]]);
        wrong_side += !(Dot(face, mesh.normals[i[k]]) > 0);
      }
    }
    CHECK(wrong_side == 0);
    CHECK(normal < 1e-12);
    CHECK(uv < 0.5 / 64);
  }
}

double AreaOf(const TriangleMesh& mesh) {
  double area = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Vec3d a = mesh.positions[mesh.indices[i]];
    area += Length(Cross(mesh.positions[mesh.indices[i + 1]] - a,
                         mesh.positions[mesh.indices[i + 2]] - a)) /
            2;
  }
  return area;
}

TEST_CASE("tessellation: areas add up, without gaps or overlaps", "[compile]") {
  const auto part = [](const Shape& s) { return s.phi_max / 360 * 2 * kPi; };
  for (const Shape& shape : RoundShapes()) {
    CAPTURE(static_cast<int>(shape.kind), shape.radius, shape.phi_max);
    const double r = shape.radius, inner = shape.inner_radius;
    const double z_max =
        shape.kind == ShapeKind::kSphere ? std::min(shape.z_max, r) : shape.z_max;
    const double exact = shape.kind == ShapeKind::kDisk
                             ? part(shape) / 2 * (r * r - inner * inner)
                             : part(shape) * r * (z_max - shape.z_min);
    CHECK(AreaOf(Tessellate(shape, 1e-4)) == Approx(exact).epsilon(3e-4));
  }
}

TEST_CASE("tessellation: a closed shape has no seam", "[compile]") {
  const TriangleMesh mesh = Tessellate(Cylinder(1, 0, 1, 360), 1e-4);
  std::size_t end = 0;
  while (mesh.uvs[end][0] < 1) ++end;
  CHECK(mesh.uvs[0][0] == 0);
  CHECK(mesh.uvs[end][0] == 1);
  CHECK(mesh.positions[0] == mesh.positions[end]);
}

TEST_CASE("tessellation: a mirror turns the normal, as in pbrt", "[compile]") {
  for (const bool mirrors : {false, true}) {
    for (const bool reverse : {false, true}) {
      CAPTURE(mirrors, reverse);
      SceneDescription d = SquareScene();
      d.shapes[0] = Cylinder(1, -1, 1, 360);
      d.shapes[0].reverse_orientation = reverse;
      d.shapes[0].world_from_object = Transform::Scale({mirrors ? -1.0 : 1.0, 1, 1});
      const CompiledScene scene = CompileScene(d);
      REQUIRE_FALSE(scene.geometry.triangles.empty());
      const TriangleRecord& t = scene.geometry.triangles[0];
      const bool outward =
          Dot(FaceNormal(t), Vertex(t, 0) / scene.scale + scene.center) > 0;
      CHECK(outward == (mirrors == reverse));
    }
  }
}

TEST_CASE("tessellation: only shapes without an exact form are tessellated",
          "[compile]") {
  const Transform plain = Transform::Scale({2, 2, 2}), bent = Transform::Scale({1, 2, 1});
  CHECK_FALSE(IsTessellated(SphereShape(5, 0), plain));
  CHECK_FALSE(IsTessellated(PartOfSphere(5, -5, 5, 360), plain));
  CHECK_FALSE(IsTessellated(DiskShape(5, 0), Transform::Scale({2, 2, 3})));
  CHECK_FALSE(IsTessellated(PlaneShape(0), bent));
  CHECK(IsTessellated(SphereShape(5, 0), bent));
  CHECK(IsTessellated(PartOfSphere(5, -5, 4.9, 360), plain));
  CHECK(IsTessellated(PartOfSphere(5, -4.9, 5, 360), plain));
  CHECK(IsTessellated(PartOfSphere(5, -5, 5, 359), plain));
  CHECK(IsTessellated(DiskShape(5, 0), bent));
  CHECK(IsTessellated(PartOfDisk(5, 0, 0, 359), plain));
  // An object's ball that one instance squeezes and another does not.
  SceneDescription d = SquareScene();
  d.shapes[0] = SphereShape(1, 0);
  d.objects.push_back({"ball", d.shapes});
  d.shapes.clear();
  d.instances = {{0, plain, {}}, {0, bent, {}}};
  const CompiledScene scene = CompileScene(d);
  CHECK(scene.geometry.spheres.size() == 1);
  CHECK(scene.geometry.triangles.size() > 1000);
}

TEST_CASE("tessellation: the tolerance follows the camera's resolution", "[compile]") {
  for (const double unit : {1e-6, 1.0, 1e6}) {
    CAPTURE(unit);
    SceneDescription d;
    d.film.width = 200;
    d.film.height = 100;
    d.camera.fov = 90;
    d.camera.world_from_camera = Transform::Translate({0, 0, 5 * unit});
    const auto tolerance = [&](const Shape& shape, double distance) {
      PlacedShape placed;
      placed.shape = &shape;
      placed.transform = Transform::Translate({0, 0, (5 + distance + 3) * unit}) *
                         Transform::Scale({unit, 2 * unit, unit});
      return CameraTolerance(placed, d.camera, d.film);
    };
    const Shape tube = Cylinder(1.5, 0, 0, 360), ball = PartOfSphere(1.5, 0, 1, 360);
    // Largest radius 3; a pixel is 1/50 of the distance.
    CHECK(tolerance(tube, 1) == Approx(0.02 / 50 / 3));
    CHECK(tolerance(ball, 2) == Approx(0.02 / 50 / 3 * 2));
    CHECK(tolerance(tube, 50) == kCoarsest);
    CHECK(tolerance(tube, 1e-3) == kFinestCylinder);
    CHECK(tolerance(ball, 0) == kFinestSphere);
    d.camera.kind = CameraKind::kOrthographic;
    d.camera.world_from_camera = Transform::Scale({unit, unit, unit});
    const double window[4] = {-1, 1, -0.5, 0.5};
    std::copy(window, window + 4, d.camera.screen_window);
    CHECK(tolerance(tube, 1) == Approx(0.02 / 100 / 3));
    CHECK(tolerance(tube, 70) == Approx(0.02 / 100 / 3));
  }
}

TEST_CASE("tessellation: degenerate shapes give no triangles", "[compile]") {
  for (Shape shape : {Cylinder(1, 1, 1, 360), Cylinder(1, 0, 1, 0),
                      PartOfSphere(1, 0.5, 0.5, 360), PartOfDisk(1, 0, 0, 0)}) {
    SceneDescription d = SquareScene();
    d.shapes.push_back(shape);
    const CompiledScene scene = CompileScene(d);
    CHECK(scene.geometry.triangles.size() == 2);
    REQUIRE(scene.notes.size() == 1);
    CHECK(scene.notes[0].message.find("degenerate triangles") != std::string::npos);
  }
}

}  // namespace
}  // namespace lanelight

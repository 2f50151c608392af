// Cylinders, parts of spheres and disks, and squeezed ones: the wavefront, which renders
// triangles, against the reference, which intersects the shapes themselves.
#include <catch2/catch.hpp>

#include "tests/agreement/agreement.h"

namespace lanelight::test {
namespace {

// Seen in so few pixels, triangles are off by up to 1e-3 of a radius: so are outlines.
constexpr double kTolerance = 2e-3;

Shape& Add(SceneBuilder& b, ShapeKind kind, const Transform& place, Index material,
           Index light = kNone) {
  Shape& shape = b.AddSphere({}, 1, material, light);
  shape.kind = kind;
  shape.world_from_object = place;
  return shape;
}

Transform Turned(Vec3d to, double degrees, Vec3d axis) {
  return Transform::Translate(to) * Transform::Rotate(degrees, axis);
}

Index AddChecks(SceneBuilder& b, bool is_float) {
  Texture checks;
  checks.kind = TextureKind::kCheckerboard;
  checks.is_float = is_float;
  checks.tex1.constant = {0.9, 0.3, 0.2};
  checks.tex2.constant = {0.1, 0.4, 0.8};
  if (is_float) checks.tex1.constant = Grey(1), checks.tex2.constant = Grey(0);
  checks.mapping = {6, 3, 0.1, 0.2};
  b.scene().textures.push_back(checks);
  return static_cast<Index>(b.scene().textures.size()) - 1;
}

// A chequered tube that is open along one side, a metal bowl, a fan, a squeezed ball.
SceneDescription Still() {
  SceneBuilder b(12, 8);
  b.Depth(4).Perspective({0, -7, 4}, {0, 0, 0.5}, {0, 0, 1}, 32);
  Material chequered;
  chequered.reflectance.texture = AddChecks(b, false);
  const Index checks = b.AddMaterial(chequered);
  const Index metal = b.AddConductor({0.2, 0.9, 1.1}, {3.9, 2.5, 2.2}, 0.3);
  Shape& tube =
      Add(b, ShapeKind::kCylinder, Turned({-1.6, 0, 0.7}, 60, {1, 0.3, 0}), checks);
  tube.radius = 0.7, tube.z_min = -0.8, tube.z_max = 1, tube.phi_max = 250;
  Shape& bowl = Add(b, ShapeKind::kSphere, Turned({0.2, 0, 0.9}, 160, {1, 0, 0}), metal);
  bowl.radius = 0.9, bowl.z_min = -0.3, bowl.z_max = 0.7, bowl.phi_max = 300;
  Shape& fan = Add(b, ShapeKind::kDisk, Turned({1.7, 0.5, 1}, 70, {1, 0, 0.4}), checks);
  fan.radius = 0.8, fan.inner_radius = 0.2, fan.phi_max = 230;
  fan.alpha.texture = AddChecks(b, true);
  Add(b, ShapeKind::kSphere,
      Turned({1.4, -1.2, 0.4}, 30, {0, 0, 1}) * Transform::Scale({-0.5, 0.3, 0.4}),
      checks);
  b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddDiffuse(Grey(0.5)));
  b.AddQuad({-2, -2, 4}, {0, 3, 0}, {3, 0, 0}, checks, b.AddEmission({6, 6, 5}));
  b.AddEnvironment({0.3, 0.35, 0.4});
  return b.Build();
}

// The same kinds as lights: outward, mirrored inward, on both sides, of a given power.
SceneDescription Lit() {
  SceneBuilder b(8, 8);
  b.Depth(3).Perspective({0, -6, 5}, {0, 0, 0.3}, {0, 0, 1}, 36);
  const Index black = b.AddDiffuse(Grey(0.2));
  b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddDiffuse({0.4, 0.5, 0.6}));
  Shape& tube = Add(b, ShapeKind::kCylinder, Turned({-1, 0, 0.8}, 80, {0, 1, 0}), black,
                    b.AddEmission({3, 1, 1}));
  tube.radius = 0.2, tube.z_min = -0.5, tube.z_max = 0.5;
  Shape& shell =
      Add(b, ShapeKind::kSphere,
          Turned({0.8, 0.5, 0.4}, 40, {1, 0, 0}) * Transform::Scale({-1, 1, 1}), black,
          b.AddEmission({1, 3, 1}));
  shell.radius = 0.5, shell.z_min = -0.5, shell.z_max = 0.1;
  AreaLight powered;
  powered.power = 20;
  powered.two_sided = true;
  b.scene().area_lights.push_back(powered);
  Shape& fan = Add(b, ShapeKind::kDisk, Turned({0, 1, 1}, 60, {1, 0, 0}), black, 2);
  fan.radius = 0.6, fan.inner_radius = 0.3, fan.phi_max = 200;
  return b.Build();
}

// An object of a glass tube, whose own transform mirrors it, and a bowl that shows two
// sides; once as it is, once squeezed and mirrored.
SceneDescription Instanced() {
  SceneBuilder b(8, 8);
  b.Depth(5).Perspective({0, -6, 4}, {0, 0, 0.5}, {0, 0, 1}, 36);
  Material leaf;
  leaf.kind = MaterialKind::kDiffuseTransmission;
  leaf.reflectance.constant = {0.7, 0.1, 0.1};
  leaf.transmittance.constant = {0.1, 0.1, 0.7};
  Shape& tube = Add(b, ShapeKind::kCylinder,
                    Turned({-0.6, 0, 0.6}, 70, {1, 0, 0}) * Transform::Scale({-1, 1, 1}),
                    b.AddDielectric(1.5));
  tube.radius = 0.5, tube.z_min = -0.8, tube.z_max = 0.6, tube.phi_max = 280;
  Shape& bowl = Add(b, ShapeKind::kSphere, Turned({0.6, 0, 0.5}, 150, {1, 0, 0}),
                    b.AddMaterial(leaf));
  bowl.radius = 0.5, bowl.z_max = 0.2, bowl.reverse_orientation = true;
  b.scene().objects.push_back({"round", b.scene().shapes});
  b.scene().shapes.clear();
  b.scene().instances = {
      {0, Transform::Translate({-0.8, 0, 0}), {}},
      {0, Transform::Translate({1, 0.5, 0}) * Transform::Scale({0.8, -0.8, 1.2}), {}}};
  b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddDiffuse(Grey(0.5)));
  b.AddQuad({-2, -2, 4}, {0, 3, 0}, {3, 0, 0}, b.AddDiffuse(Grey(0)),
            b.AddEmission({6, 6, 5}));
  b.AddEnvironment({0.2, 0.35, 0.5});
  return b.Build();
}

void CheckAgreement(const SceneDescription& scene, int samples, double detectable) {
  stat::CheckSame(CompareWithReference(scene, static_cast<std::uint64_t>(samples),
                                       samples, kTolerance),
                  detectable);
}

}  // namespace

TEST_CASE("wavefront agrees on parts of round shapes", "[agreement]") {
  CheckAgreement(Still(), 4096, 0.05);
}

TEST_CASE("wavefront agrees on instances of round shapes", "[agreement]") {
  const SceneDescription scene = Instanced();
  CHECK(CompileScene(scene).geometry.instances.size() == 2);
  CheckAgreement(scene, 4096, 0.03);
}

TEST_CASE("wavefront agrees on round shapes that emit", "[agreement]") {
  CheckAgreement(Lit(), 16384, 0.03);
}

}  // namespace lanelight::test

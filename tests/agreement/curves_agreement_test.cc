// Curves and hair: the wavefront agrees with the scalar reference, and scenes without
// them have no column or stage for them.
#include <catch2/catch.hpp>
#include <cmath>

#include "src/base/core/pi.h"
#include "tests/agreement/agreement.h"

namespace lanelight::test {
namespace {

Shape& AddCurve(SceneBuilder& b, Index material, CurveType type, double width, Vec3d at) {
  Shape& shape = b.AddSphere({}, 1, material);
  shape.kind = ShapeKind::kCurves;
  shape.world_from_object = Transform::Translate(at);
  Curve curve;
  curve.p[0] = {-0.7, 0, 0.2}, curve.p[1] = {-0.3, 0.3, 1.2};
  curve.p[2] = {0.3, -0.3, -0.4}, curve.p[3] = {0.7, 0, 0.7};
  curve.width[0] = width, curve.width[1] = 0.6 * width;
  curve.type = type;
  curve.normal[0] = {0, -1, 0};
  curve.normal[1] = Normalize(Vec3d{0.3, -1, 0.5});
  shape.curves = std::make_shared<std::vector<Curve>>(1, curve);
  return shape;
}

SceneBuilder Ground(int width, int height, int depth) {
  SceneBuilder b(width, height);
  b.Depth(depth).Perspective({0, -6, 3}, {0, 0, 0.4}, {0, 0, 1}, 30);
  b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddDiffuse({0.4, 0.5, 0.6}));
  b.AddQuad({-2, -2, 4}, {0, 3, 0}, {3, 0, 0}, b.AddDiffuse(Grey(0)),
            b.AddEmission({6, 6, 5}));
  b.AddEnvironment({0.3, 0.35, 0.4});
  return b;
}

// A curve of each type, chequered, of metal and of glass; one as an instance, turned and
// mirrored.
SceneDescription TypesOfCurves() {
  SceneBuilder b = Ground(12, 6, 4);
  Texture checks;
  checks.kind = TextureKind::kCheckerboard;
  checks.tex1.constant = {0.9, 0.3, 0.2};
  checks.tex2.constant = {0.1, 0.4, 0.8};
  checks.mapping = {7, 3, 0.1, 0.2};
  b.scene().textures.push_back(checks);
  Material chequered;
  chequered.reflectance.texture = 0;
  const Index painted = b.AddMaterial(chequered);
  AddCurve(b, painted, CurveType::kRibbon, 0.4, {0, 0, 0}).reverse_orientation = true;
  b.scene().objects.push_back({"ribbon", {b.scene().shapes.back()}});
  b.scene().shapes.pop_back();
  b.scene().instances = {
      {0,
       Transform::Translate({-1.6, 0, 0.1}) * Transform::Rotate(20, {0, 0, 1}) *
           Transform::Scale({-1.2, 1.2, 1.2}),
       {}}};
  AddCurve(b, b.AddConductor({0.2, 0.9, 1.1}, {3.9, 2.5, 2.2}, 0.3), CurveType::kCylinder,
           0.3, {0, 0, 0});
  AddCurve(b, painted, CurveType::kFlat, 0.3, {1.6, 0, 0});
  AddCurve(b, b.AddDielectric(1.5, 0.2), CurveType::kCylinder, 0.2, {0.8, 0.6, 0.2});
  AddCurve(b, painted, CurveType::kCylinder, 0.25, {-0.8, 0.8, 0.1});
  return b.Build();
}

// The same, each stretched, sheared or mirrored, beside hair that is.
SceneDescription StretchedCurves() {
  SceneDescription scene = TypesOfCurves();
  Transform::Matrix shear{
      {{1, 0.4, 0, 0}, {0, 1, -0.3, 0}, {0.2, 0, 1, 0}, {0, 0, 0, 1}}};
  const Transform stretches[] = {
      Transform::Scale({1.3, 0.5, 1.1}), Transform(shear), Transform::Scale({-1, 1, 1}),
      Transform::Rotate(30, {1, 2, 0}) * Transform::Scale({0.6, 2, -0.8})};
  std::size_t next = 0;
  for (Shape& shape : scene.shapes) {
    if (shape.kind != ShapeKind::kCurves) continue;
    shape.world_from_object = shape.world_from_object * stretches[next++ % 4];
  }
  Transform& instance = scene.instances[0].world_from_object;
  instance = instance * Transform::Scale({1, 1.7, 0.6});
  return scene;
}

// Strands of hair in front of each other, of all ways to colour it.
SceneDescription Hairs() {
  SceneBuilder b = Ground(12, 6, 5);
  Material hair;
  hair.kind = MaterialKind::kHair;
  hair.interface_eta = 1.55;
  hair.sigma_a = {0.2, 0.4, 1};
  const Index brown = b.AddMaterial(hair);
  hair.has_reflectance = true;
  hair.reflectance.constant = {0.7, 0.5, 0.2};
  hair.beta_m = 0.5, hair.beta_n = 0.6, hair.tilt = 5;
  const Index blond = b.AddMaterial(hair);
  for (int i = 0; i < 12; ++i) {
    AddCurve(b, i % 2 == 0 ? brown : blond,
             i % 3 == 0 ? CurveType::kCylinder : CurveType::kFlat, 0.12,
             {-1.5 + 0.28 * i, 0.1 * (i % 5), 0.05 * (i % 4)});
  }
  return b.Build();
}

void CheckCurves(const SceneDescription& scene, std::uint64_t spp, int reference_spp) {
  stat::CheckSame(CompareWithReference(scene, spp, reference_spp, 1e-3), 0.06);
}

}  // namespace

TEST_CASE("wavefront agrees on curves of every type", "[agreement][curves]") {
  CheckCurves(TypesOfCurves(), 8192, 2000);
}

TEST_CASE("wavefront agrees on stretched curves", "[agreement][curves]") {
  CheckCurves(StretchedCurves(), 8192, 2000);
  SceneDescription hairs = Hairs();
  for (Shape& shape : hairs.shapes) {
    if (shape.kind != ShapeKind::kCurves) continue;
    shape.world_from_object = shape.world_from_object * Transform::Scale({-1, 1.6, 0.5});
  }
  CheckCurves(hairs, 8192, 2000);
}

TEST_CASE("the width of a stretched curve is measured in object space", "[curves]") {
  // Along x, seen from z = 5: in object space, a ray of slope s passes the middle line at
  // a distance of 5 (s / 3) / sqrt(1 + (s / 3)^2). This is at most half the width.
  SceneBuilder b(1, 1);
  b.Depth(0).Perspective({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 20);
  b.AddEnvironment(Grey(1));
  Shape& shape = AddCurve(b, b.AddDiffuse(Grey(0.5)), CurveType::kFlat, 0.2, {});
  shape.world_from_object = Transform::Scale({-40, 3, 1});
  Curve& curve = shape.curves->front();
  for (int k = 0; k < 4; ++k) curve.p[k] = {k / 1.5 - 1, 0, 0};
  curve.width[1] = 0.2;
  const double slope = 3 * 0.1 / std::sqrt(25 - 0.01);
  const double seen = 1 - slope / std::tan(10 * kPi / 180);
  const auto known = stat::ExpectedImage(1, 1, [&](int, int) { return Grey(seen); });
  stat::CheckSame(stat::CompareMeans(RenderWavefront(b.Build(), 1 << 18), known,
                                     {4, 1e-6, kFloatTolerance, 1e-7}),
                  0.01);
}

TEST_CASE("a nearly flattened curve is rendered or refused", "[agreement][curves]") {
  SceneDescription scene = Hairs();
  for (const auto& [flat, fails] : {std::pair{1e-4, false}, std::pair{1e-25, true}}) {
    for (Shape& shape : scene.shapes) {
      if (shape.kind != ShapeKind::kCurves) continue;
      shape.world_from_object = Transform::Scale({1, flat, 1});
    }
    if (fails) {
      CHECK_THROWS_WITH(RenderWavefront(scene, 1), Catch::Contains("flattens"));
    } else {
      RenderWavefront(scene, 16);
    }
  }
}

TEST_CASE("wavefront agrees on strands of hair", "[agreement][curves]") {
  CheckCurves(Hairs(), 8192, 2000);
}

TEST_CASE("strategies agree on strands of hair", "[agreement][curves]") {
  const auto plain = RenderWavefront(Hairs(), 8192);
  for (const char* strategy :
       {"reuse=block", "roulette=adjoint", "light-candidates=resampled"}) {
    stat::CheckSame(stat::CompareMeans(RenderWavefront(Hairs(), 4096, strategy), plain,
                                       {4, 1e-6, 1e-4, 1e-7}),
                    strategy);
  }
}

TEST_CASE("a curve with another end point is detected", "[agreement][curves]") {
  const SceneDescription scene = TypesOfCurves();
  SceneDescription longer = TypesOfCurves();
  for (Shape& shape : longer.shapes) {
    if (shape.kind != ShapeKind::kCurves) continue;
    Curve& curve = shape.curves->front();
    curve.p[3] = curve.p[3] + 1.0 * (curve.p[3] - curve.p[2]);
  }
  const auto result =
      stat::CompareMeans(RenderWavefront(scene, 8192), RenderWavefront(longer, 8192));
  INFO(result.ToString());
  CHECK_FALSE(result.same);
}

TEST_CASE("scenes without curves have no curve stages or columns",
          "[agreement][curves]") {
  const CompiledScene room = CompileScene(SmallRoom(8, 3));
  CHECK(room.accel.curve_blocks.size() == 0);
  CHECK(room.accel.curves.root == kEmptyRef);
  CHECK(room.geometry.curves.capacity() + room.geometry.ribbons.capacity() +
            room.geometry.curve_spaces.capacity() ==
        0);
  CHECK_FALSE(room.features.HasAny({Feature::kCurves, Feature::kHair}));
  const CompiledScene hair = CompileScene(Hairs());
  CHECK(hair.accel.curve_blocks.size() >= 2);
  CHECK(hair.geometry.ribbons.empty());
  CHECK(hair.geometry.curve_spaces.empty());
  CHECK(hair.features.HasAll(
      {Feature::kCurves, Feature::kHair, Feature::kTangents, Feature::kUv}));
}

}  // namespace lanelight::test

// The wavefront renders what the scalar reference renders: every material, light and
// shape, tile by tile, within confidence limits of one family-wise false-alarm budget.
// Each test also says how large a bias it would have found, and a planted one is found.
#include <catch2/catch.hpp>

#include "kernels/simd/target.h"
#include "src/base/image/color_spaces.h"
#include "tests/agreement/agreement.h"

namespace lanelight::test {
namespace {

bool IsClearCoat(const Material& m) {
  return m.coat_albedo.constant == Rgb{} && (m.kind == MaterialKind::kCoatedDiffuse ||
                                             m.kind == MaterialKind::kCoatedConductor);
}

SceneDescription MixedScene() {
  SceneBuilder b(8, 8);
  b.Depth(3).Perspective({0, -4, 3}, {0, 0, 0.3}, {0, 0, 1}, 30);
  b.scene().film.imaging_ratio = 0.7;
  b.scene().film.response.matrix = FilmMatrix(FindColorSpace("rec2020"), 4200);
  b.scene().filter.kind = FilterKind::kGaussian;
  b.scene().filter.x_radius = b.scene().filter.y_radius = 1.5;
  b.Lens(0.05, 5);
  Material mix;
  mix.kind = MaterialKind::kMix;
  mix.mix[0] = b.AddDiffuse({0.2, 0.4, 0.8});
  mix.mix[1] = b.AddConductor({0.2, 0.9, 1.1}, {3.9, 2.5, 2.2}, 0.3);
  mix.mix_amount.constant = 0.3;
  b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddMaterial(mix));
  b.AddSphere({0.5, 0, 0.4}, 0.4, mix.mix[0]);
  b.AddDisk({-0.6, 0, 0.5}, {0, -1, 1}, 0.3, mix.mix[0], b.AddEmission({1, 2, 3}, true));
  AreaLight powered;
  powered.power = 30;
  b.scene().area_lights.push_back(powered);
  b.AddQuad({-1, 1, 1}, {2, 0, 0}, {0, 0, 0.5}, mix.mix[0], 1);
  b.AddSpot({0, 0, 3}, {0, 0, 0}, {4, 4, 4}, 30, 10);
  b.AddDistant({1, 0, 2}, {0.3, 0.3, 0.2});
  return b.Build();
}

SceneDescription InstancedScene() {
  SceneBuilder b(8, 8);
  b.Depth(4).Perspective({0, -5, 3}, {0, 0, 0.3}, {0, 0, 1}, 34);
  const Index red = b.AddDiffuse({0.7, 0.2, 0.1}), ground = b.AddDiffuse(Grey(0.5));
  b.AddBox({-0.5, -0.5, 0}, {0.5, 0.5, 0.4}, red);
  ObjectDefinition object;
  object.shapes = b.scene().shapes;
  b.scene().objects.push_back(object);
  b.scene().shapes.clear();
  for (int i = 0; i < 5; ++i) {
    Instance instance;
    instance.object = 0;
    instance.world_from_object =
        Transform::Translate({i * 0.8 - 1.6, 0.3 * i, 0.01}) *
        Transform::Rotate(35.0 * i, {0, 0, 1}) *
        Transform::Scale({i % 2 == 0 ? 0.7 : -0.7, 0.7, 0.5 + 0.4 * i});
    b.scene().instances.push_back(instance);
  }
  b.AddPlane({0, 0, 0}, {0, 0, 1}, ground);
  b.AddSphere({0, -1, 3}, 0.5, ground, b.AddEmission({6, 6, 5}));
  b.AddEnvironment({0.2, 0.25, 0.3});
  return b.Build();
}

// Interpolated normals on a coarse dome, lit from several sides.
SceneDescription ShadedDome() {
  SceneBuilder b(8, 8);
  b.Depth(3).Perspective({0, -4, 3}, {0, 0, 0.3}, {0, 0, 1}, 36);
  TriangleMesh dome;
  dome.positions.push_back({0, 0, 1});
  dome.normals.push_back({0, 0, 1});
  for (int i = 0; i < 6; ++i) {
    const double phi = i * 1.0471975511965976;
    dome.positions.push_back({std::cos(phi), std::sin(phi), 0.2});
    dome.normals.push_back({0.8 * std::cos(phi), 0.8 * std::sin(phi), 0.6});
    const auto a = static_cast<std::uint32_t>(i + 1);
    const auto next = static_cast<std::uint32_t>((i + 1) % 6 + 1);
    dome.indices.insert(dome.indices.end(), {0, a, next});
  }
  b.AddMesh(dome, b.AddConductor({0.2, 0.9, 1.1}, {3.9, 2.5, 2.2}, 0.4));
  b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddDiffuse({0.4, 0.5, 0.6}));
  b.AddQuad({-1.5, -1.5, 2}, {0, 1, 0}, {1, 0, 0}, b.AddDiffuse(Grey(0)),
            b.AddEmission({5, 5, 5}));
  b.AddEnvironment({0.3, 0.2, 0.1});
  return b.Build();
}

// Chequered colour, roughness and alpha on a quad, a ball and the ground.
SceneDescription TexturedScene() {
  SceneBuilder b(8, 8);
  b.Depth(3).Perspective({0, -4, 3}, {0, 0, 0.3}, {0, 0, 1}, 36);
  Texture colors;
  colors.kind = TextureKind::kCheckerboard;
  colors.tex1.constant = {0.8, 0.3, 0.1};
  colors.tex2.constant = {0.1, 0.4, 0.7};
  colors.mapping = {3, 2, 0.2, 0.1};
  Texture floats = colors;
  floats.is_float = true;
  floats.tex1.constant = Grey(0.2);
  floats.tex2.constant = Grey(0.6);
  Texture holes = floats;
  holes.tex1.constant = Grey(0);
  holes.tex2.constant = Grey(1);
  b.scene().textures = {colors, floats, holes};
  Material painted, brushed;
  painted.reflectance.texture = 0;
  brushed.kind = MaterialKind::kConductor;
  brushed.eta.constant = {0.2, 0.9, 1.1};
  brushed.k.constant = {3.9, 2.5, 2.2};
  brushed.uroughness.texture = brushed.vroughness.texture = 1;
  brushed.remap_roughness = false;
  const Index paint = b.AddMaterial(painted);
  b.AddPlane({0, 0, 0}, {0, 0, 1}, paint);
  b.AddSphere({0.6, 0, 0.6}, 0.6, b.AddMaterial(brushed));
  b.AddQuad({-1.4, -0.3, 0.3}, {1, 0, 0.4}, {0, 1, 0.2}, paint).alpha.texture = 2;
  b.AddSphere({0, -1, 3}, 0.6, b.AddDiffuse(Grey(0)), b.AddEmission({4, 4, 3}));
  b.AddEnvironment({0.4, 0.45, 0.5});
  return b.Build();
}

void CheckMaterials(std::uint64_t spp, int reference_spp, double power) {
  for (const Material& material : MaterialZoo()) {
    // The kernels sum the inner bounces of a clear coat in closed form, within 3 %.
    const double tolerance = IsClearCoat(material) ? 0.03 : kFloatTolerance;
    stat::CheckSame(
        CompareWithReference(Plate(material, 6), spp, reference_spp, tolerance), power,
        material.name);
  }
}

}  // namespace

TEST_CASE("wavefront agrees with the reference on every material", "[agreement]") {
  CheckMaterials(4096, 1500, 0.15);
}

TEST_CASE("wavefront agrees with the reference on every material within a few per cent",
          "[agreement][slow]") {
  CheckMaterials(65536, 24000, 0.04);
}

TEST_CASE("wavefront agrees with the reference in a closed room", "[agreement]") {
  CheckAgreement(SmallRoom(12, 4), 8192, 1000, 0.07);
}

TEST_CASE("wavefront agrees on mixes, spots, power, lens and filter", "[agreement]") {
  CheckAgreement(MixedScene(), 8192, 4000, 0.05);
}

TEST_CASE("wavefront agrees on instances", "[agreement]") {
  CheckAgreement(InstancedScene(), 8192, 1500, 0.05);
}

TEST_CASE("wavefront agrees on interpolated normals", "[agreement]") {
  CheckAgreement(ShadedDome(), 8192, 2000, 0.05);
}

TEST_CASE("wavefront agrees on textured colour, roughness and alpha", "[agreement]") {
  CheckAgreement(TexturedScene(), 8192, 2000, 0.05);
}

TEST_CASE("wavefront agrees with the reference on every target", "[agreement]") {
  CheckAgreementOnTargets(SmallRoom(8, 3), 512, 1000);
}

TEST_CASE("the agreement tests detect a planted bias", "[agreement]") {
  const SceneDescription scene = SmallRoom(12, 4);
  const auto reference =
      Estimate(RenderReference(scene, Options(ReferenceEstimator::kLightSampling, 800)));
  SceneDescription brighter = scene;
  brighter.materials[0].reflectance.constant *= 1.07;
  CHECK_FALSE(stat::CompareMeans(RenderWavefront(brighter, 4096), reference).same);
  SceneDescription shallower = scene;
  shallower.integrator.max_depth = 3;
  CHECK_FALSE(stat::CompareMeans(RenderWavefront(shallower, 4096), reference).same);
}

}  // namespace lanelight::test

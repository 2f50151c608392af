// Exactly the features that a scene needs, and what becomes of alpha and interfaces.
#include <catch2/catch.hpp>
#include <iterator>
#include <set>
#include <sstream>

#include "tests/scene/compile/testing.h"

namespace lanelight {
namespace {

using Words = std::set<std::string>;

// Without the camera, which every scene has.
Words Names(FeatureSet features) {
  features.Remove({Feature::kPerspective, Feature::kOrthographic});
  Words names;
  for (int i = 0; i < static_cast<int>(Feature::kCount); ++i) {
    const auto f = static_cast<Feature>(i);
    if (features.Has(f)) names.insert(FeatureName(f));
  }
  return names;
}

Words Features(const SceneDescription& d) { return Names(CompileScene(d).features); }

Words Split(const std::string& text) {
  std::istringstream words(text);
  return {std::istream_iterator<std::string>(words), {}};
}

Texture Checker(bool is_float = false) {
  Texture texture;
  texture.kind = TextureKind::kCheckerboard;
  texture.is_float = is_float;
  return texture;
}

// The square scene with one material.
SceneDescription With(const Material& m) {
  SceneDescription d = SquareScene();
  d.materials.clear();
  AddMaterial(d, m);
  return d;
}

Material Rough(MaterialKind kind, double u, double v) {
  Material m = OfKind(kind);
  m.remap_roughness = false;
  m.uroughness.constant = u;
  m.vroughness.constant = v;
  return m;
}

TEST_CASE("compile: features of materials", "[scene][compile]") {
  CHECK(Features(SquareScene()) == Split("Triangles Diffuse"));
  CHECK(Features(With(Rough(MaterialKind::kConductor, 0, 0))) ==
        Split("Triangles ConductorSmooth"));
  CHECK(Features(With(Rough(MaterialKind::kConductor, 0.2, 0.2))) ==
        Split("Triangles ConductorRough"));
  CHECK(Features(With(Rough(MaterialKind::kConductor, 0.2, 0.3))) ==
        Split("Triangles Tangents ConductorRough"));
  CHECK(Features(With(OfKind(MaterialKind::kDielectric))) ==
        Split("Triangles DielectricSmooth Refraction"));
  CHECK(Features(With(Rough(MaterialKind::kDielectric, 0.1, 0.1))) ==
        Split("Triangles DielectricRough Refraction"));
  CHECK(Features(With(OfKind(MaterialKind::kThinDielectric))) ==
        Split("Triangles ThinDielectric"));
  CHECK(Features(With(OfKind(MaterialKind::kCoatedDiffuse))) ==
        Split("Triangles CoatedDiffuseSmooth"));
  CHECK(Features(With(Rough(MaterialKind::kCoatedDiffuse, 0.1, 0.1))) ==
        Split("Triangles CoatedDiffuseRough"));
  CHECK(Features(With(OfKind(MaterialKind::kCoatedConductor))) ==
        Split("Triangles CoatedConductor"));
  CHECK(Features(With(OfKind(MaterialKind::kDiffuseTransmission))) ==
        Split("Triangles DiffuseTransmission"));
  // An anisotropic roughness that does not matter.
  CHECK(Features(With(Rough(MaterialKind::kDielectric, 1e-4, 5e-4))) ==
        Split("Triangles DielectricSmooth Refraction"));
}

TEST_CASE("compile: features of textures", "[scene][compile]") {
  Material m;
  m.reflectance.texture = 0;
  SceneDescription d = With(m);
  AddTexture(d, Checker());
  CHECK(Features(d) == Split("Triangles Uv Textures Diffuse"));
  CHECK(CompileScene(d).geometry.uvs.size() == 12);
  d.textures[0].kind = TextureKind::kConstant;
  CHECK(Features(d) == Split("Triangles Diffuse"));
  CHECK(CompileScene(d).geometry.uvs.empty());

  m = Rough(MaterialKind::kConductor, 0, 0);
  m.uroughness.texture = m.vroughness.texture = 0;
  d.materials[0] = m;
  d.textures[0] = Checker(true);
  CHECK(Features(d) == Split("Triangles Uv Textures TexturedRoughness ConductorRough"));
  d.materials[0].vroughness.texture = AddTexture(d, Checker(true));
  CHECK(Features(d) ==
        Split("Triangles Uv Tangents Textures TexturedRoughness ConductorRough"));
}

TEST_CASE("compile: unused objects add no features", "[scene][compile]") {
  SceneDescription d = SquareScene();
  AddTexture(d, Checker());
  Texture missing;
  missing.kind = TextureKind::kImage;
  missing.path = "/nowhere/missing.png";
  Material unused = Rough(MaterialKind::kConductor, 0.1, 0.5);
  unused.eta.texture = 0;
  unused.k.texture = AddTexture(d, missing);
  AddMaterial(d, unused);
  AddMaterial(d, OfKind(MaterialKind::kDielectric));
  AddAreaLight(d, {});
  d.objects.resize(1);
  d.objects[0].shapes = {SphereShape(1, 2)};
  CHECK(Features(d) == Split("Triangles Diffuse"));
  CHECK(CompileScene(d).materials.size() == 1);
}

TEST_CASE("compile: features of mixes", "[scene][compile]") {
  SceneDescription d = SquareScene();
  AddMaterial(d, OfKind(MaterialKind::kDielectric));
  Material mix = OfKind(MaterialKind::kMix);
  mix.mix[0] = 0;
  mix.mix[1] = 1;
  d.shapes[0].material = AddMaterial(d, mix);
  CHECK(Features(d) == Split("Triangles Mix Diffuse DielectricSmooth Refraction"));
  d.materials[2].mix_amount.texture = AddTexture(d, Checker(true));
  CHECK(Features(d) == Split("Triangles Uv Mix Diffuse DielectricSmooth Refraction"));
}

TEST_CASE(
    "compile: multiple importance sampling needs a rough surface and a light to hit",
    "[scene][compile]") {
  SceneDescription d = SquareScene();
  d.shapes.push_back(SphereShape(1, 0));
  d.shapes[1].area_light = AddAreaLight(d, {});
  CHECK(CompileScene(d).features.Has(Feature::kMis));
  d.materials[0] = OfKind(MaterialKind::kDielectric);
  CHECK_FALSE(CompileScene(d).features.Has(Feature::kMis));
  CHECK(CompileScene(d).features.Has(Feature::kLights));
  d.materials[0] = OfKind(MaterialKind::kDiffuse);
  d.shapes[1].area_light = kNone;
  Light point;
  point.emission = {1, 1, 1};
  d.lights = {point};
  CHECK_FALSE(CompileScene(d).features.Has(Feature::kMis));
}

TEST_CASE("compile: shapes, lens and camera", "[scene][compile]") {
  SceneDescription d = SquareScene();
  d.shapes = {SphereShape(1, 0), DiskShape(1, 0), PlaneShape(0)};
  CHECK(Features(d) == Split("Spheres Disks Planes Diffuse"));
  d.shapes = {SphereShape(1, 0)};
  d.camera.lens_radius = 0.1;
  CHECK(Features(d) == Split("Spheres Diffuse Lens"));
  const PrimitiveRanges& r = CompileScene(d).geometry.ranges;
  CHECK(r.spheres == 0);
  CHECK(r.disks == 1);
  CHECK(r.end == 1);
}

TEST_CASE("compile: alpha", "[scene][compile]") {
  SceneDescription d = SquareScene();
  d.shapes.push_back(SphereShape(1, 0));
  d.shapes.push_back(MeshShape(Square(), 0));
  d.shapes[0].alpha.constant = 0.25;
  CompiledScene scene = CompileScene(d);
  CHECK(Names(scene.features) == Split("Triangles Spheres Alpha Diffuse"));
  REQUIRE(scene.alpha.constant.size() == 5);
  CHECK(scene.alpha.constant[1] == 0.25f);
  CHECK(scene.alpha.constant[2] == 1.0f);
  CHECK(scene.alpha.constant[4] == 1.0f);
  CHECK(scene.alpha.texture[0] == -1);
  CHECK(scene.geometry.triangles[0].flags == kAlphaTested);
  CHECK(scene.geometry.triangles[3].flags == 0);
  CHECK(scene.geometry.spheres[0].flags == 0);

  // Textures: constant ones are constants, others need uv.
  d.shapes[0].alpha.constant = 1;
  d.shapes[1].alpha.texture = AddTexture(d, Checker(true));
  scene = CompileScene(d);
  CHECK(Names(scene.features) == Split("Triangles Spheres Uv Alpha Diffuse"));
  CHECK(scene.alpha.texture[4] == 0);
  CHECK(scene.alpha.texture[0] == -1);
  CHECK(scene.geometry.spheres[0].flags == kAlphaTested);
  d.textures[0] = Texture{};
  d.textures[0].value = {1, 1, 1};
  CHECK(Features(d) == Split("Triangles Spheres Diffuse"));
  CHECK(CompileScene(d).alpha.texture.empty());

  // Alpha 0: nothing is left of the shape.
  d.textures[0].value = {0, 0, 0};
  CHECK(Features(d) == Split("Triangles Diffuse"));
  d.shapes[2].alpha.constant = 0;
  CHECK(CompileScene(d).geometry.triangles.size() == 2);
}

TEST_CASE("compile: alpha of instanced meshes", "[scene][compile]") {
  SceneDescription d = SquareScene();
  d.objects.resize(1);
  d.objects[0].shapes = {MeshShape(Square(), 0)};
  d.objects[0].shapes[0].alpha.constant = 0.5;
  Instance instance;
  instance.object = 0;
  d.instances = {instance};
  const CompiledScene scene = CompileScene(d);
  REQUIRE(scene.alpha.constant.size() == 4);
  CHECK(scene.alpha.constant[1] == 1.0f);
  CHECK(scene.alpha.constant[2] == 0.5f);
}

TEST_CASE("compile: interface surfaces vanish", "[scene][compile]") {
  SceneDescription d = SquareScene();
  d.shapes.push_back(SphereShape(1, AddMaterial(d, OfKind(MaterialKind::kInterface))));
  const CompiledScene scene = CompileScene(d);
  CHECK(Names(scene.features) == Split("Triangles Diffuse"));
  CHECK(scene.materials.size() == 1);
  CHECK(scene.geometry.ranges.end == 2);
}

TEST_CASE("compile: invalid transforms are refused", "[scene][compile]") {
  SceneDescription d = SquareScene();
  d.shapes[0].world_from_object = Transform::Scale({1, 0, 1});
  CHECK(CompileError(d).find("scene.pbrt:10:1: error: the transform of this shape cannot "
                             "be inverted") == 0);
  Transform::Matrix m = Transform().matrix();
  m[3][2] = 0.5;
  d.shapes[0].world_from_object = Transform(m);
  CHECK(CompileError(d).find("projective") != std::string::npos);
}

}  // namespace
}  // namespace lanelight

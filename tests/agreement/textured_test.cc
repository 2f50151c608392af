// Textured parameters of materials: a texture that is the same everywhere renders as the
// constant does, and textures that vary as the scalar reference sees them.
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/agreement/agreement.h"

namespace lanelight::test {
namespace {

// A texture of one value that is not folded into a constant.
Index AddSame(SceneDescription& scene, Rgb value) {
  Texture t;
  t.kind = TextureKind::kCheckerboard;
  t.tex1.constant = t.tex2.constant = value;
  scene.textures.push_back(t);
  return static_cast<Index>(scene.textures.size()) - 1;
}

Material Base(MaterialKind kind) {
  Material m;
  m.kind = kind;
  m.remap_roughness = false;
  m.reflectance.constant = {0.6, 0.5, 0.4};
  m.transmittance.constant = {0.3, 0.2, 0.4};
  m.eta.constant = {0.4, 0.9, 1.1};
  m.k.constant = {3.9, 2.5, 2.2};
  m.uroughness.constant = m.vroughness.constant = 0.3;
  m.conductor_uroughness.constant = m.conductor_vroughness.constant = 0.2;
  m.thickness = 0.15;
  return m;
}

using Member = void (*)(SceneDescription&, Material&);
struct TexturedCase {
  const char* name;
  Material material;
  Member textured;
  double tolerance;  // relative, of the mean of the image
};

void TextureFloat(SceneDescription& s, FloatValue& v) {
  v.texture = AddSame(s, Grey(v.constant));
  v.constant = 0;
}
void TextureColor(SceneDescription& s, ColorValue& v) {
  v.texture = AddSame(s, v.constant);
  v.constant = {};
}
void Reflectance(SceneDescription& s, Material& m) { TextureColor(s, m.reflectance); }
void Transmittance(SceneDescription& s, Material& m) { TextureColor(s, m.transmittance); }
void EtaAndK(SceneDescription& s, Material& m) {
  TextureColor(s, m.eta);
  TextureColor(s, m.k);
}
void Roughness(SceneDescription& s, Material& m) {
  TextureFloat(s, m.uroughness);
  m.vroughness = m.uroughness;
}
void MetalRoughness(SceneDescription& s, Material& m) {
  TextureFloat(s, m.conductor_uroughness);
  m.conductor_vroughness = m.conductor_uroughness;
}
void Thickness(SceneDescription& s, Material& m) {
  m.thickness_texture = AddSame(s, Grey(m.thickness));
  m.thickness = 0;
}
void CoatAlbedo(SceneDescription& s, Material& m) { TextureColor(s, m.coat_albedo); }
void CoatG(SceneDescription& s, Material& m) { TextureFloat(s, m.coat_g); }

// Grids of coat tables and the fit of colours interpolate: 1 % of the image, which has
// the coat's own reflection too. Everything else is the same arithmetic.
std::vector<TexturedCase> Cases() {
  const Material leaf = Base(MaterialKind::kDiffuseTransmission);
  const Material metal = Base(MaterialKind::kConductor);
  Material coloured = metal;
  coloured.has_reflectance = true;
  const Material plastic = Base(MaterialKind::kCoatedDiffuse);
  Material gloss = plastic;
  gloss.uroughness.constant = gloss.vroughness.constant = 0;
  const Material lacquer = Base(MaterialKind::kCoatedConductor);
  Material coloured_lacquer = lacquer;
  coloured_lacquer.has_reflectance = true;
  Material milky = plastic, milky_lacquer = lacquer;
  milky.coat_albedo.constant = milky_lacquer.coat_albedo.constant = {0.9, 0.5, 0.2};
  milky.coat_g.constant = milky_lacquer.coat_g.constant = 0.6;
  milky.thickness = milky_lacquer.thickness = 1.5;
  return {{"leaf, transmittance", leaf, Transmittance, 1e-5},
          {"leaf, reflectance", leaf, Reflectance, 1e-5},
          {"metal, eta and k", metal, EtaAndK, 1e-5},
          {"metal, reflectance", coloured, Reflectance, 1e-4},
          {"lacquer, eta and k", lacquer, EtaAndK, 1e-4},
          {"lacquer, reflectance", coloured_lacquer, Reflectance, 1e-4},
          {"lacquer, roughness", lacquer, Roughness, 1e-4},
          {"lacquer, metal's roughness", lacquer, MetalRoughness, 1e-4},
          {"lacquer, thickness", lacquer, Thickness, 1e-4},
          {"milky lacquer, albedo", milky_lacquer, CoatAlbedo, 1e-5},
          {"milky lacquer, g", milky_lacquer, CoatG, 1e-5},
          {"milky plastic, albedo", milky, CoatAlbedo, 1e-5},
          {"milky plastic, g", milky, CoatG, 1e-5},
          {"milky plastic, reflectance", milky, Reflectance, 1e-5},
          {"plastic, roughness", plastic, Roughness, 0.01},
          {"plastic, thickness", plastic, Thickness, 0.01},
          {"plastic, reflectance", plastic, Reflectance, 0.01},
          {"gloss, thickness", gloss, Thickness, 0.01},
          {"gloss, reflectance", gloss, Reflectance, 0.01}};
}

Rgb MeanOf(const SceneDescription& scene) {
  TestRender options;
  options.spp = 128;
  const Rendered render = RenderDescription(scene, options);
  CHECK(render.result.health.Total() == 0);
  return ImageMean(render.film);
}

double Relative(Rgb a, Rgb b) {
  double worst = 0;
  for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(a[c] / b[c] - 1));
  return worst;
}

SceneDescription Textured(const TexturedCase& c) {
  SceneDescription scene = Plate(c.material, 6);
  c.textured(scene, scene.materials[0]);
  return scene;
}

// v00, v01, v10, v11 of the surface's own coordinates.
Index AddBilinear(SceneDescription& scene, Rgb v00, Rgb v01, Rgb v10, Rgb v11) {
  Texture t;
  t.kind = TextureKind::kBilinear;
  const Rgb values[] = {v00, v01, v10, v11};
  for (int i = 0; i < 4; ++i) t.corners[i].constant = values[i];
  scene.textures.push_back(t);
  return static_cast<Index>(scene.textures.size()) - 1;
}

void VaryEverything(SceneDescription& scene, Material& m) {
  m.reflectance.texture =
      AddBilinear(scene, {.7, .6, .5}, {.2, .3, .2}, {.4, .4, .6}, {.8, .8, .7});
  m.transmittance.texture =
      AddBilinear(scene, {.1, .2, .3}, {.3, .3, .3}, {.6, .1, .2}, {.2, .5, .2});
  m.eta.texture = AddBilinear(scene, {.2, .9, 1}, {1, 1, 1}, {.4, .5, .6}, {2, 2, 1});
  m.k.texture = AddBilinear(scene, {4, 2, 2}, {2, 2, 2}, {3, 3, 1}, {1, 2, 4});
  m.uroughness.texture = m.vroughness.texture =
      AddBilinear(scene, Grey(.15), Grey(.3), Grey(.5), Grey(.7));
  m.conductor_uroughness.texture =
      AddBilinear(scene, Grey(.5), Grey(.2), Grey(.3), Grey(.2));
  m.conductor_vroughness.texture =
      AddBilinear(scene, Grey(.2), Grey(.4), Grey(.2), Grey(.6));
  m.thickness_texture = AddBilinear(scene, Grey(0), Grey(.1), Grey(.3), Grey(.05));
}

SceneDescription Varied(MaterialKind kind, bool has_reflectance = false) {
  Material m = Base(kind);
  m.has_reflectance = has_reflectance;
  SceneDescription scene = Plate(m, 6);
  VaryEverything(scene, scene.materials[0]);
  return scene;
}

void CheckVaried(MaterialKind kind, bool has_reflectance, double tolerance) {
  stat::CheckSame(
      CompareWithReference(Varied(kind, has_reflectance), 8192, 2000, tolerance), 0.15,
      fmt::format("{}", static_cast<int>(kind)));
}

}  // namespace

TEST_CASE("a texture with a single value renders like the constant", "[textured]") {
  for (const TexturedCase& c : Cases()) {
    const Rgb constant = MeanOf(Plate(c.material, 6)), textured = MeanOf(Textured(c));
    INFO(c.name << ": " << textured.x << ", " << constant.x);
    CHECK(Relative(textured, constant) < c.tolerance);
  }
}

TEST_CASE("another value in a texture is detected", "[textured]") {
  for (const TexturedCase& c : Cases()) {
    SceneDescription other = Textured(c);
    for (Texture& t : other.textures) t.tex1.constant = t.tex2.constant *= 3;
    INFO(c.name);
    CHECK(Relative(MeanOf(other), MeanOf(Plate(c.material, 6))) > c.tolerance);
  }
}

TEST_CASE("textured metals and leaves agree with the reference", "[textured]") {
  CheckVaried(MaterialKind::kDiffuseTransmission, false, kFloatTolerance);
  CheckVaried(MaterialKind::kConductor, false, kFloatTolerance);
  CheckVaried(MaterialKind::kConductor, true, kFloatTolerance);
}

TEST_CASE("textured coats agree with the reference", "[textured]") {
  // As with constants: the inner bounces are summed in closed form, within 3 %.
  CheckVaried(MaterialKind::kCoatedDiffuse, false, 0.03);
  CheckVaried(MaterialKind::kCoatedConductor, false, kFloatTolerance);
  CheckVaried(MaterialKind::kCoatedConductor, true, kFloatTolerance);
}

TEST_CASE("a white textured coat conserves energy", "[textured]") {
  // In a furnace it shows what the constant coat shows, at and between the nodes of its
  // tables; the constant coat's losses are tested in tests/kernels/shade/limits_test.cc.
  const auto check = [](double roughness, double thickness, Member member) {
    Material m = Base(MaterialKind::kCoatedDiffuse);
    m.reflectance.constant = {1, 1, 1};
    m.uroughness.constant = m.vroughness.constant = roughness;
    m.thickness = thickness;
    SceneDescription textured = Furnace(m, 2, 4);
    member(textured, textured.materials[0]);
    const double shown = MeanOf(textured).x, wanted = MeanOf(Furnace(m, 2, 4)).x;
    INFO("roughness " << roughness << ", thickness " << thickness);
    CHECK(shown == Approx(wanted).epsilon(0.01));
    CHECK(shown < 1.01);
  };
  for (double roughness : {0.02, 0.11, 0.4, 0.93, 3.0}) check(roughness, 0, Roughness);
  for (double thickness : {0.0, 0.02, 0.07, 0.3, 0.9}) check(0.3, thickness, Thickness);
  for (double thickness : {0.01, 0.09}) check(0, thickness, Thickness);
}

TEST_CASE("textures by position agree with the reference in a render", "[textured]") {
  Material m = Base(MaterialKind::kDiffuse);
  SceneDescription scene = Plate(m, 6);
  Texture marble;
  marble.kind = TextureKind::kMarble;
  marble.noise_scale = 3;
  marble.texture_from_world = Transform::Rotate(20, {0, 1, 1});
  Texture fbm = marble, by_direction = marble, planar = marble;
  fbm.kind = TextureKind::kFbm;
  by_direction.kind = TextureKind::kDirectionMix;
  by_direction.direction = Normalize(Vec3d{0, -1, 1});
  by_direction.tex1.texture = 0;
  by_direction.tex2.constant = {0.1, 0.7, 0.3};
  planar.kind = TextureKind::kBilinear;
  planar.mapping.kind = MappingKind::kPlanar;
  planar.corners[1].constant = planar.corners[2].constant = {0.5, 0.2, 0.1};
  Material coat = Base(MaterialKind::kConductor);
  coat.uroughness.texture = coat.vroughness.texture = 4;
  Texture wrinkled = fbm;
  wrinkled.kind = TextureKind::kWrinkled;
  scene.textures = {marble, fbm, by_direction, planar, wrinkled};
  scene.materials[0].reflectance.texture = 2;
  Material mix;
  mix.kind = MaterialKind::kMix;
  scene.materials.push_back(coat);
  mix.mix[0] = 0;
  mix.mix[1] = static_cast<Index>(scene.materials.size()) - 1;
  mix.mix_amount.texture = 3;
  scene.materials.push_back(mix);
  scene.shapes[0].material = static_cast<Index>(scene.materials.size()) - 1;
  stat::CheckSame(CompareWithReference(scene, 8192, 2000), 0.1);
}

TEST_CASE("columns of textured layers exist with their features only", "[textured]") {
  const auto plan_of = [](const SceneDescription& scene) {
    return MakePlan(PrepareScene(scene, {}), {});
  };
  const auto lives = [](const Plan& plan, Field field) {
    const auto& live = plan.live_fields;
    return std::find(live.begin(), live.end(), field) != live.end();
  };
  const std::vector<TexturedCase> cases = Cases();
  for (const TexturedCase& c : cases) {
    const Plan plain = plan_of(Plate(c.material, 6));
    for (Field field : {Field::coat_thickness, Field::alpha2_0, Field::alpha2_1,
                        Field::color1_r, Field::color0_r, Field::alpha_x}) {
      INFO(c.name << ", " << FieldName(field));
      CHECK_FALSE(lives(plain, field));
    }
  }
  const auto textured = [&](int i) { return plan_of(Textured(cases[i])); };
  CHECK(lives(textured(0), Field::color1_r));
  CHECK_FALSE(lives(textured(0), Field::coat_thickness));
  CHECK(lives(textured(7), Field::alpha2_0));
  CHECK(lives(textured(8), Field::coat_thickness));
}

}  // namespace lanelight::test

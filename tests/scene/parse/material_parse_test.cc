// Materials and textures.
#include <catch2/catch.hpp>

#include "src/base/image/spectrum.h"
#include "tests/scene/parse/parse_text.h"

namespace lanelight {
namespace {

Material ParseMaterial(const std::string& text) {
  return ParseWorld("Material " + text).materials.back();
}

TEST_CASE("diffuse and its scattering models", "[parse]") {
  const Material material =
      ParseMaterial("\"diffuse\" \"rgb reflectance\" [ 0.1 0.2 0.3 ]");
  CHECK(material.kind == MaterialKind::kDiffuse);
  CHECK(material.reflectance.constant == Rgb{0.1, 0.2, 0.3});
  CHECK(material.scattering == Scattering::kLambertian);
  CHECK(ParseMaterial("\"diffuse\" \"string scattering\" \"uniform\"").scattering ==
        Scattering::kUniform);
  CHECK(ParseMaterial("\"diffuse\" \"string scattering\" \"insphere\"").scattering ==
        Scattering::kInSphere);
}

TEST_CASE("conductors", "[parse]") {
  ComplexIor copper, silver;
  REQUIRE(NamedMetal("Cu", &copper));
  REQUIRE(NamedMetal("Ag", &silver));
  const Material plain = ParseMaterial("\"conductor\"");
  CHECK(plain.kind == MaterialKind::kConductor);
  CHECK(plain.eta.constant == copper.eta);
  CHECK(plain.k.constant == copper.k);
  CHECK(plain.uroughness.constant == 0);
  CHECK(plain.remap_roughness);
  const Material named = ParseMaterial(
      "\"conductor\" \"spectrum eta\" \"metal-Ag-eta\" \"spectrum k\" \"metal-Ag-k\" "
      "\"float uroughness\" 0.1 \"float vroughness\" 0.2 \"bool remaproughness\" false");
  CHECK(named.eta.constant == silver.eta);
  CHECK(named.k.constant == silver.k);
  CHECK(named.uroughness.constant == 0.1);
  CHECK(named.vroughness.constant == 0.2);
  CHECK_FALSE(named.remap_roughness);
  const Material rgb = ParseMaterial(
      "\"conductor\" \"rgb eta\" [ 2 3 4 ] \"rgb k\" [ 5 6 7 ] \"float roughness\" 0.3");
  CHECK(rgb.eta.constant == Rgb{2, 3, 4});
  CHECK(rgb.k.constant == Rgb{5, 6, 7});
  CHECK(rgb.uroughness.constant == 0.3);
  CHECK(rgb.vroughness.constant == 0.3);
  const Material tinted =
      ParseMaterial("\"conductor\" \"rgb reflectance\" [ 0.9 0.8 0.7 ]");
  CHECK(tinted.has_reflectance);
  CHECK(tinted.reflectance.constant == Rgb{0.9, 0.8, 0.7});
  const Material sampled = ParseMaterial(
      "\"conductor\" \"spectrum eta\" [ 360 2 830 2 ] \"spectrum k\" [ 360 3 830 3 ]");
  CHECK(sampled.eta.constant.y == Approx(2).epsilon(1e-3));
  CHECK(sampled.k.constant.y == Approx(3).epsilon(1e-3));
}

TEST_CASE("dielectrics", "[parse]") {
  CHECK(ParseMaterial("\"dielectric\"").interface_eta == 1.5);
  CHECK(ParseMaterial("\"thindielectric\" \"float eta\" 1.3").interface_eta == 1.3);
  double bk7 = 0;
  REQUIRE(NamedGlassEta("glass-BK7", &bk7));
  const SceneDescription scene =
      ParseWorld("Material \"dielectric\" \"spectrum eta\" \"glass-BK7\"");
  CHECK(scene.materials[0].interface_eta == bk7);
  REQUIRE(scene.materials[0].dispersion != nullptr);
  CHECK((*scene.materials[0].dispersion)(587.6) == Approx(bk7).margin(1e-5));
  CHECK(HasNote(ParseWorld("Material \"coateddiffuse\" \"spectrum eta\" \"glass-BK7\""),
                "not modelled"));
  const Material line =
      ParseMaterial("\"dielectric\" \"spectrum eta\" [ 487.6 1.6 687.6 1.4 ]");
  CHECK(line.interface_eta == Approx(1.5));
}

TEST_CASE("coats", "[parse]") {
  const Material diffuse = ParseMaterial(
      "\"coateddiffuse\" \"rgb reflectance\" [ 1 1 1 ] \"float roughness\" 0.1 "
      "\"float thickness\" 0.02 \"float g\" 0.5 \"rgb albedo\" [ 0.1 0.2 0.3 ] "
      "\"integer maxdepth\" 7 \"integer nsamples\" 3 \"float eta\" 1.4");
  CHECK(diffuse.kind == MaterialKind::kCoatedDiffuse);
  CHECK(diffuse.interface_eta == 1.4);
  CHECK(diffuse.vroughness.constant == 0.1);
  CHECK(diffuse.thickness == 0.02);
  CHECK(diffuse.coat_g.constant == 0.5);
  CHECK(diffuse.coat_albedo.constant == Rgb{0.1, 0.2, 0.3});
  CHECK(diffuse.coat_max_depth == 7);
  const Material conductor = ParseMaterial(
      "\"coatedconductor\" \"float interface.roughness\" 0.1 "
      "\"float conductor.uroughness\" 0.2 \"float conductor.vroughness\" 0.3 "
      "\"float interface.eta\" 1.7 \"rgb conductor.eta\" [ 1 2 3 ] "
      "\"rgb conductor.k\" [ 4 5 6 ]");
  CHECK(conductor.kind == MaterialKind::kCoatedConductor);
  CHECK(conductor.uroughness.constant == 0.1);
  CHECK(conductor.conductor_uroughness.constant == 0.2);
  CHECK(conductor.conductor_vroughness.constant == 0.3);
  CHECK(conductor.interface_eta == 1.7);
  CHECK(conductor.k.constant == Rgb{4, 5, 6});
  CHECK(ParseMaterial("\"coatedconductor\"").coat_max_depth == 10);
}

TEST_CASE("the medium in a coat: what can be textured", "[parse]") {
  const std::string textures = R"(
    Texture "t" "spectrum" "constant" "rgb value" [ 0.2 0.4 0.6 ]
    Texture "f" "float" "constant" "float value" 0.5
    Material )";
  const auto material = [&](const std::string& text) {
    return ParseWorld(textures + text).materials[0];
  };
  for (const std::string kind : {"\"coateddiffuse\"", "\"coatedconductor\""}) {
    const Material m = material(kind + " \"texture albedo\" \"t\" \"texture g\" \"f\"");
    CHECK(m.coat_albedo.texture == 0);
    CHECK(m.coat_g.texture == 1);
  }
}

TEST_CASE("diffuse transmission keeps its scale, which comes before the clamp",
          "[parse]") {
  const Material plain = ParseMaterial("\"diffusetransmission\"");
  CHECK(plain.reflectance.constant == Rgb{0.25, 0.25, 0.25});
  CHECK(plain.transmittance.constant == Rgb{0.25, 0.25, 0.25});
  CHECK(plain.scale == 1);
  const Material scaled = ParseMaterial(
      "\"diffusetransmission\" \"spectrum reflectance\" [ 400 0.2 700 0.4 ] "
      "\"float scale\" 1.5");
  CHECK(scaled.scale == 1.5);
  CHECK(scaled.reflectance.spectrum != nullptr);
}

TEST_CASE("mix, interface, named materials", "[parse]") {
  const SceneDescription scene = ParseWorld(R"(
    MakeNamedMaterial "a" "string type" "diffuse"
    MakeNamedMaterial "b" "string type" "conductor"
    MakeNamedMaterial "m" "string type" "mix" "string materials" [ "a" "b" ]
      "float amount" 0.25
    NamedMaterial "m" Shape "sphere"
    Material "interface" AreaLightSource "diffuse" Shape "sphere"
    Material "none" Shape "sphere"
    Texture "bumps" "float" "checkerboard"
    MakeNamedMaterial "rough" "string type" "conductor" "texture displacement" "bumps"
    NamedMaterial "rough" Shape "sphere"
    Material "diffuse" "string normalmap" "n.png" "texture displacement" "bumps"
    Shape "sphere"
    MakeNamedMaterial "n" "string type" "mix" "string materials" [ "a" "b" ]
      "texture displacement" "bumps")");
  const Material& mix = scene.materials[scene.shapes[0].material];
  CHECK(mix.kind == MaterialKind::kMix);
  CHECK(mix.name == "m");
  CHECK(mix.mix[0] == 0);
  CHECK(mix.mix[1] == 1);
  CHECK(mix.mix_amount.constant == 0.25);
  CHECK(scene.materials[scene.shapes[1].material].kind == MaterialKind::kInterface);
  CHECK(scene.shapes[1].area_light == kNone);
  CHECK(scene.materials[scene.shapes[2].material].kind == MaterialKind::kInterface);
  const Material& rough = scene.materials[scene.shapes[3].material];
  CHECK(rough.displacement.texture == 0);
  CHECK(rough.normal_map.empty());
  const Material& mapped = scene.materials[scene.shapes[4].material];
  CHECK(mapped.normal_map.ends_with("n.png"));
  CHECK(HasNote(scene, "the normal map counts"));
  CHECK(HasNote(scene, "the bump and normal maps of the mixed materials are used"));
}

TEST_CASE("textures", "[parse]") {
  const SceneDescription scene = ParseWorld(R"(
    Texture "half" "float" "constant" "float value" 0.5
    Texture "red" "spectrum" "constant" "rgb value" [ 1 0 0 ]
    Texture "dark" "spectrum" "scale" "texture tex" "red" "texture scale" "half"
    Texture "blend" "spectrum" "mix" "texture tex2" "dark" "float amount" 0.3
    Texture "board" "spectrum" "checkerboard" "float uscale" 20 "float vdelta" 0.5
      "rgb tex2" [ 0.1 0.2 0.3 ]
    Texture "half" "spectrum" "constant"
    Material "diffuse" "texture reflectance" "board"
    Material "conductor" "texture roughness" "half"
    Shape "sphere" "texture alpha" "half")");
  REQUIRE(scene.textures.size() == 6);
  CHECK(scene.textures[0].is_float);
  CHECK(scene.textures[0].value == Rgb{0.5, 0.5, 0.5});
  const Texture& dark = scene.textures[2];
  CHECK(dark.tex1.texture == 1);
  CHECK(dark.amount.texture == 0);
  const Texture& blend = scene.textures[3];
  CHECK(blend.tex1.constant == Rgb{0, 0, 0});
  CHECK(blend.tex2.texture == 2);
  CHECK(blend.amount.constant == 0.3);
  const Texture& board = scene.textures[4];
  CHECK(board.tex1.constant == Rgb{1, 1, 1});
  CHECK(board.tex2.constant == Rgb{0.1, 0.2, 0.3});
  CHECK(board.mapping.su == 20);
  CHECK(board.mapping.dv == 0.5);
  CHECK(scene.materials[0].reflectance.texture == 4);
  CHECK(scene.materials[1].uroughness.texture == 0);
  CHECK(scene.materials[1].vroughness.texture == 0);
  CHECK(scene.shapes[0].alpha.texture == 0);
}

TEST_CASE("image textures", "[parse]") {
  const SceneDescription scene = ParseWorld(R"(
    Texture "a" "spectrum" "imagemap" "string filename" "pic/a.png"
    Texture "b" "float" "imagemap" "string filename" "b.tga" "string wrap" "black"
      "string filter" "trilinear" "string encoding" "gamma 1.8" "float scale" 2
      "bool invert" true "float maxanisotropy" 4
    Texture "c" "spectrum" "imagemap" "string filename" "c.png" "string filter" "point"
      "string encoding" "linear"
    Texture "d" "spectrum" "imagemap" "string filename" "d.png" "string filter" "ewa")");
  CHECK(scene.textures[0].path == "./pic/a.png");
  CHECK(scene.textures[0].encoding == Encoding::kSrgb);
  CHECK(scene.textures[0].wrap == WrapMode::kRepeat);
  CHECK(scene.textures[0].bilinear);
  const Texture& b = scene.textures[1];
  CHECK(b.wrap == WrapMode::kBlack);
  CHECK(b.encoding == Encoding::kGamma);
  CHECK(b.gamma == 1.8);
  CHECK(b.scale == 2);
  CHECK(b.invert);
  CHECK_FALSE(scene.textures[2].bilinear);
  CHECK(scene.textures[2].encoding == Encoding::kLinear);
  CHECK(scene.textures[0].filter == ImageFilter::kBilinear);
  CHECK(b.filter == ImageFilter::kTrilinear);
  CHECK(b.max_anisotropy == 4);
  CHECK(scene.textures[2].filter == ImageFilter::kPoint);
  CHECK(scene.textures[3].filter == ImageFilter::kEwa);
  CHECK(scene.notes.empty());
}

TEST_CASE("subsurface materials", "[parse]") {
  const auto inside = [](const std::string& text) {
    const SceneDescription scene =
        ParseWorld("Material \"subsurface\" " + text + " Shape \"sphere\"");
    REQUIRE(scene.materials[0].kind == MaterialKind::kDielectric);
    REQUIRE(scene.shapes[0].media.inside == scene.materials[0].inside);
    REQUIRE(scene.shapes[0].media.outside == kNone);
    const Medium& medium = scene.media.at(std::size_t(scene.materials[0].inside));
    REQUIRE(medium.in_material);
    REQUIRE(medium.eta == scene.materials[0].interface_eta);
    return medium;
  };
  CHECK(inside("").sigma_s == Rgb{2.55, 3.21, 3.77});
  CHECK(inside("").eta == 1.33);
  const Medium skin = inside("\"string name\" \"Skin1\" \"float scale\" 10");
  CHECK(skin.sigma_s.x == Approx(7.4));
  CHECK(skin.sigma_a.z == Approx(4.8));
  CHECK(inside("\"string name\" \"Head & Shoulders Shampoo\"").sigma_a.y == 0.15688);
  const Medium own = inside(
      "\"rgb sigma_a\" [ 1 2 3 ] \"rgb sigma_s\" [ 4 5 6 ] "
      "\"float g\" 0.5 \"float eta\" 1.5 \"float scale\" 2");
  CHECK(own.sigma_a == Rgb{2, 4, 6});
  CHECK(own.sigma_s == Rgb{8, 10, 12});
  CHECK(own.g == 0.5);
  CHECK(own.eta == 1.5);
  const Medium seen = inside(
      "\"rgb reflectance\" [ 0.1 0.2 0.3 ] "
      "\"rgb mfp\" [ 1 2 4 ] \"float scale\" 0.5");
  CHECK(seen.by_reflectance);
  CHECK(seen.reflectance.constant == Rgb{0.1, 0.2, 0.3});
  CHECK(seen.sigma_s == Rgb{2, 1, 0.5});
  CHECK(seen.sigma_a == Rgb{});
}

TEST_CASE("invalid subsurface materials are refused", "[parse]") {
  const auto error = [](const std::string& text) {
    return WorldError("Material \"subsurface\" " + text);
  };
  using Catch::Contains;
  CHECK_THAT(error("\"string name\" \"Skin\""), Contains("unknown named medium"));
  CHECK_THAT(error("\"string name\" \"Skin\""), Contains("\"Skin2\""));
  CHECK_THAT(error("\"string name\" \"Skin1\" \"rgb sigma_a\" [ 1 1 1 ]"),
             Contains("\"name\" and \"sigma_a\" exclude each other"));
  CHECK_THAT(error("\"rgb reflectance\" [ 1 1 1 ] \"rgb sigma_s\" [ 1 1 1 ]"),
             Contains("exclude each other"));
  CHECK_THAT(error("\"rgb reflectance\" [ 1 1 1 ] \"rgb mfp\" [ 1 0 1 ]"),
             Contains("it must be positive"));
  CHECK_THAT(WorldError("MakeNamedMaterial \"s\" \"string type\" \"subsurface\" "
                        "Material \"mix\" \"string materials\" [ \"s\" \"s\" ]"),
             Contains("mixing a \"subsurface\" material is not supported"));
}

TEST_CASE("a subsurface material's medium replaces the interior medium", "[parse]") {
  const SceneDescription scene = ParseWorld(R"(
    MakeNamedMedium "fog" "string type" "homogeneous"
    MakeNamedMedium "ink" "string type" "homogeneous"
    MediumInterface "ink" "fog"
    Material "subsurface"
    Shape "sphere"
    MediumInterface "fog" "fog"
    Shape "sphere")");
  CHECK(scene.shapes[0].media.inside == 2);
  CHECK(scene.shapes[0].media.outside == 0);
  CHECK(scene.shapes[1].media.inside == 2);
  CHECK(scene.shapes[1].media.outside == 0);
  REQUIRE(scene.notes.size() == 2);
  CHECK_THAT(scene.notes[1].message,
             Catch::Contains("the material's own medium replaces \"ink\" inside"));
}

TEST_CASE("invalid measured materials are refused", "[parse]") {
  using Catch::Contains;
  const std::string material = "Material \"measured\" ";
  const std::string named = material + "\"string filename\" \"no.bsdf\"";
  CHECK_THAT(WorldError(material), Contains("has no \"string filename\""));
  CHECK_THAT(WorldError(named), Contains("reading files is disabled here"));
  CHECK_THROWS_WITH(ParseSceneText("WorldBegin " + named, "test.pbrt", "."),
                    Contains("test.pbrt:1:") && Contains("no.bsdf"));
}

TEST_CASE("a black body may be a reflectance", "[parse]") {
  const SceneDescription scene =
      ParseWorld("Material \"diffuse\" \"blackbody reflectance\" 6000 Shape \"sphere\"");
  const ColorValue& color = scene.materials.at(0).reflectance;
  REQUIRE(color.spectrum != nullptr);
  // 1 where it emits most, at 2 897 772 nm / 6000.
  CHECK((*color.spectrum)(482.96) == Approx(1).epsilon(1e-6));
  CHECK((*color.spectrum)(700) == Approx(0.7481).epsilon(1e-3));
  // pbrt-v4 renders 0.844, 0.973, 0.989.
  CHECK(color.constant.x == Approx(0.844).epsilon(0.005));
  CHECK(color.constant.y == Approx(0.973).epsilon(0.005));
  CHECK(color.constant.z == Approx(0.989).epsilon(0.005));
}

TEST_CASE("the index of a dielectric may be a colour or any spectrum", "[parse]") {
  const auto glass = [](const std::string& eta) {
    return ParseWorld("Material \"dielectric\" " + eta).materials.at(0);
  };
  const Material grey = glass("\"rgb eta\" [ 1.5 1.5 1.5 ]");
  CHECK(grey.interface_eta == 1.5);
  CHECK(grey.dispersion == nullptr);
  const Material tinted = glass("\"rgb eta\" [ 1.4 1.5 1.7 ]");
  REQUIRE(tinted.dispersion != nullptr);
  CHECK((*tinted.dispersion)(630) < 1.45);
  CHECK((*tinted.dispersion)(450) > 1.6);
  CHECK(tinted.interface_eta == (*tinted.dispersion)(587.6));
  CHECK(glass("\"spectrum eta\" \"metal-MgO-eta\"").interface_eta ==
        Approx(1.7374).epsilon(1e-3));
  CHECK(glass("\"blackbody eta\" 5000").interface_eta < 1);
  const SceneDescription coat = ParseWorld(
      "Material \"coateddiffuse\" \"rgb eta\" [ 1.4 1.5 1.7 ]\n"
      "Material \"coatedconductor\" \"rgb interface.eta\" [ 1.3 1.3 1.3 ]");
  CHECK(coat.materials.at(0).interface_eta == Approx(tinted.interface_eta));
  CHECK(HasNote(coat, "dispersion of this material is not modelled"));
  CHECK(coat.materials.at(1).interface_eta == 1.3);
}

}  // namespace
}  // namespace lanelight

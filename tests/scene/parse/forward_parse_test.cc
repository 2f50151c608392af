// Names that are used before the file defines them.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "tests/scene/parse/parse_text.h"

namespace lanelight {
namespace {

const std::string kGlass = "MakeNamedMaterial \"glass\" \"string type\" \"dielectric\"\n";
const std::string kNumber = "Texture \"t\" \"float\" \"constant\" \"float value\" 0.25\n";
const std::string kColor =
    "Texture \"t\" \"spectrum\" \"constant\" \"rgb value\" [ 0.1 0.2 0.3 ]\n";

const Material& MaterialOf(const SceneDescription& scene, std::size_t shape = 0) {
  return scene.materials.at(static_cast<std::size_t>(scene.shapes.at(shape).material));
}

TEST_CASE("materials may be used before they are defined", "[parse]") {
  const SceneDescription scene = ParseWorld(R"(
    AttributeBegin Translate 1 0 0
    NamedMaterial "glass" Shape "sphere" "float radius" 3
    ObjectBegin "o" Shape "disk" ObjectEnd
    AttributeEnd
    Shape "sphere")" + kGlass);
  REQUIRE(scene.shapes.size() == 2);
  const Shape& early = scene.shapes[1];  // it waited
  CHECK(MaterialOf(scene, 1).kind == MaterialKind::kDielectric);
  CHECK(early.radius == 3);
  CHECK(early.world_from_object.Point({0, 0, 0}) == Vec3d{1, 0, 0});
  CHECK(MaterialOf(scene, 0).kind == MaterialKind::kDiffuse);
  REQUIRE(scene.objects.at(0).shapes.size() == 1);
  CHECK(scene.objects[0].shapes[0].material == early.material);
}

TEST_CASE("textures may be used before they are defined", "[parse]") {
  const SceneDescription scene = ParseWorld(R"(
    Texture "scaled" "spectrum" "scale" "texture tex" "t" "float scale" 2
    Material "diffuse" "texture reflectance" "scaled" "texture displacement" "t"
    Shape "sphere" "texture alpha" "t"
    MakeNamedMaterial "m" "string type" "conductor" "texture roughness" "t"
    NamedMaterial "m" Shape "disk"
    )" + kColor + kNumber);
  REQUIRE(scene.shapes.size() == 2);
  REQUIRE(scene.textures.size() == 3);
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    CHECK(scene.textures[i].tex1.texture < static_cast<Index>(i));
  }
  const bool sphere_first = scene.shapes[0].kind == ShapeKind::kSphere;
  const std::size_t sphere = sphere_first ? 0 : 1;
  const Material& diffuse = MaterialOf(scene, sphere);
  const auto texture = [&](Index i) {
    return scene.textures.at(static_cast<std::size_t>(i));
  };
  CHECK(texture(diffuse.reflectance.texture).name == "scaled");
  CHECK(texture(diffuse.displacement.texture).is_float);
  CHECK(texture(scene.shapes[sphere].alpha.texture).is_float);
  CHECK(texture(MaterialOf(scene, 1 - sphere).uroughness.texture).value.x == 0.25);
}

TEST_CASE("float and spectrum textures have separate names", "[parse]") {
  const SceneDescription scene = ParseWorld(
      kNumber + "Material \"diffuse\" \"texture reflectance\" \"t\" Shape \"sphere\"\n" +
      kColor);
  const Index texture = MaterialOf(scene).reflectance.texture;
  CHECK_FALSE(scene.textures.at(static_cast<std::size_t>(texture)).is_float);
}

TEST_CASE("materials of a mix may be defined after it", "[parse]") {
  const SceneDescription scene = ParseWorld(R"(
    Material "mix" "string materials" [ "glass" "b" ] "texture amount" "t"
    Shape "sphere"
    MakeNamedMaterial "b" "string type" "mix" "string materials" [ "glass" "glass" ]
    )" + kNumber + kGlass);
  REQUIRE(scene.shapes.size() == 1);
  const Material& mix = MaterialOf(scene);
  REQUIRE(mix.kind == MaterialKind::kMix);
  CHECK(scene.materials.at(static_cast<std::size_t>(mix.mix[0])).name == "glass");
  CHECK(scene.materials.at(static_cast<std::size_t>(mix.mix[1])).name == "b");
}

TEST_CASE("media and objects may be used before they are defined", "[parse]") {
  const SceneDescription scene = ParseText(R"(
    MediumInterface "fog" "fog" Camera "perspective"
    WorldBegin
    ObjectInstance "tree"
    MediumInterface "smoke" "fog" Shape "sphere"
    ObjectBegin "tree" Shape "disk" ObjectEnd
    MakeNamedMedium "smoke" "string type" "homogeneous" "float g" 0.5
    MakeNamedMedium "fog" "string type" "homogeneous" "float g" 0.25)");
  const auto medium = [&](Index i) {
    return scene.media.at(static_cast<std::size_t>(i));
  };
  CHECK(medium(scene.camera.medium).g == 0.25);
  CHECK(medium(scene.shapes.at(0).media.inside).g == 0.5);
  REQUIRE(scene.instances.size() == 1);
  CHECK(scene.objects.at(0).shapes.size() == 1);
}

TEST_CASE("a shape that moves in an object may be placed before it", "[parse]") {
  const SceneDescription scene = ParseWorld(R"(
    ObjectInstance "o"
    ObjectBegin "o" ActiveTransform EndTime Translate 1 0 0
    NamedMaterial "glass" Shape "sphere" ObjectEnd )" +
                                            kGlass);
  REQUIRE(scene.instances.size() == 2);
  CHECK(scene.instances[1].end != nullptr);
}

TEST_CASE("names without definition are errors only where they are used", "[parse]") {
  CHECK(WorldError("NamedMaterial \"x\"").empty());
  CHECK(HasWarning(ParseWorld("MediumInterface \"x\" \"\""), "medium \"x\" is not"));
  CHECK(WorldError("Shape \"sphere\" NamedMaterial \"x\" Shape \"sphere\"") ==
        "test.pbrt:2:30: error: unknown named material \"x\": no named material is "
        "defined");
  CHECK(WorldError("Material \"diffuse\" \"texture reflectance\" \"x\"")
            .ends_with("unknown spectrum texture \"x\": no spectrum texture is "
                       "defined"));
}

TEST_CASE("notes of deferred statements are printed once", "[parse]") {
  const SceneDescription scene = ParseWorld(
      "Material \"none\" \"texture displacement\" \"t\" Shape \"sphere\"\n"
      "Material \"mix\" \"string materials\" [ \"glass\" \"glass\" ] \"texture amount\" "
      "\"t\"\n\"texture displacement\" \"t\" Shape \"sphere\"\n" +
      kGlass + kNumber);
  std::set<std::string> different;
  for (const Note& note : scene.notes) different.insert(note.message);
  CHECK(different.size() == scene.notes.size());
}

TEST_CASE("circular definitions are errors", "[parse]") {
  const std::string loop =
      "Texture \"a\" \"float\" \"scale\" \"texture tex\" \"b\"\n"
      "Texture \"b\" \"float\" \"scale\" \"texture tex\" \"a\"\n";
  CHECK(WorldError(loop).find("is defined by itself") != std::string::npos);
  CHECK(WorldError("Material \"diffuse\" \"texture displacement\" \"a\"\n" + loop)
            .find("is defined by itself") != std::string::npos);
  CHECK(WorldError(kGlass + kGlass).find("defined twice") != std::string::npos);
  const std::string waits = "Texture \"w\" \"float\" \"scale\" \"texture tex\" \"t\"\n";
  CHECK(WorldError(waits + waits + kNumber).find("defined twice") != std::string::npos);
}

TEST_CASE("long chains of names are read in order and backwards", "[parse]") {
  constexpr int kLinks = 20000;
  std::string text = "Material \"diffuse\" \"texture displacement\" \"0\" Shape \"disk\"";
  for (int i = 0; i < kLinks; ++i) {
    text += fmt::format("\nTexture \"{}\" \"float\" \"scale\" \"texture tex\" \"{}\"", i,
                        i + 1);
  }
  text += fmt::format("\nTexture \"{}\" \"float\" \"constant\"", kLinks);
  CHECK(ParseWorld(text).textures.size() == kLinks + 1);
}

}  // namespace
}  // namespace lanelight

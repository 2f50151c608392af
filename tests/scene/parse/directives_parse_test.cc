// Transforms, blocks, objects, attributes, includes.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>

#include "tests/scene/parse/parse_text.h"
#include "tests/support/input_error.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

Vec3d Origin(const Shape& shape) { return shape.world_from_object.Point({0, 0, 0}); }

bool Near(Vec3d a, Vec3d b) { return Length(a - b) < 1e-12; }

TEST_CASE("transforms multiply from the right", "[parse]") {
  const SceneDescription scene = ParseWorld(R"(
    Translate 1 2 3  Rotate 90 0 0 1  Scale 2 2 2  Shape "sphere"
    Identity  Shape "sphere"
    Transform [ 0 1 0 0  -1 0 0 0  0 0 1 0  5 6 7 1 ]  Shape "sphere"
    ConcatTransform [ 1 0 0 0  0 1 0 0  0 0 1 0  1 0 0 1 ]  Shape "sphere")");
  REQUIRE(scene.shapes.size() == 4);
  CHECK(Near(scene.shapes[0].world_from_object.Point({1, 0, 0}), {1, 4, 3}));
  CHECK(scene.shapes[1].world_from_object == Transform());
  // Columns: the x axis becomes +y, the y axis -x.
  CHECK(Near(scene.shapes[2].world_from_object.Point({1, 0, 0}), {5, 7, 7}));
  CHECK(Near(Origin(scene.shapes[3]), {5, 7, 7}));
}

TEST_CASE("the camera is the inverse of its transform", "[parse]") {
  const SceneDescription scene = ParseText(R"(
    LookAt 1 2 3  1 2 10  0 1 0
    Camera "perspective"
    WorldBegin
    CoordSysTransform "camera"  Translate 0 0 5  Shape "sphere"
    CoordSysTransform "world"  Shape "sphere")");
  const Transform& camera = scene.camera.world_from_camera;
  CHECK(Near(camera.Point({0, 0, 0}), {1, 2, 3}));
  CHECK(Near(camera.Vector({0, 0, 1}), {0, 0, 1}));
  CHECK(Near(camera.Vector({0, 1, 0}), {0, 1, 0}));
  CHECK(Near(Origin(scene.shapes[0]), {1, 2, 8}));
  CHECK(Near(Origin(scene.shapes[1]), {0, 0, 0}));
}

TEST_CASE("world begin resets the transform", "[parse]") {
  const SceneDescription scene = ParseText("Translate 1 0 0 WorldBegin Shape \"sphere\"");
  CHECK(scene.shapes[0].world_from_object == Transform());
}

TEST_CASE("look-at far away and with tiny or huge vectors", "[parse]") {
  const SceneDescription scene = ParseText(
      "LookAt 1e7 0 0  10000001 0 0  0 1e-200 0 Camera \"perspective\" WorldBegin");
  CHECK(Near(scene.camera.world_from_camera.Vector({0, 0, 1}), {1, 0, 0}));
  CHECK(scene.camera.world_from_camera.Point({0, 0, 0}).x == 1e7);
}

TEST_CASE("blocks save and restore the graphics state", "[parse]") {
  const SceneDescription scene = ParseWorld(R"(
    Material "conductor"
    AttributeBegin
      Translate 1 0 0  ReverseOrientation  Material "dielectric"
      AreaLightSource "diffuse"
      Shape "sphere"
    AttributeEnd
    Shape "sphere"
    TransformBegin Translate 2 0 0 ReverseOrientation Shape "sphere" TransformEnd
    Shape "sphere")");
  REQUIRE(scene.shapes.size() == 4);
  CHECK(HasWarning(scene, "TransformBegin and TransformEnd are AttributeBegin"));
  const Shape &inside = scene.shapes[0], &after = scene.shapes[1];
  CHECK(scene.materials[inside.material].kind == MaterialKind::kDielectric);
  CHECK(inside.reverse_orientation);
  CHECK(inside.area_light == 0);
  CHECK(scene.materials[after.material].kind == MaterialKind::kConductor);
  CHECK_FALSE(after.reverse_orientation);
  CHECK(after.area_light == kNone);
  CHECK(Near(Origin(after), {0, 0, 0}));
  CHECK(Near(Origin(scene.shapes[2]), {2, 0, 0}));
  CHECK(scene.shapes[2].reverse_orientation);
  CHECK_FALSE(scene.shapes[3].reverse_orientation);
  CHECK(Near(Origin(scene.shapes[3]), {0, 0, 0}));
}

TEST_CASE("instances place shapes at instance times shape transform", "[parse]") {
  const SceneDescription scene = ParseWorld(R"(
    ObjectBegin "pair"
      Translate 1 0 0  Shape "sphere"
      AreaLightSource "diffuse"  Shape "disk"
    ObjectEnd
    AttributeBegin Scale 2 2 2 ObjectInstance "pair" AttributeEnd
    ObjectInstance "pair")");
  CHECK(scene.shapes.empty());
  REQUIRE(scene.objects.size() == 1);
  REQUIRE(scene.objects[0].shapes.size() == 2);
  REQUIRE(scene.instances.size() == 2);
  CHECK(scene.instances[0].object == 0);
  const Transform world_from_shape =
      scene.instances[0].world_from_object * scene.objects[0].shapes[0].world_from_object;
  CHECK(Near(world_from_shape.Point({0, 0, 0}), {2, 0, 0}));
  // The block's transform ends with it; its lights have no effect, as in pbrt.
  CHECK(scene.instances[1].world_from_object == Transform());
  CHECK(scene.objects[0].shapes[1].area_light == kNone);
  CHECK(HasNote(scene, "area light has no effect inside an object"));
}

TEST_CASE("the default material is one grey diffuse", "[parse]") {
  const SceneDescription scene = ParseWorld(R"(
    AttributeBegin Shape "sphere" AttributeEnd  Shape "disk")");
  REQUIRE(scene.materials.size() == 1);
  CHECK(scene.materials[0].kind == MaterialKind::kDiffuse);
  CHECK(scene.materials[0].reflectance.constant == Rgb{0.5, 0.5, 0.5});
  CHECK(scene.shapes[1].material == 0);
}

TEST_CASE("attributes are defaults that may stay unused", "[parse]") {
  const SceneDescription scene = ParseWorld(R"(
    AttributeBegin
      Attribute "shape" "float radius" 2  "float alpha" 0.5
      Attribute "shape" "float radius" 3
      Attribute "material" "float roughness" 0.25
      Shape "sphere"
      Shape "sphere" "float radius" 4
      Shape "plane"
      Material "diffuse"  Material "conductor"
    AttributeEnd
    Shape "sphere")");
  CHECK(scene.shapes[0].radius == 3);
  CHECK(scene.shapes[1].radius == 4);
  CHECK(scene.shapes[2].alpha.constant == 0.5);
  CHECK(scene.materials.back().uroughness.constant == 0.25);
  CHECK(scene.shapes[3].radius == 1);
}

TEST_CASE("mistakes that pbrt-v4 accepts are warnings", "[parse]") {
  const SceneDescription scene = ParseText(R"(
    ColorSpace "REC2020"  ColorSpace "srbg"
    WorldBegin
    Translate 1 0 0  CoordinateSystem "lamp"
    CoordSysTransform "lmap"
    AttributeEnd  TransformEnd
    Shape "sphere" "float radius" 2 "float radius" 3)");
  REQUIRE(scene.shapes.size() == 1);
  CHECK(scene.shapes[0].radius == 3);
  CHECK(Near(Origin(scene.shapes[0]), {1, 0, 0}));
  CHECK(HasWarning(scene, "unknown color space \"srbg\""));
  CHECK(HasWarning(scene, "did you mean \"lamp\"?"));
  CHECK(HasWarning(scene, "AttributeEnd without AttributeBegin"));
  CHECK(HasWarning(scene, "TransformEnd without AttributeBegin"));
  CHECK(HasWarning(scene, "parameter \"float radius\" is given twice"));
  CHECK(scene.notes.size() == 5);
  CHECK(scene.notes[4].where.ToString() == "test.pbrt:7:37");
}

TEST_CASE("a coordinate system replaces both transforms", "[parse]") {
  const SceneDescription scene = ParseWorld(R"(
    CoordinateSystem "here"  Translate 1 0 0  ActiveTransform EndTime
    CoordSysTransform "here"  Shape "sphere")");
  REQUIRE(scene.shapes.size() == 1);
  CHECK(Near(Origin(scene.shapes[0]), {0, 0, 0}));
}

TEST_CASE("options accept every spelling that pbrt-v4 accepts", "[parse]") {
  CHECK(ParseText("Option \"Force-Diffuse\" true WorldBegin").integrator.force_diffuse);
}

TEST_CASE("unsupported things can be skipped", "[parse]") {
  const std::string text = R"(
    MakeNamedMedium "fog" "string type" "homogeneous"
    MediumInterface "fog" ""
    Shape "curve" "point3 P" [ 0 0 0  1 0 0  2 0 0  3 0 0 ] "float alpha" 0.5
    Shape "sphere")";
  CHECK_THROWS_AS(ParseWorld(text), InputError);
  const SceneDescription scene = ParseWorld(text, true);
  CHECK(scene.shapes.size() == 1);
  CHECK(scene.lights.empty());
  CHECK(scene.notes.size() == 1);
  CHECK(Near(Origin(scene.shapes[0]), {0, 0, 0}));
  CHECK_NOTHROW(ParseWorld("MediumInterface \"\" \"\""));
}

// A folder that is removed at the end of the test.
struct FolderWithSub {
  fs::path path = fs::temp_directory_path() / "lanelight_parse_test";
  FolderWithSub() { fs::create_directories(path / "sub"); }
  ~FolderWithSub() { fs::remove_all(path); }
  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(path / name) << text;
  }
};

TEST_CASE("include shares the state, import does not", "[parse]") {
  const FolderWithSub folder;
  folder.Write(
      "main.pbrt",
      "WorldBegin Import \"sub/a.pbrt\" Shape \"sphere\"\n"
      "Include \"sub/a.pbrt\" Shape \"sphere\" NamedMaterial \"m\" Shape \"sphere\"");
  folder.Write("sub/a.pbrt", "Translate 1 0 0 Include \"b.pbrt\"");
  folder.Write("sub/b.pbrt", "Attribute \"shape\" \"float radius\" 7");
  const std::string message =
      InputErrorOf([&] { ParseScene((folder.path / "main.pbrt").string()); });
  CHECK(message.find("main.pbrt:2:51: error: unknown named material") !=
        std::string::npos);
  folder.Write("sub/b.pbrt", "Attribute \"shape\" \"float radius\" 7 #\n");
  folder.Write("main.pbrt",
               "WorldBegin Import \"sub/a.pbrt\" Shape \"sphere\"\n"
               "Include \"sub/a.pbrt\" Shape \"sphere\"");
  const SceneDescription scene = ParseScene((folder.path / "main.pbrt").string());
  REQUIRE(scene.shapes.size() == 2);
  CHECK(scene.shapes[0].radius == 1);
  CHECK(Near(Origin(scene.shapes[0]), {0, 0, 0}));
  CHECK(scene.shapes[1].radius == 7);
  CHECK(Near(Origin(scene.shapes[1]), {1, 0, 0}));
}

// Files level0 to level<depth>, each of which includes the one before `times` times.
std::string WriteLevels(const FolderWithSub& folder, int depth, int times) {
  folder.Write("level0.pbrt", "Shape \"sphere\" \"float radius\" 0\n");
  for (int level = 1; level <= depth; ++level) {
    std::string text = level == depth ? "WorldBegin\n" : "";
    for (int i = 0; i < times; ++i) {
      text += fmt::format("Include \"level{}.pbrt\"\n", level - 1);
    }
    folder.Write(fmt::format("level{}.pbrt", level), text);
  }
  return (folder.path / fmt::format("level{}.pbrt", depth)).string();
}

TEST_CASE("a file may be included more than 100000 times", "[parse]") {
  const FolderWithSub folder;
  // Each sphere without radius leaves a note.
  CHECK(ParseScene(WriteLevels(folder, 5, 11)).notes.size() == 11 * 11 * 11 * 11 * 11);
}

TEST_CASE("files that include each other without end are refused", "[parse][slow]") {
  const FolderWithSub folder;
  const std::string scene = WriteLevels(folder, 60, 2);
  folder.Write("level0.pbrt", "");
  const std::string message = InputErrorOf([&] { ParseScene(scene); });
  CHECK(message.find("all included files together have more than 4 GiB") !=
        std::string::npos);
}

TEST_CASE("a mesh file used twice is loaded once", "[parse]") {
  const FolderWithSub folder;
  folder.Write("m.ply",
               "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
               "property float y\nproperty float z\nelement face 1\n"
               "property list uchar int vertex_index\nend_header\n"
               "0 0 0 1 0 0 0 1 0 3 0 1 2\n");
  const SceneDescription scene = ParseSceneText(
      "WorldBegin Shape \"plymesh\" \"string filename\" \"m.ply\" ObjectBegin \"o\"\n"
      "Shape \"plymesh\" \"string filename\" \"m.ply\" ObjectEnd",
      "main.pbrt", folder.path.string());
  REQUIRE(scene.shapes[0].mesh != nullptr);
  CHECK(scene.shapes[0].mesh == scene.objects[0].shapes[0].mesh);
  CHECK(scene.shapes[0].mesh->indices.size() == 3);
}

TEST_CASE("without access to files nothing is opened", "[parse]") {
  for (const char* text : {"Include \"a.pbrt\"", "Import \"a.pbrt\"",
                           "Shape \"plymesh\" \"string filename\" \"a.ply\"",
                           "LightSource \"point\" \"spectrum I\" \"a.spd\""}) {
    CAPTURE(text);
    CHECK(WorldError(text).find("reading files is disabled here") != std::string::npos);
  }
}

TEST_CASE("windows of the film are sorted, clamped or ignored as in pbrt-v4", "[parse]") {
  struct Case {
    const char* window;
    const char* warning;
    int crop[4];
  };
  const Case cases[] = {
      {"\"float cropwindow\" [ 0.75 0.25 0 1 ]", "", {2, 6, 0, 8}},
      {"\"float cropwindow\" [ -1 0.5 0 1.5 ]", "is clamped", {0, 4, 0, 8}},
      {"\"integer pixelbounds\" [ 4 99 0 4 ]", "is clamped", {4, 8, 0, 4}},
      {"\"integer pixelbounds\" [ 4 2 0 4 ]", "", {2, 4, 0, 4}},
      {"\"float cropwindow\" [ 0 1 0 0.5 ] \"integer pixelbounds\" [ 0 1 0 1 ]",
       "cropwindow is used",
       {0, 8, 0, 4}},
      {"\"integer pixelbounds\" [ 0 4 ]", "is ignored", {0, 0, 0, 0}},
      {"\"float cropwindow\" [ 0 1 0 ]", "is ignored", {0, 0, 0, 0}}};
  for (const Case& c : cases) {
    CAPTURE(c.window);
    const SceneDescription scene = ParseText(fmt::format(
        "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8 {}\n"
        "WorldBegin",
        c.window));
    CHECK(std::equal(c.crop, c.crop + 4, scene.film.crop));
    CHECK(std::any_of(scene.notes.begin(), scene.notes.end(),
                      [](const Note& n) { return n.warning; }) == (*c.warning != 0));
    CHECK(HasNote(scene, c.warning) == (*c.warning != 0));
  }
}

TEST_CASE("values that pbrt-v4 replaces give warnings", "[parse]") {
  const auto warned = [](const std::string& text, const std::string& used) {
    const SceneDescription scene = ParseWorld(text);
    CAPTURE(text);
    CHECK(HasWarning(scene, used + " is used, as in pbrt-v4"));
    return scene;
  };
  const std::string points = "\"point3 P\" [ 0 0 0  1 0 0  2 0 0  3 0 0 ]";
  CHECK(warned("Shape \"curve\" \"string type\" \"round\" " + points, "\"cylinder\"")
            .shapes.at(0)
            .curves->at(0)
            .type == CurveType::kCylinder);
  CHECK(warned("Texture \"t\" \"spectrum\" \"dots\" \"string mapping\" \"conical\"",
               "\"uv\"")
            .textures.at(0)
            .mapping.kind == MappingKind::kUv);
  warned(
      "Shape \"loopsubdiv\" \"integer indices\" [ 0 1 2 ] \"point3 P\" [ 0 0 0  1 0 0  "
      "0 1 0 ] \"string scheme\" \"catmark\"",
      "\"loop\"");
  CHECK(warned("LightSource \"spot\" \"float coneangle\" 20 \"float conedeltaangle\" 30",
               "10")
            .lights.at(0)
            .cone_delta == 10);
}

}  // namespace
}  // namespace lanelight

// ActiveTransform, TransformTimes and the shutter.
#include <catch2/catch.hpp>

#include "src/base/core/error.h"
#include "tests/scene/parse/parse_text.h"

namespace lanelight {
namespace {

using Catch::Contains;

Vec3d StartOf(const Instance& i) { return i.world_from_object.Point({0, 0, 0}); }
Vec3d EndOfInstance(const Instance& i) {
  REQUIRE(i.end != nullptr);
  return i.end->Point({0, 0, 0});
}

bool IsAt(Vec3d a, Vec3d b) { return Length(a - b) < 1e-12; }

constexpr const char* kMovingSphere =
    "Translate 1 0 0 ActiveTransform EndTime Translate 0 2 0 ActiveTransform All "
    "Shape \"sphere\" ";

}  // namespace

TEST_CASE("a moving shape becomes an object with one instance", "[parse]") {
  const SceneDescription scene = ParseWorld(kMovingSphere);
  CHECK(scene.shapes.empty());
  REQUIRE(scene.objects.size() == 1);
  REQUIRE(scene.instances.size() == 1);
  CHECK(scene.objects[0].shapes.at(0).world_from_object == Transform());
  CHECK(IsAt(StartOf(scene.instances[0]), {1, 0, 0}));
  CHECK(IsAt(EndOfInstance(scene.instances[0]), {1, 2, 0}));
}

TEST_CASE("equal transforms at both times give no motion", "[parse]") {
  const SceneDescription scene = ParseWorld(
      "ActiveTransform StartTime Translate 1 0 0 ActiveTransform EndTime "
      "Translate 1 0 0 ActiveTransform All Shape \"sphere\"");
  CHECK(scene.shapes.size() == 1);
  CHECK(scene.instances.empty());
}

TEST_CASE("attributes and coordinate systems keep both transforms", "[parse]") {
  const SceneDescription scene = ParseWorld(
      "AttributeBegin ActiveTransform EndTime Translate 0 2 0 CoordinateSystem \"late\" "
      "AttributeEnd Shape \"sphere\" Translate 5 0 0 CoordSysTransform \"late\" "
      "Shape \"sphere\" Identity Shape \"sphere\"");
  CHECK(scene.shapes.size() == 2);
  REQUIRE(scene.instances.size() == 1);
  CHECK(IsAt(StartOf(scene.instances[0]), {0, 0, 0}));
  CHECK(IsAt(EndOfInstance(scene.instances[0]), {0, 2, 0}));
}

TEST_CASE("motions are fitted to the shutter", "[parse]") {
  const auto scene = [](const std::string& times, const std::string& shutter) {
    return ParseText(times + "Camera \"perspective\" " + shutter + " WorldBegin " +
                     kMovingSphere);
  };
  const SceneDescription half =
      scene("TransformTimes 1 3 ", "\"float shutteropen\" 1.5 \"float shutterclose\" 2");
  CHECK(IsAt(StartOf(half.instances[0]), {1, 0.5, 0}));
  CHECK(IsAt(EndOfInstance(half.instances[0]), {1, 1, 0}));
  CHECK(half.camera.time_first == 0);
  CHECK(half.camera.time_rate == 1);
  // Beyond the times of transforms things stand still.
  const SceneDescription late =
      scene("", "\"float shutteropen\" 0.5 \"float shutterclose\" 2.5");
  CHECK(IsAt(StartOf(late.instances[0]), {1, 1, 0}));
  CHECK(IsAt(EndOfInstance(late.instances[0]), {1, 2, 0}));
  CHECK(late.camera.time_first == 0);
  CHECK(late.camera.time_rate == 4);
  const SceneDescription after =
      scene("", "\"float shutteropen\" 2 \"float shutterclose\" 3");
  CHECK(IsAt(StartOf(after.instances[0]), {1, 2, 0}));
  CHECK(after.instances[0].end == nullptr);
  CHECK_THROWS_WITH(scene("TransformTimes 1 1 ", ""), Contains("must come after"));
}

TEST_CASE("a camera moves between both transforms", "[parse]") {
  const SceneDescription scene = ParseText(
      "ActiveTransform EndTime Translate 0 -2 0 ActiveTransform All Translate -1 0 0 "
      "Camera \"perspective\" WorldBegin");
  CHECK(IsAt(scene.camera.world_from_camera.Point({}), {1, 0, 0}));
  REQUIRE(scene.camera.end != nullptr);
  CHECK(IsAt(scene.camera.end->Point({}), {1, 2, 0}));
}

TEST_CASE("shapes that move in an object go with its instances", "[parse]") {
  const std::string object =
      std::string("ObjectBegin \"o\" Shape \"sphere\" ") + kMovingSphere + "ObjectEnd ";
  const SceneDescription scene =
      ParseWorld(object + "Translate 0 0 3 ObjectInstance \"o\"");
  REQUIRE(scene.instances.size() == 2);
  CHECK(scene.instances[0].end == nullptr);
  CHECK(IsAt(StartOf(scene.instances[1]), {1, 0, 3}));
  CHECK(IsAt(EndOfInstance(scene.instances[1]), {1, 2, 3}));
  // An object that moves on a straight way, too, but none that turns meanwhile.
  const auto moving = [&](const char* how) {
    return object + "ActiveTransform EndTime " + how +
           " ActiveTransform All ObjectInstance \"o\"";
  };
  const SceneDescription both = ParseWorld(moving("Translate 0 0 3"));
  CHECK(IsAt(EndOfInstance(both.instances[1]), {1, 2, 3}));
  CHECK_THROWS_WITH(ParseWorld(moving("Rotate 90 0 0 1")),
                    Contains("take the shape out of the object"));
}

TEST_CASE("unsupported motion is refused or ignored", "[parse]") {
  const std::string move = "ActiveTransform EndTime Translate 0 2 0 ActiveTransform All ";
  const std::string curve =
      "Shape \"curve\" \"point3 P\" [ 0 0 0  1 0 0  2 0 0  3 0 0 ] ";
  const std::pair<std::string, const char*> refused[] = {
      {move + "AreaLightSource \"diffuse\" Shape \"sphere\"", "an area light cannot"},
      {move + curve, "a curve cannot"},
      {move + "Shape \"plane\"", "an infinite plane cannot"},
      {"ObjectBegin \"o\" " + curve + "ObjectEnd " + move + "ObjectInstance \"o\"",
       "a curve cannot"}};
  for (const auto& [text, why] : refused) {
    INFO(text);
    CHECK_THROWS_WITH(ParseWorld(text), Contains(why));
    const SceneDescription scene = ParseWorld(text, true);
    REQUIRE(scene.notes.size() == 1);
    CHECK(scene.notes[0].changes_image);
  }
  CHECK_THROWS_WITH(ParseWorld("ActiveTransform EndTime Scale -1 1 1 "
                               "ActiveTransform All Shape \"sphere\""),
                    Contains("mirrors"));
}

TEST_CASE("lights, media and textures stay at the start, with a note", "[parse]") {
  const std::string move = "ActiveTransform EndTime Translate 0 2 0 ActiveTransform All ";
  for (const char* thing :
       {"LightSource \"point\"", "Texture \"t\" \"float\" \"wrinkled\"",
        "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\""}) {
    INFO(thing);
    const SceneDescription scene = ParseWorld(move + thing);
    CHECK(HasNote(scene, "does not move"));
  }
}

}  // namespace lanelight

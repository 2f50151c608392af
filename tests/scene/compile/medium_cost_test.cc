// Notes on media in which paths take long.
#include "src/scene/compile/media.h"

#include <catch2/catch.hpp>

#include "src/scene/compile/compile.h"
#include "src/scene/compiled/scene.h"
#include "tests/scene/parse/parse_text.h"

namespace lanelight {
namespace {

// A ball of radius 1 full of it: 4 V / S = 4/3, as of its box.
std::string NoteOf(const std::string& medium, int max_depth = 100000) {
  const SceneDescription scene = ParseText(
      "Integrator \"volpath\" \"integer maxdepth\" " + std::to_string(max_depth) +
      "\nWorldBegin\nLightSource \"infinite\"\nMakeNamedMedium \"fog\" " + medium +
      "\nMediumInterface \"fog\" \"\"\nMaterial \"interface\"\nShape \"sphere\"");
  for (const Note& note : CompileScene(scene, {}).notes) {
    if (note.message.find("is dense") == std::string::npos) continue;
    CHECK(note.where.line == 4);
    return note.message;
  }
  return "";
}

}  // namespace

TEST_CASE("dense media get a note with the cost of a path", "[compile][media]") {
  const std::string fog = "\"string type\" \"homogeneous\" \"rgb sigma_a\" [ 0 0 0 ] ";
  const std::string thick = fog + "\"rgb sigma_s\" [ 1 5000 1 ]";
  CHECK_THAT(NoteOf(thick), Catch::Contains("7e+03 collisions") &&
                                Catch::Contains("--max-depth limits them"));
  CHECK(NoteOf(thick, 100).empty());
  CHECK(NoteOf(fog + "\"rgb sigma_s\" [ 500 500 500 ]").empty());
  // Absorption ends paths after 1 / (1 - albedo) = 101 collisions.
  CHECK(NoteOf("\"string type\" \"homogeneous\" \"rgb sigma_a\" [ 50 50 50 ] \"rgb "
               "sigma_s\" [ 5000 5000 5000 ]")
            .empty());
}

TEST_CASE("heterogeneous media get a note at any depth", "[compile][media]") {
  const std::string grid =
      "\"string type\" \"uniformgrid\" \"integer nx\" 1 \"integer ny\" 1 \"integer nz\" "
      "1 "
      "\"point3 p0\" [ -1 -1 -1 ] \"point3 p1\" [ 1 1 1 ] \"float density\" [ 0.5 ] ";
  CHECK_THAT(NoteOf(grid + "\"rgb sigma_s\" [ 1 1 1e6 ]", 5),
             Catch::Contains("7e+05 collisions") && Catch::Contains("\"sigma_s\""));
  CHECK(NoteOf(grid + "\"rgb sigma_s\" [ 10 10 10 ]", 5).empty());
}

}  // namespace lanelight

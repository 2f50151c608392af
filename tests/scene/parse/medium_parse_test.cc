// Participating media.
#include <catch2/catch.hpp>

#include "tests/scene/parse/parse_text.h"

namespace lanelight {
namespace {

Medium ParseMedium(const std::string& text) {
  return ParseWorld("MakeNamedMedium \"m\" \"string type\" " + text).media.back();
}

TEST_CASE("homogeneous media", "[parse]") {
  const Medium medium = ParseMedium(
      "\"homogeneous\" \"rgb sigma_a\" [ 1 2 3 ] \"rgb sigma_s\" [ 4 5 6 ] "
      "\"float scale\" 0.5 \"float g\" -0.25 \"rgb Le\" [ 1 0 2 ] \"float Lescale\" 3");
  CHECK(medium.kind == MediumKind::kHomogeneous);
  CHECK(medium.name == "m");
  CHECK(medium.sigma_a == Rgb{0.5, 1, 1.5});
  CHECK(medium.sigma_s == Rgb{2, 2.5, 3});
  CHECK(medium.emission == Rgb{3, 0, 6});
  CHECK(medium.g == -0.25);
  CHECK(ParseMedium("\"homogeneous\" \"string preset\" \"Apple\"").sigma_s ==
        Rgb{2.29, 2.39, 1.97});
}

TEST_CASE("each coefficient of a homogeneous medium that is missing is 1", "[parse]") {
  const Medium bare = ParseMedium("\"homogeneous\"");
  CHECK(bare.sigma_a == Rgb{1, 1, 1});
  CHECK(bare.sigma_s == Rgb{1, 1, 1});
  const Medium scattering =
      ParseMedium("\"homogeneous\" \"rgb sigma_s\" [ 1 2 3 ] \"float scale\" 2");
  CHECK(scattering.sigma_a == Rgb{2, 2, 2});
  CHECK(scattering.sigma_s == Rgb{2, 4, 6});
  const Medium absorbing = ParseMedium("\"homogeneous\" \"rgb sigma_a\" [ 1 2 3 ]");
  CHECK(absorbing.sigma_a == Rgb{1, 2, 3});
  CHECK(absorbing.sigma_s == Rgb{1, 1, 1});
}

TEST_CASE("an unknown medium preset is a warning, as in pbrt", "[parse]") {
  const SceneDescription scene = ParseWorld(
      "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"string preset\" "
      "\"Aple\" \"rgb sigma_a\" [ 1 2 3 ]");
  CHECK(scene.media[0].sigma_a == Rgb{1, 2, 3});
  CHECK(scene.media[0].sigma_s == Rgb{1, 1, 1});
  CHECK(HasNote(scene, "\"Apple\""));
  CHECK_THAT(WorldError("MakeNamedMedium \"m\" \"string type\" \"homogeneous\" "
                        "\"string preset\" \"Apple\" \"rgb sigma_a\" [ 1 2 3 ]"),
             Catch::Contains("exclude each other"));
}

TEST_CASE("media that vary", "[parse]") {
  const Medium grid = ParseMedium(
      "\"uniformgrid\" \"integer nx\" 2 \"integer nz\" 2 \"float density\" [ 1 2 3 4 ] "
      "\"point3 p0\" [ -1 0 0 ] \"rgb sigma_s\" [ 2 2 2 ]");
  CHECK(grid.kind == MediumKind::kUniformGrid);
  CHECK(grid.grid == std::vector<float>{1, 2, 3, 4});
  CHECK(grid.grid_size[1] == 1);
  CHECK(grid.box_min == Vec3d{-1, 0, 0});
  CHECK(grid.sigma_a == Rgb{1, 1, 1});
  const Medium colored = ParseMedium(
      "\"rgbgrid\" \"integer nx\" 2 \"rgb sigma_s\" [ 1 2 3 4 5 6 ] \"float scale\" 2");
  CHECK(colored.grid == std::vector<float>{2, 2, 2, 2, 4, 6, 2, 2, 2, 8, 10, 12});
}

TEST_CASE("media that emit by voxel", "[parse]") {
  const std::string grid = "\"uniformgrid\" \"integer nx\" 2 \"float density\" [ 1 2 ] ";
  const Medium scaled =
      ParseMedium(grid + "\"rgb Le\" [ 1 2 3 ] \"float Lescale\" [ 4 5 ]");
  CHECK(scaled.emission == Rgb{1, 2, 3});
  CHECK(scaled.emission_grid == std::vector<float>{4, 5});
  // Without a scale pbrt-v4 has a grid of one voxel; a single number is that everywhere.
  CHECK(ParseMedium(grid + "\"rgb Le\" [ 1 2 3 ]").emission_grid ==
        std::vector<float>{1});
  const Medium hot = ParseMedium(grid +
                                 "\"float temperature\" [ 6 7 ] \"float Lescale\" 3 "
                                 "\"float temperaturecutoff\" 2 "
                                 "\"float temperaturescale\" 100");
  CHECK(hot.emission == Rgb{3, 3, 3});
  CHECK(hot.emission_grid.empty());
  CHECK(hot.temperature == std::vector<float>{6, 7});
  CHECK(hot.temperature_offset == 2);
  CHECK(hot.temperature_scale == 100);
  const Medium colored = ParseMedium(
      "\"rgbgrid\" \"rgb sigma_a\" [ 1 1 1 ] \"rgb Le\" [ 1 2 3 ] \"float Lescale\" 2");
  CHECK(colored.emission_grid == std::vector<float>{1, 2, 3});
  CHECK(colored.emission.x == Approx(2 * 106.856895));  // as pbrt-v4, not normalised
  CHECK_THROWS_WITH(
      ParseMedium(grid + "\"float temperature\" [ 1 1 ] \"rgb Le\" [ 1 1 1 ]"),
      Catch::Contains("exclude each other"));
  CHECK_THROWS_WITH(
      ParseMedium("\"rgbgrid\" \"rgb sigma_s\" [ 1 1 1 ] \"rgb Le\" [ 1 1 1 ]"),
      Catch::Contains("needs \"rgb sigma_a\""));
}

TEST_CASE("clouds", "[parse]") {
  const Medium cloud = ParseMedium("\"cloud\" \"float density\" 2 \"float frequency\" 3");
  CHECK(cloud.kind == MediumKind::kCloud);
  CHECK(cloud.density == 2);
  CHECK(cloud.wispiness == 1);
  CHECK(cloud.frequency == 3);
  CHECK(cloud.sigma_s == Rgb{1, 1, 1});
}

TEST_CASE("media beside shapes and around the camera", "[parse]") {
  const std::string media =
      "MakeNamedMedium \"a\" \"string type\" \"homogeneous\"\n"
      "MakeNamedMedium \"b\" \"string type\" \"homogeneous\"\n";
  const SceneDescription scene =
      ParseWorld(media +
                 "MediumInterface \"a\" \"b\" Shape \"sphere\" "
                 "AttributeBegin MediumInterface \"b\" Shape \"sphere\" AttributeEnd "
                 "MediumInterface \"\" \"a\" Shape \"sphere\"");
  CHECK(scene.shapes[0].media.inside == 0);
  CHECK(scene.shapes[0].media.outside == 1);
  CHECK_FALSE(scene.shapes[1].media.IsTransition());
  CHECK(scene.shapes[1].media.inside == 1);
  CHECK(scene.shapes[2].media.inside == kNone);
  CHECK(scene.shapes[2].media.outside == 0);
  const SceneDescription inside =
      ParseText(media + "MediumInterface \"\" \"b\" Camera \"perspective\" WorldBegin");
  CHECK(inside.camera.medium == 1);
}

}  // namespace
}  // namespace lanelight

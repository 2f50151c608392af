// Textures and mixes that are nested deeply, or in each other over and over.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "src/base/core/error.h"
#include "src/scene/compile/compile.h"
#include "src/scene/compile/textures.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/parse/parse.h"

namespace lanelight {
namespace {

using Catch::Contains;

CompiledScene Compile(const std::string& body) {
  const std::string text = "WorldBegin\n" + body + "Shape \"sphere\"\n";
  return CompileScene(ParseSceneText(text, "nested.pbrt", "."), {});
}

// 100 000 scales on top of each other, of a texture "t0".
std::string ChainOfScales() {
  std::string text;
  for (int i = 1; i <= 100000; ++i) {
    text += fmt::format(
        "Texture \"t{}\" \"spectrum\" \"scale\" \"texture tex\" \"t{}\" \"float scale\" "
        "{}\n",
        i, i - 1, i % 2 == 0 ? 2.0 : 0.5);
  }
  return text + "Material \"diffuse\" \"texture reflectance\" \"t100000\"\n";
}

// Each a mix of the one before with itself: 2^60 paths lead to the first.
std::string TowerOfMixes() {
  std::string text;
  for (int i = 1; i <= 60; ++i) {
    text += fmt::format(
        "Texture \"t{}\" \"spectrum\" \"mix\" \"texture tex1\" \"t{}\" \"texture tex2\" "
        "\"t{}\"\n",
        i, i - 1, i - 1);
  }
  return text + "Material \"diffuse\" \"texture reflectance\" \"t60\"\n";
}

const char* kConstant =
    "Texture \"t0\" \"spectrum\" \"constant\" \"rgb value\" [ 0.25 0.5 0.75 ]\n";
const char* kChecker = "Texture \"t0\" \"spectrum\" \"checkerboard\"\n";

}  // namespace

TEST_CASE("a long chain of scaled constants is a constant", "[compile]") {
  const CompiledScene scene = Compile(kConstant + ChainOfScales());
  REQUIRE(scene.materials.size() == 1);
  CHECK(scene.materials.color0_texture[0] == -1);
  CHECK(scene.materials.color0_r[0] == 0.25f);
  CHECK(scene.materials.color0_b[0] == 0.75f);
}

TEST_CASE("a long chain of non-constant textures is refused", "[compile]") {
  CHECK_THROWS_WITH(Compile(kChecker + ChainOfScales()),
                    Contains("nested.pbrt:") && Contains("combines more than 31 others"));
}

TEST_CASE("mixes of one texture with itself are compiled once each", "[compile]") {
  const CompiledScene scene = Compile(kConstant + TowerOfMixes());
  CHECK(scene.materials.color0_g[0] == 0.5f);
  CHECK_THROWS_WITH(Compile(kChecker + TowerOfMixes()), Contains("combines more than"));
}

TEST_CASE("constants are found through every operand", "[compile]") {
  std::vector<Texture> t(5);
  t[0].value = {0.5, 0.25, 1};
  t[1].kind = TextureKind::kCheckerboard;
  t[2].kind = TextureKind::kMix;
  t[2].tex1 = {{}, 0}, t[2].tex2 = {{1, 1, 1}, kNone}, t[2].amount = {0.5, kNone};
  t[3].kind = TextureKind::kMix;
  t[3].tex1 = {{}, 2}, t[3].tex2 = {{}, 1}, t[3].amount = {0.5, kNone};
  t[4].kind = TextureKind::kScale;
  t[4].tex1 = {{}, 2}, t[4].amount = {0, 0};
  const TextureConstants constants(t);
  CHECK(constants.Of(0) == Rgb{0.5, 0.25, 1});
  CHECK_FALSE(constants.Of(1));
  CHECK(constants.Of(2) == Rgb{0.75, 0.625, 1});
  CHECK_FALSE(constants.Of(3));
  CHECK(constants.Of(4) == Rgb{0.375, 0.3125, 0.5});
  CHECK(constants.Fold(ColorValue{{}, 2}).texture == kNone);
  CHECK(constants.Fold(ColorValue{{}, 3}).texture == 3);
  CHECK(constants.Fold(FloatValue{0, 0}).constant == 0.5);
  const std::vector<Texture> kept = KeepUsedTextures(t, {3});
  CHECK(kept[1].kind == TextureKind::kCheckerboard);
  CHECK(kept[0].value == Rgb{0.5, 0.25, 1});
  CHECK(kept[4].kind == TextureKind::kConstant);
}

TEST_CASE("mixes of materials may be nested to any depth", "[compile]") {
  std::string text = "MakeNamedMaterial \"m0\" \"string type\" \"diffuse\"\n";
  for (int i = 1; i <= 100000; ++i) {
    text += fmt::format(
        "MakeNamedMaterial \"m{}\" \"string type\" \"mix\" \"string materials\" [ "
        "\"m{}\" "
        "\"m0\" ] \"float amount\" 0.25\n",
        i, i - 1);
  }
  const CompiledScene scene = Compile(text + "NamedMaterial \"m100000\"\n");
  REQUIRE(scene.materials.size() == 100001);
  CHECK(scene.materials.mix1[5] == 0);
  CHECK(scene.materials.mix0[100000] == 99999);
}

}  // namespace lanelight

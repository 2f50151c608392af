// Compiling textures: sharing, channels, errors with their place.
#include "src/scene/compile/texture_programs.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "src/base/core/error.h"
#include "src/base/image/decode.h"
#include "src/base/image/image.h"
#include "tests/kernels/texture/texture_files.h"

namespace lanelight {
namespace {

Texture At(Texture t, int line) {
  t.where = {std::make_shared<const std::string>("scene.pbrt"), line, 3};
  return t;
}

}  // namespace

TEST_CASE("an image file is stored once per encoding", "[texture]") {
  const TemporaryFolder folder;
  Texture t = ImageTexture(folder.Write("a.tga", RandomTga(4, 4, 24, 1)));
  std::vector<Texture> textures = {t, t, t, t};
  textures[1].scale = 2;                     // same texels
  textures[2].encoding = Encoding::kLinear;  // other decode table
  textures[3].is_float = true;               // mean of the colours
  const TextureTable table = CompileTextures(textures);
  CHECK(table.size() == 4);
  CHECK(table.images.size() == 3);
  CHECK(table.nodes[table.programs[0].begin].image ==
        table.nodes[table.programs[1].begin].image);
  CHECK(table.decode.size() == 512);
  CHECK(table.images[0].rgba8.size() == 16);
  CHECK(table.images[2].rgb.size() == 48);
}

TEST_CASE("opaque alpha is ignored by float textures, other alpha is what they read",
          "[texture]") {
  const TemporaryFolder folder;
  std::string file = RandomTga(2, 1, 32, 1);
  file.replace(18, 8, "\x10\x20\x30\xff\x40\x50\x60\xff");  // blue, green, red, alpha
  Texture t = ImageTexture(folder.Write("opaque.tga", file));
  t.is_float = true;
  t.encoding = Encoding::kLinear;
  const TextureTable opaque = CompileTextures({t});
  CHECK(opaque.images[0].rgb[0] == Approx(0x20 / 255.0));
  file[21] = '\x80';
  t.path = folder.Write("cutout.tga", file);
  const TextureTable cutout = CompileTextures({t});
  REQUIRE(cutout.images[0].rgba8.size() == 2);
  CHECK((cutout.images[0].rgba8[0] & 255) == 0x80);
  CHECK((cutout.images[0].rgba8[1] & 255) == 0xff);
  t.is_float = false;
  const TextureTable color = CompileTextures({t});
  CHECK((color.images[0].rgba8[0] & 0xffffff) == 0x102030);
}

TEST_CASE("bytes are decoded by their encoding", "[texture]") {
  CHECK(DecodeByte(0, Encoding::kSrgb, 0) == 0);
  CHECK(DecodeByte(255, Encoding::kSrgb, 0) == Approx(1));
  CHECK(DecodeByte(128, Encoding::kSrgb, 0) == Approx(0.2158605));
  CHECK(DecodeByte(128, Encoding::kLinear, 0) == Approx(0.5019608));
  CHECK(DecodeByte(128, Encoding::kGamma, 2.2) == Approx(std::pow(128 / 255.0, 2.2)));
}

TEST_CASE("unreadable textures are errors with location and file", "[texture]") {
  const TemporaryFolder folder;
  Texture t = At(ImageTexture(folder.File("absent.png")), 42);
  CHECK_THROWS_WITH(CompileTextures({t}), Catch::StartsWith("scene.pbrt:42:3: error: ") &&
                                              Catch::Contains("texture \"image\"") &&
                                              Catch::Contains("absent.png") &&
                                              Catch::Contains("No such file"));
  t.path = folder.File("depth.exr");
  WriteExr(t.path, 1, 1, {{"X", {1}}, {"Z", {1}}});
  CHECK_THROWS_WITH(
      CompileTextures({t}),
      Catch::Contains("depth.exr: its channels (X, Z) are not a colour image"));
}

TEST_CASE("non-finite texels are replaced, with a note", "[texture]") {
  const TemporaryFolder folder;
  Image image = MakeImage(2, 2, {"R", "G", "B"});
  image.pixels.assign(12, 0.5f);
  image.At(1, 0, 2) = std::nanf("");
  image.At(0, 1, 0) = -std::numeric_limits<float>::infinity();
  image.At(0, 1, 1) = std::numeric_limits<float>::infinity();
  const Texture t = At(ImageTexture(folder.File("bad.pfm")), 42);
  WritePfm(t.path, image);
  std::vector<Note> notes;
  const TextureTable table = CompileTextures({t}, {}, &notes);
  REQUIRE(notes.size() == 1);
  CHECK(notes[0].where.line == 42);
  CHECK(notes[0].message.starts_with("texture \"image\": 3 of 12 values of "));
  const auto& rgb = table.images.at(0).rgb;
  for (std::size_t i = 0; i < 12; ++i) {
    CHECK(rgb[i] == (i == 5 ? 0 : i == 6 ? -65504 : i == 7 ? 65504 : 0.5f));
  }
  image.pixels.assign(12, 0.5f);
  WritePfm(t.path, image);
  CompileTextures({t}, {}, &notes);
  CHECK(notes.size() == 1);
}

TEST_CASE("the number of combined textures is limited", "[texture]") {
  std::vector<Texture> textures;
  Texture t;
  t.name = "deep";
  t.kind = TextureKind::kCheckerboard;
  textures.push_back(t);
  for (int i = 1; i < kMaxTextureNodes; ++i) {
    t.tex1.texture = t.tex2.texture = i - 1;
    textures.push_back(t);
  }
  // 2^31 paths through the graph, 32 nodes.
  CHECK(CompileTextures(textures).programs.back().count == kMaxTextureNodes);
  t.tex1.texture = kMaxTextureNodes - 1;
  textures.push_back(At(t, 7));
  CHECK_THROWS_WITH(
      CompileTextures(textures),
      Catch::Contains("scene.pbrt:7:3") && Catch::Contains("more than 31 others"));
}

}  // namespace lanelight

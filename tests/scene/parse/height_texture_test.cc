// Textures as evaluated on the host when meshes are displaced.
#include "src/scene/parse/displace.h"

#include <catch2/catch.hpp>
#include <fstream>

#include "tests/kernels/texture/texture_files.h"
#include "tests/reference/random.h"
#include "tests/reference/texture.h"
#include "tests/scene/parse/height_textures.h"

namespace lanelight {
namespace {

TEST_CASE("displacement heights agree with the reference", "[parse]") {
  const TemporaryFolder folder;
  WritePfm(folder.File("grey.pfm"), RandomFloats(5, 3, 1, 1));
  WritePfm(folder.File("color.pfm"), RandomFloats(4, 6, 3, 2));
  std::ofstream(folder.File("bytes.tga"), std::ios::binary) << RandomTga(7, 4, 24, 3);
  std::ofstream(folder.File("alpha.tga"), std::ios::binary) << RandomTga(3, 4, 32, 4);
  std::vector<Texture> textures = {Constant(0.7)};
  for (const char* file : {"grey.pfm", "color.pfm", "bytes.tga", "alpha.tga"}) {
    for (const WrapMode wrap : {WrapMode::kRepeat, WrapMode::kClamp, WrapMode::kBlack}) {
      textures.push_back(FromFile(folder.File(file), wrap, wrap != WrapMode::kClamp));
    }
  }
  textures[1].scale = 1.5;
  textures[1].invert = true;
  textures[7].encoding = Encoding::kSrgb;
  textures[8].encoding = Encoding::kGamma;
  Texture mix = FloatTexture(TextureKind::kMix);
  mix.tex1.texture = 2, mix.tex2.constant = {0.3, 0.3, 0.3}, mix.amount.texture = 8;
  textures.push_back(mix);
  Texture checks = FloatTexture(TextureKind::kCheckerboard);
  checks.tex1.texture = 3, checks.tex2.texture = 13, checks.mapping = {5, 3, 0.1, 0.2};
  textures.push_back(checks);
  Texture scale = FloatTexture(TextureKind::kScale);
  scale.tex1.texture = 14, scale.amount.constant = -2;
  textures.push_back(scale);

  const reference::Textures truth(textures);
  reference::Random random(3);
  for (Index i = 0; i < static_cast<Index>(textures.size()); ++i) {
    REQUIRE(HeightTexture::Problem(textures, i) == "");
    const HeightTexture height(textures, i);
    double maximum = 0;
    for (int k = 0; k < 200; ++k) {
      const double u = 4 * random.Uniform() - 2, v = 4 * random.Uniform() - 2;
      maximum = std::max(maximum, std::abs(height.At(u, v) - truth.Eval(i, u, v).x));
    }
    CAPTURE(i);
    CHECK(maximum < 1e-6);
  }
}

TEST_CASE("unsupported displacement textures are refused", "[parse]") {
  Texture scale = FloatTexture(TextureKind::kScale);
  scale.tex1.texture = 0;
  Texture placed = FloatTexture(TextureKind::kCheckerboard);
  placed.mapping.kind = MappingKind::kSpherical;
  const std::vector<Texture> textures = {FloatTexture(TextureKind::kFbm), scale, placed};
  for (Index i = 0; i < 3; ++i) {
    CHECK(HeightTexture::Problem(textures, i).find("texture \"height\" is not one of") ==
          0);
  }
}

}  // namespace
}  // namespace lanelight

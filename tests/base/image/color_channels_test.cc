// What is read of images by the channels that they have: as lights, as textures, and by
// `lanelight compare`.
#include "src/base/image/image.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <fmt/ranges.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "src/base/image/exr.h"
#include "src/scene/compile/light_texels.h"
#include "src/scene/compile/texture_programs.h"
#include "src/scene/parse/displace.h"
#include "tests/base/image/temporary_folder.h"
#include "tests/cli/process.h"
#include "tests/kernels/texture/texture_files.h"

namespace lanelight {
namespace {

using Catch::Contains;
using ChannelValues = std::vector<std::pair<std::string, float>>;

// The result of reading an image whose channels are constant; nothing: an error.
struct ChannelCase {
  ChannelValues planes;
  std::optional<Rgb> light, texture;
  std::optional<double> mask;  // of a float texture
};

constexpr Rgb kColor = {0.25, 0.5, 0.75}, kGrey = {0.25, 0.25, 0.25};

// pbrt-v4 takes R, G and B by their names, alpha for nothing but the mask of a float
// texture, and a single channel of a texture whatever its name. Grey lights and Y beside
// others, which it refuses, are read here; XYZ and luminance with chroma are not.
std::vector<ChannelCase> ChannelCases() {
  return {{{{"Y", 0.25f}}, kGrey, kGrey, 0.25},
          {{{"A", 1}, {"Y", 0.25f}}, kGrey, kGrey, 0.25},
          {{{"Y", 0.25f}, {"Z", 9}}, kGrey, kGrey, 0.25},
          {{{"Y", 0.25f}, {"aux.R", 9}}, kGrey, kGrey, 0.25},
          {{{"R", 0.25f}, {"G", 0.5f}, {"B", 0.75f}}, kColor, kColor, 0.5},
          {{{"R", 0.25f}, {"G", 0.5f}, {"B", 0.75f}, {"A", 1}}, kColor, kColor, 0.5},
          {{{"R", 0.25f}, {"G", 0.5f}, {"B", 0.75f}, {"A", 0.1f}}, kColor, kColor, 0.1},
          {{{"R", 0.25f}, {"G", 0.5f}, {"B", 0.75f}, {"Y", 9}}, kColor, kColor, 0.5},
          {{{"R", 0.25f}, {"G", 0.5f}, {"B", 0.75f}, {"a.R", 9}}, kColor, kColor, 0.5},
          {{{"R", 0.25f}}, kGrey, kGrey, 0.25},
          {{{"diffuse.Y", 0.25f}}, kGrey, kGrey, 0.25},
          {{{"A", 0.25f}}, {}, kGrey, 0.25},
          {{{"R", 0.25f}, {"A", 1}}, {}, {}, {}},
          {{{"R", 0.25f}, {"G", 0.5f}}, {}, {}, {}},
          {{{"R", 0.25f}, {"G", 0.5f}, {"A", 1}}, {}, {}, {}},
          {{{"diffuse.R", 1}, {"diffuse.G", 1}, {"diffuse.B", 1}}, {}, {}, {}},
          {{{"X", 0.2f}, {"Y", 0.25f}, {"Z", 0.3f}}, {}, {}, {}},
          {{{"Y", 0.25f}, {"RY", 0.1f}, {"BY", 0.1f}}, {}, {}, {}}};
}

std::string WriteChannels(const TemporaryFolder& folder, const ChannelValues& planes) {
  std::vector<ExrPlane> out;
  for (const auto& [name, value] : planes) {
    out.push_back({name, std::vector<float>(4, value), true});
  }
  WriteExr(folder.File("image.exr"), 2, 2, out);
  return folder.File("image.exr");
}

void CheckTexels(const AlignedVector<float>& rgb, Rgb expected) {
  REQUIRE(rgb.size() == 12);
  for (std::size_t i = 0; i < 12; ++i) {
    CHECK(double(rgb[i]) == Approx(expected[int(i % 3)]));
  }
}

// The file and each of its channels.
Catch::Matchers::StdString::ContainsMatcher Names(const Image& image) {
  return Contains(fmt::format("({})", fmt::join(image.names, ", ")));
}

void CheckLight(const std::string& path, const std::optional<Rgb>& expected) {
  const SourceLocation where;
  const LightFile file = {where, "environment image", path};
  const Image image = ReadImage(path);
  if (expected) return CheckTexels(LightTexels(file, image, nullptr), *expected);
  CHECK_THROWS_WITH(LightTexels(file, image, nullptr), Contains(path) && Names(image));
}

void CheckTexture(const std::string& path, bool is_float,
                  const std::optional<Rgb>& expected) {
  Texture texture = ImageTexture(path);
  texture.is_float = is_float;
  if (expected)
    return CheckTexels(CompileTextures({texture}).images.at(0).rgb, *expected);
  CHECK_THROWS_WITH(CompileTextures({texture}), Contains(path) && Names(ReadImage(path)));
}

void CheckHeights(const std::string& path, const std::optional<double>& expected) {
  Texture texture = ImageTexture(path);
  texture.is_float = true;
  const std::vector<Texture> textures = {texture};
  if (expected) {
    CHECK(HeightTexture(textures, 0).At(0.3, 0.6) == Approx(*expected));
  } else {
    CHECK_THROWS_WITH(HeightTexture(textures, 0),
                      Contains(path) && Names(ReadImage(path)));
  }
}

}  // namespace

TEST_CASE("images are read by the names of their channels", "[image]") {
  const TemporaryFolder folder;
  for (const ChannelCase& c : ChannelCases()) {
    const std::string path = WriteChannels(folder, c.planes);
    INFO(fmt::format("{}", fmt::join(ReadImage(path).names, ", ")));
    CheckLight(path, c.light);
    CheckTexture(path, false, c.texture);
    CheckTexture(path, true,
                 c.mask ? std::optional(Rgb{1, 1, 1} * *c.mask) : std::nullopt);
    CheckHeights(path, c.mask);
    CHECK(ColorChannels(ReadImage(path)).has_value() == c.light.has_value());
  }
}

TEST_CASE("compare refuses images without colours by their channels", "[image]") {
  const TemporaryFolder folder;
  const std::string path =
      WriteChannels(folder, {{"X", 0.2f}, {"Y", 0.25f}, {"Z", 0.3f}, {"A", 1}});
  const ProcessResult refused = RunLanelight({"compare", path, path});
  CHECK(refused.exit_code == 1);
  CHECK_THAT(refused.err, Contains(path) && Contains("A, X, Y, Z"));
  WriteChannels(folder, {{"A", 1}, {"Y", 0.25f}});
  const ProcessResult grey = RunLanelight({"compare", path, path});
  CHECK(grey.exit_code == 0);
  CHECK_THAT(grey.out, Contains("mean Y         0.25 against 0.25"));
}

}  // namespace lanelight

// Scenes that fill the image with one radiance, which a parameter decides.
#pragma once

#include <string>
#include <vector>

#include "src/base/core/pi.h"
#include "tests/agreement/agreement.h"
#include "tests/scene/parse/parse_text.h"

namespace lanelight::test {

/// A parameter, its scene and the radiance.
struct Row {
  const char* parameter;
  std::string world;
  Rgb expected;
  std::string before = "";  // in front of WorldBegin
  double tolerance = 1e-3;  // relative; pixels have a size
};

// A square of 0.02 about (0.1, 0.2), seen from above.
inline constexpr const char* kHead = R"(
LookAt 0.1 0.2 5  0.1 0.2 0  0 1 0
Camera "orthographic" "float screenwindow" [ -0.01 0.01 -0.01 0.01 ]
Film "rgb" "integer xresolution" 4 "integer yresolution" 4
PixelFilter "box"
)";

inline constexpr const char* kSky = "LightSource \"infinite\" ";
inline constexpr const char* kFloor = "Shape \"disk\" \"float radius\" 100 ";
inline constexpr const char* kDiffuse = "Material \"diffuse\" ";
inline std::string Sky(double radiance) {
  return fmt::format("{} \"rgb L\" [ {} {} {} ] ", kSky, radiance, radiance, radiance);
}
inline std::string Lit(const std::string& light) {
  return "LightSource " + light + " " + kDiffuse + kFloor;
}
// A material on a floor under a sky of radiance 1, above and below.
inline std::string Under(const std::string& material) {
  return Sky(1) + "Material " + material + " " + kFloor;
}
// On a square from -1 to 1 at this height, seen at (u, v) = (0.55, 0.6).
inline std::string Textured(const std::string& texture, double z = 0) {
  return Sky(1) + "Texture \"t\" \"spectrum\" " + texture +
         fmt::format(
             " Translate 0 0 {} Material \"diffuse\" \"texture reflectance\" "
             "\"t\" Shape \"bilinearmesh\" \"point3 P\" "
             "[ -1 -1 0  1 -1 0  -1 1 0  1 1 0 ]",
             z);
}
inline bool IsGrey(Rgb c) { return c.x == c.y && c.y == c.z; }

inline void Check(const Row& row, Transport transport) {
  INFO(row.parameter << (transport == Transport::kSpectral ? ", spectral" : ""));
  SceneDescription scene = ParseText(kHead + row.before + "WorldBegin\n" + row.world);
  scene.integrator.transport = transport;
  const auto image = RenderWavefront(scene, 1 << 15);
  const auto known = stat::ExpectedImage(image.width, image.height,
                                         [&](int, int) { return row.expected; });
  const auto result = stat::CompareMeans(image, known, {4, 1e-6, row.tolerance, 1e-6});
  INFO(result.ToString());
  CHECK(result.same);
  if (row.expected.x > 0) CHECK(result.detectable_bias < 0.05);
}

// Grey ones by wavelength as well: colours are not exact there, nor is the black of
// textures.
inline void CheckRows(const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    Check(row, Transport::kRgb);
    if (IsGrey(row.expected) && row.expected.x > 0) Check(row, Transport::kSpectral);
  }
}

}  // namespace lanelight::test

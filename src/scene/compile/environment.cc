#include "src/scene/compile/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "src/base/image/octahedral.h"
#include "src/scene/compile/light_texels.h"
#include "src/scene/compile/lights.h"

namespace lanelight {
namespace {

LightFile FileOf(const Light& light) {
  return {light.where, "environment image", light.image_path};
}

double TexelLuminance(const AlignedVector<float>& rgb, std::size_t i) {
  return Luminance({rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]});
}

// Returns what pbrt-v4 takes for the illuminance of the map on a plane facing +z. The
// integral has 4 pi / texels sr per texel; pbrt uses 2 pi / texels, so its images are
// twice as bright as requested. Scenes are made for pbrt, so we do the same.
double PbrtIlluminance(const AlignedVector<float>& rgb, int size) {
  double sum = 0;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Vec3d w = OctahedralToDirection((x + 0.5) / size, (y + 0.5) / size);
      const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(size) +
                     static_cast<std::size_t>(x);
      if (w.z > 0) sum += w.z * TexelLuminance(rgb, i);
    }
  }
  return sum * 2 * std::numbers::pi / (static_cast<double>(size) * size);
}

void StoreMatrix(const Transform& t, double scale, float out[9]) {
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      out[3 * row + column] = static_cast<float>(t(row, column) / scale);
    }
  }
}

// Lengths do not count: of a stretched light the matrices are such that the volume stays.
void StoreTransforms(const Light& light, Environment& environment) {
  const Transform& t = light.world_from_light;
  const double uniform = t.UniformScale();
  if (uniform > 0) {
    StoreMatrix(t, uniform, environment.scene_from_light);
    StoreMatrix(t.Transposed(), uniform, environment.light_from_scene);
    return;
  }
  const double scale = std::cbrt(std::abs(t.Determinant3()));
  StoreMatrix(t, scale, environment.scene_from_light);
  StoreMatrix(LightFromScene(light), 1 / scale, environment.light_from_scene);
  environment.stretched = true;
}

}  // namespace

Environment CompileEnvironment(const Light& light, std::vector<Note>* notes) {
  return CompileEnvironment(light, ReadLightImage(FileOf(light)), notes);
}

Environment CompileEnvironment(const Light& light, const Image& image,
                               std::vector<Note>* notes) {
  const LightFile file = FileOf(light);
  RequireSquareMap(file, image.width, image.height);
  Environment environment;
  environment.size = image.width;
  environment.rgb = LightTexels(file, image, notes);
  StoreTransforms(light, environment);
  double scale = light.image_scale;
  if (light.illuminance > 0) {
    const double map = PbrtIlluminance(environment.rgb, image.width);
    if (!(map > 0)) {
      FailAtLight(file,
                  "black in its upper hemisphere, so it cannot be scaled to the given "
                  "\"illuminance\"");
    }
    scale *= light.illuminance / map;
  }
  for (float& v : environment.rgb) v = static_cast<float>(v * scale);
  environment.table = MakeEnvironmentTable(false, environment);
  return environment;
}

Rgb MeanRadiance(const Environment& environment) {
  Rgb sum;
  const std::size_t texels = environment.rgb.size() / 3;
  for (std::size_t i = 0; i < texels; ++i) {
    sum +=
        {environment.rgb[3 * i], environment.rgb[3 * i + 1], environment.rgb[3 * i + 2]};
  }
  return texels == 0 ? sum : sum / static_cast<double>(texels);
}

}  // namespace lanelight

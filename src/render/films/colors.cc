#include "src/render/films/colors.h"

#include "src/base/core/check.h"
#include "src/base/image/exr.h"
#include "src/render/films/accumulator.h"

namespace lanelight {

std::vector<Rgb> FilmColors(const FilmAccumulator& film) {
  std::vector<Rgb> colors;
  ForEachPixel(film, [&](int x, int y) { colors.push_back(film.Mean(x, y)); });
  return colors;
}

void WriteColors(const std::string& path, int width, int height,
                 const std::vector<ColorLayer>& layers) {
  std::vector<ExrPlane> planes;
  for (const ColorLayer& layer : layers) {
    if (layer.colors->empty()) continue;
    for (int c = 0; c < 3; ++c) {
      ExrPlane plane = {layer.prefix + "RGB" [c], {}, true};
      for (const Rgb& color : *layer.colors) {
        plane.values.push_back(float(color[c]));
      }
      planes.push_back(std::move(plane));
    }
  }
  WriteExr(path, width, height, planes);
}

std::vector<Rgb> ReadColors(const std::string& path) {
  const Image image = ReadExr(path, {"R", "G", "B"});
  std::vector<Rgb> colors;
  for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
    colors.push_back({image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]});
  }
  return colors;
}

}  // namespace lanelight

#include "src/stress/cases/points.h"

#include "src/stress/scene_point.h"

namespace lanelight::stress {

Point Measure(const SmallImage& image, const Effort& effort) {
  SceneText scene;
  scene.text = image.text;
  scene.settings.resolution = {image.pixels, image.pixels};
  scene.settings.spp = effort(image.quick, image.full);
  scene.settings.seed = effort.seed;
  scene.settings.max_depth = image.depth;
  Point point = MeanOf(RenderText(scene));
  point.expected = image.expected;
  point.tolerance = image.relative * image.expected;
  point.series = image.series;
  return point;
}

std::vector<Point> MeasureFurnace(SmallImage image, const Effort& effort) {
  const std::string text = image.text, series = image.series;
  image.text = "Integrator \"path\" \"string strategy\" \"directions=bsdf\"\n" + text;
  image.series = series + "bsdf";
  std::vector<Point> points = {Measure(image, effort)};
  image.text = text;
  image.series = series + "mis";
  image.quick *= 16;
  points.push_back(Measure(image, effort));
  return points;
}

}  // namespace lanelight::stress

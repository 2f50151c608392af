#include "src/measure/stress/cases/points.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/base/core/source_location.h"
#include "src/measure/stress/cases/scene_text.h"

namespace lanelight::stress {

std::vector<double> Decades(double first, double last, double step) {
  std::vector<double> values;
  const int count = static_cast<int>(std::floor((last - first) / step + 1.5));
  for (int i = 0; i < count; ++i) values.push_back(std::pow(10, first + i * step));
  return values;
}

Axis LogAxis(std::string name, std::string unit, PromisedRange promised_range,
             std::vector<double> quick, std::vector<double> full) {
  if (full.empty()) full = quick;
  return {std::move(name),     std::move(unit),  true,           promised_range.low,
          promised_range.high, std::move(quick), std::move(full)};
}

SceneText Setup(const std::string& text, const Quality& quality, const Effort& effort) {
  SceneText scene;
  scene.text = text;
  scene.settings.resolution = {quality.size, quality.size};
  scene.settings.spp = effort(quality.quick, quality.full);
  scene.settings.seed = effort.seed;
  scene.settings.target = effort.target.name();
  scene.settings.max_depth = quality.depth;
  scene.settings.strategy = ParseStrategy(quality.strategy, {});
  return scene;
}

Point Expect(double expected, const SceneText& scene) {
  Point point = MeanOf(RenderText(scene));
  point.expected = expected;
  point.tolerance = kFloatError * std::abs(expected);
  return point;
}

Point Expect(double expected, const std::string& text, const Quality& quality,
             const Effort& effort) {
  Point point = Expect(expected, Setup(text, quality, effort));
  point.tolerance = quality.relative * std::abs(expected);
  return point;
}

Point PlaneFurnace(double expected, const std::string& material, double cosine,
                   const Effort& effort) {
  return Expect(expected, ViewOfPlane(cosine) + Sky(1) + Plane(material), {.depth = 1},
                effort);
}

Point Named(const std::string& series, Point point) {
  point.series = series;
  return point;
}

Point NotMeasured(const std::string& series, const std::string& why) {
  Point point;
  point.series = series;
  point.not_measured = why;
  return point;
}

Point AllowForRareSamples(Point point, double rare, double difference) {
  const double samples = double(point.samples);
  const double deviation = difference * std::sqrt(rare * (1 - rare) / samples);
  point.standard_error = std::max(point.standard_error, deviation);
  point.tolerance += 3 * difference / samples;
  return point;
}

}  // namespace lanelight::stress

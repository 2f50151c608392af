#include "src/stress/cases/transport_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lanelight::stress {

std::vector<double> Decades(double first, double last, double step) {
  std::vector<double> values;
  const int count = static_cast<int>(std::floor((last - first) / step + 1.5));
  for (int i = 0; i < count; ++i) values.push_back(std::pow(10, first + i * step));
  return values;
}

std::string ViewOfPlane(double cosine, double half) {
  const double sine = std::sqrt((1 - cosine) * (1 + cosine));
  const double side = half * std::min(1.0, cosine);
  return fmt::format(
      "LookAt {:.17g} 0 {:.17g}  0 0 0  0 1 0\n"
      "Camera \"orthographic\" \"float screenwindow\" [{:.17g} {:.17g} {:.17g} "
      "{:.17g}]\nPixelFilter \"box\"\nWorldBegin\n",
      sine, cosine, -side, side, -half, half);
}

std::string ViewFrom(Vec3d eye, double fov) {
  return fmt::format(
      "LookAt {:.17g} {:.17g} {:.17g}  0 0 0  0.01 0.02 1\n"
      "Camera \"perspective\" \"float fov\" {:.17g}\nPixelFilter \"box\"\nWorldBegin\n",
      eye.x, eye.y, eye.z, fov);
}

std::string Sky(double radiance) {
  return fmt::format("LightSource \"infinite\" \"rgb L\" [{0:.17g} {0:.17g} {0:.17g}]\n",
                     radiance);
}

std::string Plane(const std::string& material) {
  return "AttributeBegin\nMaterial " + material + "\nShape \"plane\"\nAttributeEnd\n";
}

std::string Diffuse(double albedo) {
  return fmt::format("\"diffuse\" \"rgb reflectance\" [{0:.17g} {0:.17g} {0:.17g}]",
                     albedo);
}

std::string SphereLight(Vec3d center, double radius, double radiance) {
  return fmt::format(
      "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [{0:.17g} {0:.17g} "
      "{0:.17g}]\nTranslate {1:.17g} {2:.17g} {3:.17g}\nMaterial {4}\nShape \"sphere\" "
      "\"float radius\" {5:.17g}\nAttributeEnd\n",
      radiance, center.x, center.y, center.z, Diffuse(0), radius);
}

std::string Sphere(Vec3d center, double radius, const std::string& material) {
  return fmt::format(
      "AttributeBegin\nTranslate {:.17g} {:.17g} {:.17g}\nMaterial {}\nShape \"sphere\" "
      "\"float radius\" {:.17g}\nAttributeEnd\n",
      center.x, center.y, center.z, material, radius);
}

SceneText Setup(const std::string& text, const Quality& quality, const Effort& effort) {
  SceneText scene;
  scene.text = text;
  scene.settings.resolution = {quality.size, quality.size};
  scene.settings.spp = effort(quality.quick, quality.full);
  scene.settings.seed = effort.seed;
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
  return Expect(expected, Setup(text, quality, effort));
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

Point WithRare(Point point, double rare, double difference) {
  const double samples = double(point.samples);
  const double deviation = difference * std::sqrt(rare * (1 - rare) / samples);
  point.standard_error = std::max(point.standard_error, deviation);
  point.tolerance += 3 * difference / samples;
  return point;
}

Point NoFailures(std::uint64_t failures, std::uint64_t trials) {
  Point point;
  point.failures = failures;
  point.trials = trials;
  point.measured = trials > 0 ? double(failures) / double(trials) : 0;
  return point;
}

Axis LogAxis(const std::string& name, const std::string& unit, double promised_low,
             double promised_high, std::vector<double> quick, std::vector<double> full) {
  if (full.empty()) full = quick;
  return {name,           unit, true, promised_low, promised_high, std::move(quick),
          std::move(full)};
}

}  // namespace lanelight::stress

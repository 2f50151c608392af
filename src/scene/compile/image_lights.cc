#include "src/scene/compile/image_lights.h"

#include <fmt/format.h>

#include <cmath>

#include "src/base/core/error.h"
#include "src/base/core/pi.h"
#include "src/scene/compile/light_axes.h"

namespace lanelight {
namespace {

// The flux of an intensity image: its weighted mean over a domain of some size.
struct ImageFlux {
  Rgb mean;
  double size;
};

// Adds the light whose power is that of its image times its intensity, scaled to the
// power that is asked for.
void AddWithPower(const Light& light, const WorldFrame& frame, const ImageFlux& flux,
                  LightRecord& record, LightList& lights) {
  const auto& [mean, size] = flux;
  const double unit_power = size * Luminance(mean);
  Rgb intensity = light.emission;
  if (light.power > 0) intensity *= light.power / unit_power;
  intensity *= frame.scale * frame.scale;
  Store(intensity, record.radiance);
  Store(PositionOf(light, frame), record.position);
  lights.Push(record, Luminance(intensity * mean) * size, light);
}

}  // namespace

void AddGoniometric(const Light& light, const WorldFrame& frame, LightImageTable& images,
                    LightList& lights) {
  const LightFile file = {light.where, "goniometric light's image", light.image_path};
  LightImage image = images.Load(file, LightImageTable::Use::kGrey);
  if (image.width != image.height) {
    FailAtLight(file, fmt::format("{} x {} pixels; supported are square equal-area "
                                  "octahedral maps (pbrt-v4: \"imgtool makeequiarea\" "
                                  "converts a latitude-longitude map)",
                                  image.width, image.height));
  }
  const Rgb mean = images.Mean(image);
  if (!(Luminance(mean) > 0)) return;
  StoreAxes(light, {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}, image);
  LightRecord record = EmptyRecord(LightShape::kGoniometric);
  record.image = images.Add(image);
  lights.table.has_goniometric = true;
  AddWithPower(light, frame, {mean, 4 * kPi}, record, lights);
}

void AddProjection(const Light& light, const WorldFrame& frame, LightImageTable& images,
                   LightList& lights) {
  const LightFile file = {light.where, "projection light's image", light.image_path};
  LightImage image = images.Load(file, LightImageTable::Use::kColor);
  // Half the sides of the picture at distance 1; the shorter one spans the field of view.
  const double aspect = static_cast<double>(image.width) / image.height;
  const double opposite = std::tan(light.fov * (kPi / 360));
  const double half_x = opposite * std::max(aspect, 1.0);
  const double half_y = opposite * std::max(1 / aspect, 1.0);
  // A pixel of the picture fills the solid angle cos^3 dA.
  const Rgb mean = images.Mean(image, [&](int column, int row) {
    const double x = half_x * ((2 * column + 1.0) / image.width - 1);
    const double y = half_y * ((2 * row + 1.0) / image.height - 1);
    return std::pow(1 + x * x + y * y, -1.5);
  });
  if (!(Luminance(mean) > 0)) return;
  StoreAxes(light, {{1 / half_x, 0, 0}, {0, -1 / half_y, 0}, {0, 0, 1}}, image);
  LightRecord record = EmptyRecord(LightShape::kProjection);
  record.image = images.Add(image);
  const LightCone cone = ConeAround(light, {0, 0, 1},
                                    {{half_x, half_y, 1},
                                     {half_x, -half_y, 1},
                                     {-half_x, half_y, 1},
                                     {-half_x, -half_y, 1}});
  Store(cone.axis, record.direction);
  record.size[0] = static_cast<float>(cone.versine);
  lights.table.has_projection = true;
  AddWithPower(light, frame, {mean, 4 * half_x * half_y}, record, lights);
}

}  // namespace lanelight

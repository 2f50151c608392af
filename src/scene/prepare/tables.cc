#include "src/scene/prepare/tables.h"

#include <cmath>

#include "src/scene/compiled/scene.h"
#include "src/scene/prepare/emission_guide.h"
#include "src/scene/prepare/estimate_path_values.h"
#include "src/scene/prepare/prepared_scene.h"

namespace lanelight {

StrategyTables MakeStrategyTables(const PreparedScene& scene) {
  StrategyTables tables;
  tables.shadow_threshold.floor = static_cast<float>(scene.strategy.ShadowFloor());
  if (scene.chances->emission.HasAny(kFarLight)) {
    tables.emission = MakeEmissionGuide(scene.compiled->lights);
  }
  return tables;
}

AlignedVector<float> InverseShadowThreshold(const PilotImage& image, std::uint32_t pixels,
                                            double relative, double exposure) {
  AlignedVector<float> inverse;
  if (image.black() || !(relative > 0)) return inverse;
  inverse.reserve(std::size_t{pixels} * 3);
  for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
    for (int c = 0; c < 3; ++c) {
      const double weight = std::sqrt(image.ErrorWeight(pixel, c) / 3);
      inverse.push_back(static_cast<float>(weight * exposure / relative));
    }
  }
  return inverse;
}

}  // namespace lanelight

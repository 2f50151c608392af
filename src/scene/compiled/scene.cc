#include "src/scene/compiled/scene.h"

namespace lanelight {

SceneParts PartsOf(const CompiledScene& scene, const CompiledView& view,
                   const LightChances* chances) {
  return {.geometry = &scene.geometry,
          .ranges = &scene.geometry.ranges,
          .accel = &scene.accel,
          .materials = &scene.materials,
          .textures = &scene.textures,
          .spectra = &scene.spectra,
          .alpha = &scene.alpha,
          .media = &scene.media,
          .lights = &scene.lights,
          .filter = &scene.filter,
          .camera = &view.camera,
          .footprint = &view.footprint,
          .gbuffer = &view.gbuffer,
          .chances = chances,
          .scale = scene.scale};
}

}  // namespace lanelight

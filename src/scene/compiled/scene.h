// Owner of the scene data that kernels read: flat float32 arrays, recentred and scaled by
// a power of two (p_scene = (p_world - center) * scale). CompileScene builds it once; all
// renders share it. Kernels include the tables that they read instead (SceneParts), so
// that a change of one table rebuilds few kernels.
#pragma once

#include <cstdint>
#include <vector>

#include "src/base/core/aligned.h"
#include "src/base/core/vec.h"
#include "src/scene/compiled/camera.h"
#include "src/scene/compiled/lights.h"
#include "src/scene/compiled/materials.h"
#include "src/scene/compiled/media.h"
#include "src/scene/compiled/spectra.h"
#include "src/scene/compiled/texture_table.h"
#include "src/scene/compiled/view.h"
#include "src/scene/description/film.h"
#include "src/scene/description/note.h"
#include "src/scene/geometry/accel.h"
#include "src/scene/geometry/geometry.h"
#include "src/vocabulary/path/features.h"
#include "src/vocabulary/path/scene_parts.h"

namespace lanelight {

struct CompiledScene {
  Vec3d center;         // world position of the scene origin
  double scale = 1;     // power of two, scene units per world unit
  FeatureSet features;  // what the scene contains (options may add or remove more)
  Geometry geometry;
  Accel accel;
  MaterialTable materials;
  TextureTable textures;
  SpectrumTable spectra;  // with kSpectral
  AlphaTable alpha;
  MediumTable media;
  LightTable lights;
  CompiledFilter filter;
  CompiledView view;  // of the description
  Integrator integrator;
  std::vector<Note> notes;  // what compiling left out, such as degenerate triangles
};

/// Returns pointers into the arguments, for kernels.
inline SceneParts PartsOf(const CompiledScene& scene, const CompiledView& view,
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

/// Returns whether alpha cuts an emitting shape.
inline bool IsCut(const CompiledScene& scene, const LightRecord& light) {
  if (scene.alpha.constant.empty() || light.primitive == 0xffffffffu) return false;
  return scene.alpha.texture[light.primitive] >= 0 ||
         scene.alpha.constant[light.primitive] < 1;
}

/// Returns whether alpha leaves nothing for rays to meet; such a shape shines as if it
/// were whole.
inline bool IsUnseen(const CompiledScene& scene, const LightRecord& light) {
  return IsCut(scene, light) && scene.alpha.texture[light.primitive] < 0 &&
         scene.alpha.constant[light.primitive] <= 0;
}

}  // namespace lanelight

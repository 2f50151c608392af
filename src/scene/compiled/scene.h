// The scene as the kernels read it: flat float32 arrays, recentred and scaled by a power
// of two (p_scene = (p_world - center) * scale), built once by CompileScene
// (src/scene/compile/compile.h) and shared by all that render it, with whatever strategy
// (src/scene/prepare/prepared_scene.h).
#pragma once

#include <cstdint>
#include <vector>

#include "src/base/core/aligned.h"
#include "src/base/core/vec.h"
#include "src/scene/accel/accel.h"
#include "src/scene/compiled/camera.h"
#include "src/scene/compiled/footprint.h"
#include "src/scene/compiled/gbuffer.h"
#include "src/scene/compiled/lights.h"
#include "src/scene/compiled/materials.h"
#include "src/scene/compiled/media.h"
#include "src/scene/compiled/spectra.h"
#include "src/scene/compiled/texture_table.h"
#include "src/scene/description/description.h"
#include "src/scene/geometry/geometry.h"
#include "src/vocabulary/path/features.h"

namespace lanelight {

/// What hangs on the camera and on the size of the film.
struct CompiledView {
  Film film;
  CompiledCamera camera;
  PixelFootprint footprint;
  GbufferSpace gbuffer;
};

struct CompiledScene {
  Vec3d center;         // world position of the scene origin
  double scale = 1;     // power of two, scene units per world unit
  FeatureSet features;  // what the scene contains (options may add or remove more)
  Geometry geometry;
  Accel accel;
  MaterialTable materials;
  TextureTable textures;
  SpectrumTable spectra;  // with kSpectral
  /// Per primitive, only with kAlpha: texture of the alpha cut-out or -1, and constant.
  AlignedVector<std::int32_t> alpha_texture;
  AlignedVector<float> alpha_constant;
  MediumTable media;
  LightTable lights;
  CompiledFilter filter;
  CompiledView view;  // of the description
  Integrator integrator;
  std::vector<Note> notes;  // what compiling left out, such as degenerate triangles
};

/// Whether alpha cuts an emitting shape.
inline bool IsCut(const CompiledScene& scene, const LightRecord& light) {
  if (scene.alpha_constant.empty() || light.primitive == 0xffffffffu) return false;
  return scene.alpha_texture[light.primitive] >= 0 ||
         scene.alpha_constant[light.primitive] < 1;
}

/// Whether alpha leaves nothing for rays to meet; such a shape shines as if it were
/// whole.
inline bool IsUnseen(const CompiledScene& scene, const LightRecord& light) {
  return IsCut(scene, light) && scene.alpha_texture[light.primitive] < 0 &&
         scene.alpha_constant[light.primitive] <= 0;
}

}  // namespace lanelight

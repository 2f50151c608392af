// The parts of a scene that kernels read: tables of plain data, each with its own header.
// A kernel includes the headers of those that it reads.
#pragma once

#include <cstdint>

namespace lanelight {

struct Geometry;        // src/scene/geometry/geometry.h
struct Accel;           // src/scene/geometry/accel.h
struct MaterialTable;   // src/scene/compiled/materials.h
struct TextureTable;    // src/scene/compiled/texture_table.h
struct SpectrumTable;   // src/scene/compiled/spectra.h
struct AlphaTable;      // src/scene/compiled/texture_table.h
struct MediumTable;     // src/scene/compiled/media.h
struct LightTable;      // src/scene/compiled/lights.h
struct LightChances;    // src/scene/compiled/lights.h
struct CompiledFilter;  // src/scene/compiled/camera.h
struct CompiledCamera;  // src/scene/compiled/camera.h
struct PixelFootprint;  // src/scene/compiled/camera.h
struct GbufferSpace;    // src/scene/compiled/camera.h

/// A primitive id counts triangles first, then spheres, disks, planes, large spheres,
/// curves.
struct PrimitiveRanges {
  // The first id of each, and the end.
  std::uint32_t spheres = 0, disks = 0, planes = 0, large_spheres = 0, curves = 0,
                end = 0;
};

/// Refers to what all renders of a scene share, the camera and film tables, and the
/// strategy's light tables. PartsOf makes it (src/scene/compiled/scene.h).
struct SceneParts {
  const Geometry* geometry = nullptr;
  const PrimitiveRanges* ranges = nullptr;  // of the geometry
  const Accel* accel = nullptr;
  const MaterialTable* materials = nullptr;
  const TextureTable* textures = nullptr;
  const SpectrumTable* spectra = nullptr;
  const AlphaTable* alpha = nullptr;
  const MediumTable* media = nullptr;
  const LightTable* lights = nullptr;
  const CompiledFilter* filter = nullptr;
  const CompiledCamera* camera = nullptr;
  const PixelFootprint* footprint = nullptr;
  const GbufferSpace* gbuffer = nullptr;
  const LightChances* chances = nullptr;
  double scale = 1;  // CompiledScene::scale
};

}  // namespace lanelight

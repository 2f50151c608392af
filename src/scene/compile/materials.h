// Material descriptions to the columns that the shading kernels gather.
#pragma once

#include <cstdint>
#include <vector>

#include "src/scene/compile/compile.h"
#include "src/scene/compile/spectrum_rows.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/description/description.h"

namespace lanelight {

struct CompiledMaterials {
  MaterialTable table;              // only materials that are used
  std::vector<std::int32_t> index;  // of each described material in it; -1 = unused
  std::vector<Index> textures;      // that the table refers to
  std::vector<Texture> derived;     // made for it; their indices follow the description's
  SpectrumRows* spectra = nullptr;  // of its colours; null: paths carry RGB
};

/// `used`: material indices that shapes refer to. Mixes bring in what they mix; a mix
/// with a constant weight of 0 or 1 is replaced by one of its sides. Throws InputError
/// for parameters that the closed forms of the kernels cannot represent. `spectra`: of
/// paths that carry wavelengths; else null.
CompiledMaterials CompileMaterials(const SceneDescription& description,
                                   const std::vector<Index>& used,
                                   const CompileOptions& options,
                                   SpectrumRows* spectra = nullptr);

/// GGX alpha of a roughness: sqrt if remapped (as pbrt-v4).
double AlphaOfRoughness(double roughness, bool remap);

}  // namespace lanelight

// Spectra of colours at the voxels of media.
#pragma once

#include "src/base/core/vec.h"
#include "src/scene/compiled/media.h"

namespace lanelight {

/// The spectrum of a colour without bound, no channel below 0, as UpsampledColor has it,
/// but by the table: looked up, not fitted. Greys are constant to the last bit.
VoxelSpectrum SpectrumOfVoxel(Rgb color);
void AppendSpectrum(Rgb color, AlignedVector<float>& values);

/// At no wavelength of a bin is it larger, as kernels evaluate it in float32, but for the
/// rounding of a few operations. Of a grey: its value.
double LargestOf(const VoxelSpectrum& spectrum);

}  // namespace lanelight

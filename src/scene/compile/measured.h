// Measured reflectance to the tables that the kernels gather.
#pragma once

#include <vector>

#include "src/scene/compile/material_row.h"

namespace lanelight {

/// The part of light that comes back, of light that falls along the normal.
Rgb HeadOnAlbedo(const MeasuredReflectance& measured);

/// Adds the tables that rows refer to, each once; none do: nothing. Of paths that carry
/// wavelengths spectra instead of colours, which are read from their files; throws
/// InputError as ReadMeasuredSpectra().
void AddMeasured(const std::vector<MaterialRow>& rows, MeasuredTable& table,
                 Transport transport = Transport::kRgb);

}  // namespace lanelight

// Measured reflectance to the tables that the kernels gather.
#pragma once

#include <vector>

#include "src/compile/material_row.h"

namespace lanelight {

/// The part of light that comes back, of light that falls along the normal.
Rgb HeadOnAlbedo(const MeasuredReflectance& measured);

/// Adds the tables that rows refer to, each once; none do: nothing.
void AddMeasured(const std::vector<MaterialRow>& rows, MeasuredTable& table);

}  // namespace lanelight

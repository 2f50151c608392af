// The columns that the guide stage fills.
#pragma once

#include "src/path/fields.h"

namespace lanelight::fields {

inline constexpr FieldSet kGuideProposal = {
    Field::guide_cell, Field::guide_x, Field::guide_y, Field::guide_z, Field::guide_pdf};

}  // namespace lanelight::fields

// Names that only pbrt-v3 and older versions have.
#pragma once

#include <string_view>

#include "src/base/core/error.h"

namespace lanelight {

/// Throws InputError if `name` is a `kind` ("directive", "material", "parameter type",
/// ...) of pbrt-v3 that pbrt-v4 does not have. The message says how to convert the file.
void CheckVersion3(const SourceLocation& where, std::string_view kind,
                   std::string_view name);

}  // namespace lanelight

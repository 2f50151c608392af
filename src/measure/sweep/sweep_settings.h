// The table [settings] of a sweep file.
#pragma once

#include "src/measure/sweep/sweep_file.h"
#include "src/measure/sweep/toml_values.h"

namespace lanelight {

/// Throws InputError for unknown keys and values that are not supported.
SweepSettings ReadSweepSettings(const TomlFile& file, const toml::table& table);

}  // namespace lanelight

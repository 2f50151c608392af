// Names of a scene file as they are compared.
#pragma once

#include <string>
#include <string_view>

namespace lanelight {

/// Returns the name in Unicode's composed form (NFC): "e" with a combining accent becomes
/// one letter, as in pbrt-v4. Returns text that is not UTF-8 unchanged.
std::string NormalizedName(std::string_view name);

}  // namespace lanelight

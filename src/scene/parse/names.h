// Names of a scene file: their normal form, and those of pbrt-v3 alone.
#pragma once

#include <string>
#include <string_view>

#include "src/base/core/error.h"

namespace lanelight {

constexpr bool IsAscii(char c) { return static_cast<unsigned char>(c) < 0x80; }

/// Returns the name in Unicode's composed form (NFC): "e" with a combining accent becomes
/// one letter, as in pbrt-v4. Returns text that is not UTF-8 unchanged.
std::string NormalizedName(std::string_view name);

/// Throws InputError if `name` is a `kind` ("directive", "material", "parameter type",
/// ...) of pbrt-v3 that pbrt-v4 does not have. The message says how to convert the file.
void CheckVersion3(const SourceLocation& where, std::string_view kind,
                   std::string_view name);

}  // namespace lanelight

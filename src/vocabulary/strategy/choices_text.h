// Compares two strategies, for messages.
#pragma once

#include <string>
#include <string_view>

namespace lanelight {

/// Returns the choices of `text` that differ from those of `other`, both complete text
/// forms (ToText): "roulette=none,reuse=block:32:random"; empty if both are the same.
std::string ChoicesNotIn(std::string_view other, std::string_view text);

}  // namespace lanelight

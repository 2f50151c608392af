// What differs between two strategies, for messages.
#pragma once

#include <string>
#include <string_view>

namespace lanelight {

/// Of two complete text forms (ToText), the choices of `text` that are not those of
/// `other`: "roulette=none,reuse=block:32:random"; empty if both are the same.
std::string ChoicesNotIn(std::string_view other, std::string_view text);

}  // namespace lanelight

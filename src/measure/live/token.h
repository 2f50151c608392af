// The secret in the address of `lanelight live`: who does not know it is not let in.
#pragma once

#include <string>
#include <string_view>

namespace lanelight::live {

/// 128 bits from the system's source of randomness, as 32 hexadecimal digits.
std::string MakeToken();

/// Returns whether both are the same, in a time that does not tell how much of them is.
bool SameToken(std::string_view a, std::string_view b);

}  // namespace lanelight::live

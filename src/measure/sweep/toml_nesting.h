// How deep a TOML file is nested.
#pragma once

#include <optional>
#include <string_view>

namespace lanelight {

/// What a sweep file has: tables in tables and parts of keys, two or three of each.
inline constexpr int kDeepestToml = 32;

struct TomlPlace {
  int line = 1, column = 1;  // in bytes
};

/// Where more than kDeepestToml brackets are open, or a key has more dots; nothing if
/// nowhere. Reading and destroying tables takes a call in a call for each of these, so
/// that a file deep enough would overflow the stack; toml++ itself counts brackets only.
std::optional<TomlPlace> TooDeepToml(std::string_view text);

}  // namespace lanelight

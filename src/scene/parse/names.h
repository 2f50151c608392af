// Names of a scene file: their normal form, tables of names, and names of pbrt-v3 alone.
#pragma once

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "src/base/core/suggest.h"

namespace lanelight {

constexpr bool IsAscii(char c) { return static_cast<unsigned char>(c) < 0x80; }

/// Returns the name in Unicode's composed form (NFC): "e" with a combining accent becomes
/// one letter, as in pbrt-v4. Returns text that is not UTF-8 unchanged.
std::string NormalizedName(std::string_view name);

/// Throws InputError if `name` is a `kind` ("directive", "material", "parameter type",
/// ...) of pbrt-v3 that pbrt-v4 does not have. The message says how to convert the file.
void CheckVersion3(const SourceLocation& where, std::string_view kind,
                   std::string_view name);

/// Returns the names of a table of pairs, for ThrowUnknown.
template <typename Table>
std::vector<std::string> Names(const Table& table) {
  std::vector<std::string> names;
  for (const auto& [name, meaning] : table) names.emplace_back(name);
  return names;
}

/// Returns the value of `name` in a table of pairs or a map. InputError with all of its
/// names if there is none: unknown <kind> "<name>".
template <typename Table>
const auto& Lookup(const Table& table, const std::string& name,
                   const SourceLocation& where, std::string_view kind) {
  const auto find = [&] {
    if constexpr (requires { table.find(name); }) {
      return table.find(name);
    } else {
      return std::find_if(std::begin(table), std::end(table),
                          [&](const auto& entry) { return entry.first == name; });
    }
  };
  const auto found = find();
  if (found == std::end(table)) {
    CheckVersion3(where, kind, name);
    ThrowUnknown(where, kind, name, Names(table));
  }
  return found->second;
}

}  // namespace lanelight

// Messages about unknown names: the name, the nearest known one, and all known ones.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "src/base/core/error.h"

namespace lanelight {

/// Edits (insert, delete, replace, swap neighbours; letter case is free) that turn `a`
/// into `b`: the restricted Damerau-Levenshtein distance.
int EditDistance(std::string_view a, std::string_view b);

/// Returns the known name with the least edit distance, or "" if none is near enough.
std::string NearestName(std::string_view found, const std::vector<std::string>& known);

/// `text` in double quotes, fit for a message: at most 60 characters, controls replaced.
std::string Quoted(std::string_view text);

/// "a", "b", "c"
std::string QuotedList(const std::vector<std::string>& names);

/// Throws InputError: unknown <kind> "<found>"; did you mean "x"? supported: "x", "y".
[[noreturn]] void ThrowUnknown(const SourceLocation& where, std::string_view kind,
                               std::string_view found,
                               const std::vector<std::string>& known);

/// The same for a name that the scene itself should define: ... the scene defines: "x",
/// or: unknown <kind> "<found>": no <kind> is defined.
[[noreturn]] void ThrowNotDefined(const SourceLocation& where, std::string_view kind,
                                  std::string_view found,
                                  const std::vector<std::string>& defined);

}  // namespace lanelight

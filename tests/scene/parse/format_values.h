// What stands in a scene that has a parameter of pbrt-v4's format: a value that the
// object takes, where any of the type would not do.
#pragma once

#include <string>
#include <vector>

#include "tests/scene/parse/format_document.h"

namespace lanelight {

/// Values to try the parameter (one type and a name) with; one at least. The line's own
/// value, if it is about one.
std::vector<std::string> FormatValues(const FormatObject& object, const FormatLine& line,
                                      const std::string& parameter);

/// Returns what follows a directive without an object, or a text in which @ is the
/// directive.
std::string FormatOperands(const FormatObject& object, const FormatLine& line);

/// Parameters without which the object is none, as "type name".
std::vector<std::string> NeededParameters(const FormatObject& object);

}  // namespace lanelight

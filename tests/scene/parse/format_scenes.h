// Scenes that have one object and one parameter of pbrt-v4's format, for the tests of
// its document, and what becomes of them.
#pragma once

#include <string>
#include <vector>

#include "tests/scene/parse/format_document.h"

namespace lanelight {

/// The result of parsing and compiling a scene.
struct FormatOutcome {
  std::string error;               // of the InputError; "" if there was none
  std::vector<std::string> notes;  // sorted
};

/// "float fov" and "texture fov" of "float|texture fov".
std::vector<std::string> TypedParameters(const FormatLine& line);
/// The last word of "float fov".
std::string ParameterName(const std::string& parameter);

/// A parameter with its type, and what it is given.
struct FormatParameter {
  std::string typed, value;
};

/// The scene with the object, what it cannot do without, and the parameter, which may be
/// of no name. `extra`: more text among the object's parameters. `value_type`: of a
/// texture.
std::string FormatScene(const FormatObject& object, const FormatParameter& parameter,
                        const std::string& extra, const std::string& value_type);

/// The scene of an operand of a directive without an object, or of an option.
std::string OperandScene(const FormatObject& object, const FormatLine& line);

/// Files that the scenes name, in a folder that must be there.
void WriteFormatFiles(const std::string& folder);

/// Parses and compiles a scene that stands in the folder.
FormatOutcome RunFormatScene(const std::string& text, const std::string& folder);

}  // namespace lanelight

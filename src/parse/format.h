// The table of pbrt-v4's file format: every directive, object and parameter, and what
// becomes of it here. The parser takes its reasons for refusing an object from it,
// docs/pbrt-format.md is made of it, and a test runs a scene for every line of it
// (tests/parse/format_test.cc), so it cannot go stale.
//
// When something that was refused is rendered from now on, change one word of its line
// in format_*.cc; the test names the lines that are not true.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lanelight {

/// kRendered: does what pbrt-v4 does, no note. kNoted: accepted, with a note that says
/// what is done instead. kRefused: an InputError that names it.
enum class FormatStatus { kRendered, kNoted, kRefused };

struct FormatLine {
  /// "type name", "type|type name" if the types fare alike; operands of directives that
  /// have no object.
  const char* parameter;
  FormatStatus status;
  const char* why = "";  // in short; of what is noted or refused
  /// As it stands in a scene; "": any value of the type. Of operands: what follows the
  /// directive, or a text with the directive's place marked by @.
  const char* value = "";
  bool needed = false;  // the object is none without it
};

struct FormatObject {
  const char* directive;
  const char* type;  // "" of directives that have no object
  FormatStatus status;
  const char* why;  // a refusal's: part of the error's text, if not ""
  std::vector<FormatLine> lines;
};
using FormatTable = std::vector<FormatObject>;

// In the order of the documentation, one file for each part of a scene.
FormatTable DirectiveFormat();
FormatTable OptionFormat();  // cameras, films, filters, samplers, integrators, ...
FormatTable ShapeFormat();
FormatTable LightFormat();
FormatTable MaterialFormat();
FormatTable TextureFormat();
FormatTable MediumFormat();

/// All of them.
const FormatTable& PbrtFormat();

/// Why the table refuses objects of this type; "" if it does not, or gives no reason.
std::string_view WhyRefused(std::string_view directive, std::string_view type);

/// The whole table, as docs/pbrt-format.md has it (format_text.cc).
std::string FormatDocument();

}  // namespace lanelight

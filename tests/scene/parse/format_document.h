// docs/pbrt-format.md, read back: what it says of every directive, object and parameter.
#pragma once

#include <string>
#include <vector>

namespace lanelight {

/// kRendered: does what pbrt-v4 does, no note. kNoted: accepted, with a note that says
/// what is done instead. kRefused: an InputError that names it.
enum class FormatStatus { kRendered, kNoted, kRefused };
/// "rendered", "noted", "refused": as the document has them.
const char* FormatWord(FormatStatus status);

struct FormatLine {
  /// "type name", "type|type name" if the types fare alike; operands of directives that
  /// have no object.
  std::string parameter;
  FormatStatus status = FormatStatus::kRendered;
  std::string why;    // in short; of what is noted or refused
  std::string value;  // as it stands in a scene, if the line is about one; else ""
};

struct FormatObject {
  std::string directive;
  std::string type;  // "" of directives that have no object
  FormatStatus status = FormatStatus::kRendered;
  std::string why;  // a refusal's: part of the error's text, if not ""
  std::vector<FormatLine> lines;
};
using FormatTable = std::vector<FormatObject>;

/// In the order of the document. Fails the test for text that is no line of a table where
/// one should stand.
FormatTable ReadFormat(const std::string& document);

/// The summary that the document opens with, as it must be for this table.
std::string FormatSummary(const FormatTable& table);

}  // namespace lanelight

// The table as text: docs/pbrt-format.md.
#include <algorithm>
#include <map>

#include "src/core/error.h"
#include "src/parse/format.h"

namespace lanelight {
namespace {

const char* Word(FormatStatus status) {
  constexpr const char* kWords[] = {"rendered", "noted", "refused"};
  return kWords[static_cast<int>(status)];
}

// Fit for a cell of a table.
std::string Cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != text.npos; at += 2) {
    text.insert(at, "\\");
  }
  return text;
}

// "float phimax (180)": the value where a parameter has several lines.
std::string Named(const FormatObject& object, const FormatLine& line) {
  const std::string name = line.parameter;
  const auto same = [&](const FormatLine& other) { return other.parameter == name; };
  const bool several = std::count_if(object.lines.begin(), object.lines.end(), same) > 1;
  if (!several) return name;
  std::string value = line.value;
  if (value.starts_with('[')) value = line.why;
  return value.empty() ? name : fmt::format("{} ({})", name, value);
}

std::string Heading(const FormatObject& object) {
  const std::string type = object.type;
  return type.empty() ? std::string(object.directive)
                      : fmt::format("{} \"{}\"", object.directive, type);
}

std::string Rows(const FormatObject& object) {
  std::string text;
  for (const FormatLine& line : object.lines) {
    std::string name = Named(object, line);
    if (!name.empty()) name = "`" + Cell(name) + "`";
    text += fmt::format("| {} | {} | {} |\n", name, Word(line.status), Cell(line.why));
  }
  return text;
}

std::string Section(const FormatObject& object) {
  std::string text = fmt::format("\n### {}\n\n{}", Heading(object), Word(object.status));
  const std::string why = object.why;
  text += why.empty() ? "\n" : ": " + why + "\n";
  if (object.lines.empty()) return text;
  return text + "\n| parameter | | |\n|---|---|---|\n" + Rows(object);
}

std::string Directives() {
  std::string text =
      "\n## Directives without parameters\n\n| directive | operands | | |\n"
      "|---|---|---|---|\n";
  for (const FormatObject& object : DirectiveFormat()) {
    for (const FormatLine& line : object.lines) {
      text += fmt::format("| {} | {} | {} | {} |\n", object.directive,
                          Cell(line.parameter), Word(line.status), Cell(line.why));
    }
  }
  return text;
}

// Types by directive and by what becomes of them.
std::string Summary() {
  std::vector<std::string> order;
  std::map<std::string, std::string> types[3];
  for (const FormatObject& object : PbrtFormat()) {
    const std::string directive = object.directive, type = object.type;
    if (type.empty()) continue;
    if (order.empty() || order.back() != directive) order.push_back(directive);
    std::string& list = types[static_cast<int>(object.status)][directive];
    list += fmt::format("{}`{}`", list.empty() ? "" : ", ", type);
  }
  std::string text = "| | rendered | noted | refused |\n|---|---|---|---|\n";
  for (const std::string& directive : order) {
    text += fmt::format("| {} | {} | {} | {} |\n", directive, types[0][directive],
                        types[1][directive], types[2][directive]);
  }
  return text;
}

}  // namespace

std::string FormatDocument() {
  std::string text =
      "# The file format of pbrt-v4\n\n"
      "Written by `lanelight info --format` from the table that the parser has "
      "(`src/parse/format.h`);\na test renders a scene for every line. *rendered*: as in "
      "pbrt-v4. *noted*: accepted, and a\nnote says what is done instead. *refused*: an "
      "error names it; nothing is rendered. Several\ntypes of a parameter are parted by "
      "|. `plane`, `\"string scattering\"` and `\"string strategy\"`\nare Lanelight's "
      "own.\n";
  text += "\n## In short\n\n" + Summary() + Directives();
  std::string directive;
  for (const FormatObject& object : PbrtFormat()) {
    const bool plain =
        std::string(object.type).empty() && object.directive != std::string("Option");
    if (plain) continue;
    if (directive != object.directive) {
      directive = object.directive;
      text += fmt::format("\n## {}\n", directive);
    }
    text += Section(object);
  }
  return text;
}

}  // namespace lanelight

#include "tests/scene/parse/format_document.h"

#include <fmt/format.h>

#include <array>
#include <catch2/catch.hpp>
#include <map>
#include <regex>
#include <sstream>

#include "src/base/core/error.h"

namespace lanelight {
namespace {

constexpr const char* kStatusWords[] = {"rendered", "noted", "refused"};

FormatStatus StatusNamed(const std::string& word) {
  for (int i = 0; i < 3; ++i) {
    if (word == kStatusWords[i]) return static_cast<FormatStatus>(i);
  }
  FAIL("docs/pbrt-format.md: what is \"" << word << "\"?");
  return {};
}

// Of a row of a table, without the bars and what masks those within.
std::vector<std::string> Cells(const std::string& row) {
  std::vector<std::string> cells;
  std::string cell;
  for (std::size_t i = 1; i < row.size(); ++i) {
    if (row[i] == '\\' && i + 1 < row.size()) {
      cell += row[++i];
    } else if (row[i] == '|') {
      const std::size_t from = cell.find_first_not_of(' ');
      const std::size_t to = cell.find_last_not_of(' ');
      cells.push_back(from == cell.npos ? "" : cell.substr(from, to + 1 - from));
      cell.clear();
    } else {
      cell += row[i];
    }
  }
  return cells;
}

// "`float phimax (180)`": a line about one value.
FormatLine ParameterLine(const std::vector<std::string>& cells) {
  static const std::regex kParameter("`([^ ]+ [^ ]+)(?: \\((.*)\\))?`");
  std::smatch match;
  INFO(cells[0]);
  REQUIRE(cells.size() == 3);
  REQUIRE(std::regex_match(cells[0], match, kParameter));
  return {match[1], StatusNamed(cells[1]), cells[2], match[2]};
}

// `Shape "sphere"` or `Option`.
FormatObject Heading(const std::string& text) {
  static const std::regex kHeading("(\\w+)(?: \"(\\w+)\")?");
  std::smatch match;
  INFO(text);
  REQUIRE(std::regex_match(text, match, kHeading));
  return {match[1], match[2], FormatStatus::kRendered, "", {}};
}

// "refused: why".
void ReadStatus(const std::string& line, FormatObject& object) {
  const std::size_t colon = line.find(": ");
  object.status = StatusNamed(line.substr(0, colon));
  if (colon != line.npos) object.why = line.substr(colon + 2);
}

// A row of the table of directives that have no object.
void AddOperands(const std::vector<std::string>& cells, FormatTable& table) {
  REQUIRE(cells.size() == 4);
  if (table.empty() || table.back().directive != cells[0]) {
    table.push_back({cells[0], "", FormatStatus::kRendered, "", {}});
  }
  table.back().lines.push_back({cells[1], StatusNamed(cells[2]), cells[3], ""});
}

}  // namespace

const char* FormatWord(FormatStatus status) {
  return kStatusWords[static_cast<int>(status)];
}

FormatTable ReadFormat(const std::string& document) {
  enum class Part { kNone, kDirectives, kObjects } part = Part::kNone;
  FormatTable table;
  std::istringstream text(document);
  for (std::string line; std::getline(text, line);) {
    const bool row = line.starts_with("| ") && !line.starts_with("| |") &&
                     !line.starts_with("| parameter |") &&
                     !line.starts_with("| directive |");
    if (line.starts_with("### ")) {
      table.push_back(Heading(line.substr(4)));
    } else if (line.starts_with("## ")) {
      const bool directives = line == "## Directives without parameters";
      part = directives              ? Part::kDirectives
             : line == "## In short" ? Part::kNone
                                     : Part::kObjects;
    } else if (part == Part::kDirectives && row) {
      AddOperands(Cells(line), table);
    } else if (part == Part::kObjects && row) {
      table.back().lines.push_back(ParameterLine(Cells(line)));
    } else if (part == Part::kObjects && !line.empty() && line[0] != '|') {
      ReadStatus(line, table.back());
    }
  }
  return table;
}

std::string FormatSummary(const FormatTable& table) {
  std::vector<std::string> order;
  std::map<std::string, std::array<std::string, 3>> types;
  for (const FormatObject& object : table) {
    if (object.type.empty()) continue;
    if (order.empty() || order.back() != object.directive) {
      order.push_back(object.directive);
    }
    std::string& list = types[object.directive][static_cast<std::size_t>(object.status)];
    list += fmt::format("{}`{}`", list.empty() ? "" : ", ", object.type);
  }
  std::string text = "| | rendered | noted | refused |\n|---|---|---|---|\n";
  for (const std::string& directive : order) {
    const auto& [rendered, noted, refused] = types[directive];
    text += fmt::format("| {} | {} | {} | {} |\n", directive, rendered, noted, refused);
  }
  return text;
}

}  // namespace lanelight

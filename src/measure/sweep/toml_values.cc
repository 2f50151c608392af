#include "src/measure/sweep/toml_values.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "src/base/core/check.h"
#include "src/base/core/source_location.h"
#include "src/base/core/suggest.h"

namespace lanelight {
namespace {

// Largest nesting of brackets and dots in keys; a sweep file needs two or three.
constexpr int kMaxTomlDepth = 32;

struct TomlPlace {
  int line = 1, column = 1;  // in bytes
};

// Returns the end of the string that begins at text[at]. An open string ends with its
// line, where the parser reports it.
std::size_t EndOfString(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const std::string_view three = quote == '"' ? "\"\"\"" : "'''";
  const bool many_lines = text.substr(at, 3) == three;
  for (at += many_lines ? 3 : 1; at < text.size(); ++at) {
    if (quote == '"' && text[at] == '\\') {
      ++at;
    } else if (!many_lines && (text[at] == quote || text[at] == '\n')) {
      return at + 1;
    } else if (many_lines && text.substr(at, 3) == three) {
      // Up to two more quotes may belong to the string.
      return std::min(text.find_first_not_of(quote, at), text.size());
    }
  }
  return text.size();
}

TomlPlace PlaceOf(std::string_view text, std::size_t at) {
  const std::string_view before = text.substr(0, at);
  return {1 + int(std::ranges::count(before, '\n')),
          int(at - before.rfind('\n'))};  // npos is -1
}

// Returns where more than kMaxTomlDepth brackets are open, or a key has more dots.
// Reading and destroying tables recurses once per level and could overflow the stack;
// toml++ itself limits brackets only.
std::optional<TomlPlace> TooDeepToml(std::string_view text) {
  int open = 0, dots = 0;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      at = EndOfString(text, at);
      continue;
    }
    if (c == '#') {
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    if (c == '.') ++dots;
    if (c == '\n' || c == '=' || c == ',') dots = 0;
    if (c == '[' || c == '{') ++open;
    if (c == ']' || c == '}') --open;
    if (dots > kMaxTomlDepth || open > kMaxTomlDepth) return PlaceOf(text, at);
    ++at;
  }
  return std::nullopt;
}

std::string Kind(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "the text " + Quoted(node.value_or(std::string()));
    case toml::node_type::integer:
      return fmt::format("the integer {}", node.value_or(std::int64_t{0}));
    case toml::node_type::floating_point:
      return fmt::format("the number {}", node.value_or(0.0));
    case toml::node_type::boolean:
      return node.value_or(false) ? "true" : "false";
    default:
      return "a date or time";
  }
}

}  // namespace

TomlFile::TomlFile(const std::string& path, const std::string& text)
    : name_(std::make_shared<const std::string>(path)) {
  if (const auto deep = TooDeepToml(text)) {
    throw InputError({name_, deep->line, deep->column},
                     "tables, arrays or keys are nested more than {} deep; a "
                     "sweep file needs two levels",
                     kMaxTomlDepth);
  }
  try {
    root_ = toml::parse(text, path);
  } catch (const toml::parse_error& error) {
    throw InputError(Where(error.source()), "invalid TOML: {}", error.description());
  }
}

SourceLocation TomlFile::Where(const toml::source_region& region) const {
  return {name_, int(region.begin.line), int(region.begin.column)};
}

void TomlFile::Refuse(const std::string& key, const toml::node& node,
                      const std::string& right) const {
  throw InputError(Where(node), "{} is {}; it should be {}", key, Kind(node), right);
}

const toml::table& TomlFile::Table(const std::string& key, const toml::node& node) const {
  if (const toml::table* table = node.as_table()) return *table;
  Refuse(key, node, fmt::format("a table: [{}] on a line of its own", key));
}

std::vector<const toml::table*> TomlFile::Tables(const std::string& key,
                                                 const toml::node& node) const {
  const std::string right = fmt::format("tables: [[{}]] on a line before each", key);
  const toml::array* array = node.as_array();
  if (array == nullptr || array->empty()) Refuse(key, node, right);
  std::vector<const toml::table*> tables;
  for (const toml::node& item : *array) {
    if (!item.is_table()) Refuse(key, item, right);
    tables.push_back(item.as_table());
  }
  return tables;
}

std::string TomlFile::Value(const std::string& key, ValueForm form,
                            const toml::node& node) const {
  // Counts and times with units are texts.
  const bool number = form == ValueForm::kInteger || form == ValueForm::kNumber;
  if (const auto* text = node.as_string(); number && text) {
    if (!ParseNumber<double>(text->get())) return text->get();
  }
  switch (form) {
    case ValueForm::kFlag:
      return As<bool>(key, node, "true or false") ? "true" : "false";
    case ValueForm::kInteger:
      return std::to_string(As<std::int64_t>(key, node, "an integer"));
    case ValueForm::kNumber:
      return fmt::format("{}", Number(key, node));
    case ValueForm::kText:
    case ValueForm::kSize:
      return As<std::string>(key, node, "a text in quotes");
    case ValueForm::kWindow:
      return Window(key, node);
  }
  LL_CHECK(false);
  return "";
}

std::string TomlFile::Window(const std::string& key, const toml::node& node) const {
  const toml::array* array = node.as_array();
  if (array == nullptr) Refuse(key, node, "an array: [x0, y0, x1, y1]");
  std::string text;
  for (const toml::node& side : *array) {
    text += (text.empty() ? "" : ",") +
            std::to_string(As<std::int64_t>(key, side, "an integer"));
  }
  return text;
}

double TomlFile::Number(const std::string& key, const toml::node& node) const {
  if (const auto* integer = node.as_integer()) return double(integer->get());
  const auto* number = node.as_floating_point();
  if (number == nullptr || !std::isfinite(number->get())) Refuse(key, node, "a number");
  return number->get();
}

}  // namespace lanelight

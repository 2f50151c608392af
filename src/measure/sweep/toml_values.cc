#include "src/measure/sweep/toml_values.h"

#include <cmath>

#include "src/base/core/check.h"
#include "src/base/core/source_location.h"
#include "src/base/core/suggest.h"
#include "src/measure/sweep/toml_nesting.h"

namespace lanelight {
namespace {

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
                     fmt::format("tables, arrays or keys lie more than {} deep in each "
                                 "other; a sweep file has them two deep",
                                 kDeepestToml));
  }
  try {
    root_ = toml::parse(text, path);
  } catch (const toml::parse_error& error) {
    throw InputError(Where(error.source()),
                     fmt::format("this is not TOML: {}", error.description()));
  }
}

SourceLocation TomlFile::Where(const toml::source_region& region) const {
  return {name_, static_cast<int>(region.begin.line),
          static_cast<int>(region.begin.column)};
}

void TomlFile::Refuse(const std::string& key, const toml::node& node,
                      const std::string& right) const {
  throw InputError(Where(node),
                   fmt::format("{} is {}; it should be {}", key, Kind(node), right));
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
  // Counts and times have texts too, where they have units.
  const bool number = form == ValueForm::kInteger || form == ValueForm::kNumber;
  if (number && node.is_string() && !ParseNumber<double>(Text(key, node))) {
    return Text(key, node);
  }
  switch (form) {
    case ValueForm::kFlag:
      return Flag(key, node) ? "true" : "false";
    case ValueForm::kInteger:
      return std::to_string(Integer(key, node));
    case ValueForm::kNumber:
      return fmt::format("{}", Number(key, node));
    case ValueForm::kText:
    case ValueForm::kSize:
      return Text(key, node);
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
    text += (text.empty() ? "" : ",") + std::to_string(Integer(key, side));
  }
  return text;
}

std::string TomlFile::Text(const std::string& key, const toml::node& node) const {
  if (const auto* text = node.as_string()) return text->get();
  Refuse(key, node, "a text in quotes");
}

bool TomlFile::Flag(const std::string& key, const toml::node& node) const {
  if (const auto* flag = node.as_boolean()) return flag->get();
  Refuse(key, node, "true or false");
}

std::int64_t TomlFile::Integer(const std::string& key, const toml::node& node) const {
  if (const auto* integer = node.as_integer()) return integer->get();
  Refuse(key, node, "an integer");
}

double TomlFile::Number(const std::string& key, const toml::node& node) const {
  if (const auto* integer = node.as_integer()) return double(integer->get());
  const auto* number = node.as_floating_point();
  if (number == nullptr || !std::isfinite(number->get())) Refuse(key, node, "a number");
  return number->get();
}

}  // namespace lanelight

#include "src/measure/sweep/sweep_file.h"

#include <fmt/format.h>

#include "src/base/core/source_location.h"
#include "src/base/core/suggest.h"
#include "src/vocabulary/strategy/strategy.h"

namespace lanelight {
namespace {

constexpr std::size_t kMaxPatternStrategies = 10000;

struct OpenPart {
  std::string before;  // fixed text since the previous open part
  std::string name;
  std::vector<std::string> values;
};

std::string Trimmed(const std::string& text, const char* spaces = " \t") {
  const std::size_t first = text.find_first_not_of(spaces);
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(spaces) + 1 - first);
}

std::vector<std::string> ChoicesOf(const std::string& axis, const SourceLocation& where) {
  std::vector<std::string> names, axes;
  for (const ChoiceInfo& choice : AllChoices()) {
    if (axes.empty() || axes.back() != choice.axis) axes.emplace_back(choice.axis);
    if (axis == choice.axis) names.emplace_back(choice.name);
  }
  if (names.empty()) ThrowUnknown(where, "axis of strategies before \"=*\"", axis, axes);
  return names;
}

class PatternReader {
 public:
  PatternReader(const std::string& text, const SourceLocation& where)
      : text_(text), where_(where) {}

  // Returns the open parts; `rest` is the text after the last one.
  std::vector<OpenPart> Read(std::string& rest) {
    for (std::size_t at = 0; at < text_.size(); ++at) {
      if (text_[at] == ',') item_ = at + 1;
      if (text_[at] == '}') Fail("'}' without '{'");
      if (text_[at] == '{') at = List(at);
      if (text_[at] == '*') ExpandStar(at);
    }
    rest = text_.substr(fixed_);
    return std::move(parts_);
  }

 private:
  [[noreturn]] void Fail(const std::string& message) const {
    throw InputError(where_, "strategy {}: {}", Quoted(text_), message);
  }

  // Reads a list in braces and returns its end.
  std::size_t List(std::size_t at) {
    const std::size_t close = text_.find('}', at);
    if (close == std::string::npos) Fail("'{' without '}'");
    std::vector<std::string> values;
    for (std::size_t from = at + 1; from <= close;) {
      const std::size_t end = std::min(text_.find(',', from), close);
      values.push_back(Trimmed(text_.substr(from, end - from)));
      if (values.back().empty()) Fail("a value of the list in braces is empty");
      from = end + 1;
    }
    Add(at, close, Trimmed(text_.substr(item_, at - item_), " \t=:"), std::move(values));
    return close;
  }

  void ExpandStar(std::size_t at) {
    const bool ends = at + 1 == text_.size() || text_[at + 1] == ',';
    if (at == item_ || text_[at - 1] != '=' || !ends) {
      Fail(
          "'*' stands for all choices of an axis, as in points=*; numbers are listed, as "
          "in roulette=throughput:{0.05, 0.2}");
    }
    const std::string axis = text_.substr(item_, at - 1 - item_);
    Add(at, at, axis, ChoicesOf(axis, where_));
  }

  void Add(std::size_t first, std::size_t last, std::string name,
           std::vector<std::string> values) {
    if (name.empty())
      Fail("a list in braces needs a key before it, as in points={halton}");
    parts_.push_back(
        {text_.substr(fixed_, first - fixed_), std::move(name), std::move(values)});
    fixed_ = last + 1;
  }

  const std::string& text_;
  const SourceLocation& where_;
  std::vector<OpenPart> parts_;
  std::size_t item_ = 0, fixed_ = 0;  // where an item, and fixed text, begin
};

}  // namespace

std::vector<PatternStrategy> ExpandStrategy(const std::string& text,
                                            const SourceLocation& where) {
  std::string rest;
  const std::vector<OpenPart> parts = PatternReader(text, where).Read(rest);
  std::string family;
  std::vector<PatternStrategy> all(1);
  for (const OpenPart& part : parts) {
    family += part.before + "*";
    std::vector<PatternStrategy> longer;
    for (const PatternStrategy& start : all) {
      for (const std::string& value : part.values) {
        longer.push_back(start);
        longer.back().text += part.before + value;
        longer.back().place.parameters[part.name] = value;
      }
      if (longer.size() <= kMaxPatternStrategies) continue;
      throw InputError(where, "strategy {} stands for more than {} strategies",
                       Quoted(text), kMaxPatternStrategies);
    }
    all = std::move(longer);
  }
  for (PatternStrategy& strategy : all) {
    strategy.text += rest;
    strategy.place.family = family + rest;
  }
  return all;
}

}  // namespace lanelight

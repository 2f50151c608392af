
#include <fmt/format.h>

#include <fast_float/fast_float.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/base/core/suggest.h"
#include "src/scene/parse/lex.h"

namespace lanelight {
namespace {

bool IsDigit(char c) { return c >= '0' && c <= '9'; }
bool StartsIt(char c) { return IsDigit(c) || c == '.' || c == '-' || c == '+'; }
bool ContinuesIt(char c) { return StartsIt(c) || c == 'e' || c == 'E'; }
bool IsSpace(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

// Reads a text and counts lines.
class NumberText {
 public:
  NumberText(std::string_view text, std::shared_ptr<const std::string> file)
      : cursor_(text.data()),
        end_(cursor_ + text.size()),
        line_start_(cursor_),
        file_(std::move(file)) {}

  bool AtEnd() const { return cursor_ == end_; }

  // Skips a blank or a comment; false if there is none.
  bool SkipOne() {
    if (*cursor_ == '#') {
      while (!AtEnd() && !EndsLine(cursor_, end_)) ++cursor_;
      return true;
    }
    if (!IsSpace(*cursor_)) return false;
    const bool ends = EndsLine(cursor_++, end_);
    if (ends) ++line_, line_start_ = cursor_;
    return true;
  }

  double Number() {
    const char* begin = cursor_;
    if (!StartsIt(*begin)) {
      Fail(begin, "found {}, expected a number; comments start with #",
           Quoted({begin, 1}));
    }
    while (!AtEnd() && ContinuesIt(*cursor_)) ++cursor_;
    const std::string_view word(begin, static_cast<std::size_t>(cursor_ - begin));
    const char* first = *begin == '+' ? begin + 1 : begin;
    double value = 0;
    const auto result = fast_float::from_chars(first, cursor_, value);
    if (result.ec == std::errc::invalid_argument || result.ptr != cursor_ ||
        !std::isfinite(value)) {
      Fail(begin, "{} is not a finite number", Quoted(word));
    }
    if (!AtEnd() && !IsSpace(*cursor_) && *cursor_ != '#') ++cursor_;
    return value;
  }

 private:
  template <class... Args>
  [[noreturn]] void Fail(const char* at, fmt::format_string<Args...> format,
                         Args&&... args) const {
    throw InputError({file_, line_, static_cast<int>(at - line_start_) + 1},
                     fmt::format(format, std::forward<Args>(args)...));
  }

  const char* cursor_;
  const char* end_;
  const char* line_start_;
  int line_ = 1;
  std::shared_ptr<const std::string> file_;
};

}  // namespace

std::vector<double> ReadNumbers(std::string_view text,
                                std::shared_ptr<const std::string> file) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  NumberText numbers(text, std::move(file));
  std::vector<double> values;
  while (!numbers.AtEnd()) {
    if (!numbers.SkipOne()) values.push_back(numbers.Number());
  }
  return values;
}

}  // namespace lanelight

#include "src/measure/sweep/toml_nesting.h"

#include <algorithm>

namespace lanelight {
namespace {

// Behind the string that begins at text[at]. One that is not closed ends with its line,
// as the parser, too, takes it for a mistake there.
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
      // Two more may belong to it.
      return std::min(text.find_first_not_of(quote, at), text.size());
    }
  }
  return text.size();
}

TomlPlace PlaceOf(std::string_view text, std::size_t at) {
  const std::string_view before = text.substr(0, at);
  return {1 + static_cast<int>(std::count(before.begin(), before.end(), '\n')),
          static_cast<int>(at - before.rfind('\n'))};  // npos is -1
}

}  // namespace

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
    if (dots > kDeepestToml || open > kDeepestToml) return PlaceOf(text, at);
    ++at;
  }
  return std::nullopt;
}

}  // namespace lanelight

#include "src/base/core/suggest.h"

#include <fmt/format.h>

#include <algorithm>

#include "src/base/core/source_location.h"

namespace lanelight {
namespace {

// Longer input is never a misspelt name, and the distance costs length^2.
constexpr std::size_t kLongestComparedName = 64;

char Lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

std::string Unknown(std::string_view kind, std::string_view found,
                    const std::vector<std::string>& known) {
  const std::string nearest = NearestName(found, known);
  return fmt::format(
      "unknown {} {}; {}", kind, Quoted(found),
      nearest.empty() ? "" : fmt::format("did you mean {}? ", Quoted(nearest)));
}

}  // namespace

int EditDistance(std::string_view a, std::string_view b) {
  const std::size_t columns = b.size() + 1;
  std::vector<int> before(columns), last(columns), row(columns);
  for (std::size_t j = 0; j < columns; ++j) last[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j < columns; ++j) {
      const bool same = Lower(a[i - 1]) == Lower(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && Lower(a[i - 1]) == Lower(b[j - 2]) &&
                           Lower(a[i - 2]) == Lower(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(row);
  }
  return last.back();
}

std::string NearestName(std::string_view found, const std::vector<std::string>& known) {
  if (found.size() > kLongestComparedName) return "";
  const int length = static_cast<int>(found.size());
  const int limit = length < 3 ? 1 : std::max(2, length / 3);
  int best = limit + 1;
  std::string nearest;
  for (const std::string& name : known) {
    const int distance = EditDistance(found, name);
    // Part of a name, such as "lambert", is meant however long the rest is.
    const bool is_part = found.size() >= 3 && name.find(found) != name.npos;
    if (is_part && best > 1) {
      best = 1;
      nearest = name;
    }
    // A distance as long as the name itself says only that both are short.
    if (distance >= best || distance >= static_cast<int>(name.size())) continue;
    best = distance;
    nearest = name;
  }
  return nearest;
}

std::string Quoted(std::string_view text) {
  constexpr std::size_t kLongestShown = 60;
  std::string out = "\"";
  for (char c : text.substr(0, kLongestShown)) {
    const auto byte = static_cast<unsigned char>(c);
    out += byte < 0x20 || byte == 0x7f ? '?' : c;
  }
  if (text.size() > kLongestShown) out += "...";
  return out + '"';
}

std::string QuotedList(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + Quoted(name);
  return out;
}

void ThrowUnknown(const SourceLocation& where, std::string_view kind,
                  std::string_view found, const std::vector<std::string>& known) {
  throw InputError(where,
                   Unknown(kind, found, known) + "supported: " + QuotedList(known));
}

void ThrowNotDefined(const SourceLocation& where, std::string_view kind,
                     std::string_view found, const std::vector<std::string>& defined) {
  if (defined.empty()) {
    throw InputError(where, "unknown {0} {1}: no {0} is defined", kind, Quoted(found));
  }
  throw InputError(
      where, Unknown(kind, found, defined) + "the scene defines: " + QuotedList(defined));
}

}  // namespace lanelight

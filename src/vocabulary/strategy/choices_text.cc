#include "src/vocabulary/strategy/choices_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace lanelight {

std::string ChoicesNotIn(std::string_view other, std::string_view text) {
  const std::string all = fmt::format(",{},", other);
  std::string found;
  while (!text.empty()) {
    const std::string_view choice = text.substr(0, text.find(','));
    text.remove_prefix(std::min(choice.size() + 1, text.size()));
    if (all.find(fmt::format(",{},", choice)) != all.npos) continue;
    found += (found.empty() ? "" : ",") + std::string(choice);
  }
  return found;
}

}  // namespace lanelight

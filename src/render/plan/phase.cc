#include "src/render/plan/phase.h"

namespace lanelight {

std::string_view Prefix(PhaseId id) {
  static constexpr std::string_view kPrefixes[] = {
#define X(name, prefix, meaning) prefix,
      LANELIGHT_PHASES(X)
#undef X
  };
  return kPrefixes[static_cast<int>(id)];
}

const char* Meaning(PhaseId id) {
  static constexpr const char* kMeanings[] = {
#define X(name, prefix, meaning) meaning,
      LANELIGHT_PHASES(X)
#undef X
  };
  return kMeanings[static_cast<int>(id)];
}

}  // namespace lanelight

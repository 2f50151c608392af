#include "src/vocabulary/path/stage.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

namespace lanelight {

const char* Name(StageRole role) {
  static const auto kNames = [] {
    std::array names = {
#define X(name, meaning) std::string(#name),
        LANELIGHT_STAGE_ROLES(X)
#undef X
    };
    for (std::string& name : names) {
      name[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(name[0])));
    }
    return names;
  }();
  return kNames[static_cast<std::size_t>(role)].c_str();
}

}  // namespace lanelight

// study.json as tests compare it.
#pragma once

#include <nlohmann/json.hpp>

#include "tests/support/json.h"

namespace lanelight {

using test::ReadJson;

/// Removes seconds, and what is computed from them, and what else the machine was doing.
inline void RemoveTimings(nlohmann::json& json) {
  for (const char* name :
       {"seconds", "cpu_seconds", "wall_seconds", "efficiency", "efficiency_trimmed",
        "rank", "ranking", "to_target", "verdict", "cautions", "ns_per_item", "share",
        "machine", "machines"}) {
    if (json.is_object()) json.erase(name);
  }
  if (!json.is_structured()) return;
  for (nlohmann::json& child : json) RemoveTimings(child);
}

}  // namespace lanelight

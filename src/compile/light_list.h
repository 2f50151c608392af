// The light table while it is being made, and what its records have in common.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "src/compile/store.h"
#include "src/compiled/lights.h"

namespace lanelight {

struct LightList {
  LightTable table;
  std::vector<double> power;  // of each light

  /// Returns the index of the light.
  std::int32_t Push(const LightRecord& record, double its_power) {
    table.lights.push_back(record);
    power.push_back(its_power);
    return static_cast<std::int32_t>(table.lights.size()) - 1;
  }
};

/// Of no primitive and no environment; all else is 0.
inline LightRecord EmptyRecord(LightShape shape) {
  LightRecord record{};
  record.shape = static_cast<std::uint32_t>(shape);
  record.primitive = 0xffffffffu;
  record.environment = -1;
  return record;
}

}  // namespace lanelight

// The light table while it is being made, and what its records have in common.
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "src/base/core/error.h"
#include "src/scene/compile/range.h"
#include "src/scene/compile/store.h"
#include "src/scene/compiled/lights.h"

namespace lanelight {

[[noreturn]] inline void ThrowTooBright(const SourceLocation& where) {
  throw InputError(where, "this light emits more than float32 holds (3.4e38)");
}

struct LightList {
  LightTable table;
  std::vector<double> power;         // of each light
  std::vector<OwnSpectrum> spectra;  // of each, where it is not by an image

  /// Returns the index of the light. Throws InputError if its power is no number. `of`:
  /// the Light or AreaLight that it is.
  template <class Described>
  std::int32_t Push(const LightRecord& record, double its_power, const Described& of) {
    if (!std::isfinite(its_power)) ThrowTooBright(of.where);
    table.lights.push_back(record);
    power.push_back(its_power);
    spectra.push_back(of.spectrum);
    return static_cast<std::int32_t>(table.lights.size()) - 1;
  }
};

/// Where a light with a place stands, in scene coordinates. Throws InputError if that is
/// beyond them.
inline Vec3d PositionOf(const Light& light, const WorldFrame& frame) {
  const Vec3d position = frame.Point(light.world_from_light.Point(light.from));
  RequireInScene(position, light.where, "light");
  return position;
}

/// Returns a record without primitive or environment, otherwise 0.
inline LightRecord EmptyRecord(LightShape shape) {
  LightRecord record{};
  record.shape = static_cast<std::uint32_t>(shape);
  record.primitive = 0xffffffffu;
  record.environment = -1;
  return record;
}

}  // namespace lanelight

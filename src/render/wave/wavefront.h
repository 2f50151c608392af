// The memory of one wavefront: live columns and queues, allocated once per thread and
// reused by every task.
#pragma once

#include <cstddef>
#include <vector>

#include "src/base/core/aligned.h"
#include "src/render/plan/plan.h"
#include "src/vocabulary/path/wave.h"

namespace lanelight {

/// The constants of a render that scene and plan decide; without seed and tables.
RunParameters MakeRunParameters(const PreparedScene& scene, const Plan& plan);
/// RunParameters::exposure.
float ExposureOf(const PreparedScene& scene);

class Wavefront {
 public:
  Wavefront(const PreparedScene& scene, const Plan& plan, const RunParameters& run);

  Wave& wave() { return wave_; }
  /// Bytes of columns and queues.
  std::size_t bytes() const { return memory_.size() * sizeof(std::uint32_t); }
  /// The same memory, with columns for these features alone: a part of the plan's.
  Wave Narrowed(const FeatureSet& features) const;

 private:
  // The room for copies of paths that split is mostly never touched.
  UntouchedVector<std::uint32_t> memory_;
  Wave wave_;
};

}  // namespace lanelight

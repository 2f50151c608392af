// The memory of one wavefront: live columns and queues, allocated once per thread and
// reused by every task.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/base/core/aligned.h"
#include "src/render/plan/plan.h"
#include "src/vocabulary/path/run_parameters.h"
#include "src/vocabulary/path/wave.h"

namespace lanelight {

/// Returns the constants that scene and plan decide; without seed and tables.
RunParameters MakeRunParameters(const PreparedScene& scene, const Plan& plan);
/// RunParameters::exposure.
float ExposureOf(const PreparedScene& scene);

class Wavefront {
 public:
  Wavefront(const PreparedScene& scene, const Plan& plan, const RunParameters& run);

  Wave& wave() { return wave_; }
  /// Bytes of columns and queues.
  std::size_t bytes() const { return memory_.size() * sizeof(std::uint32_t); }
  /// Returns the same memory with the columns of these features only, a subset of the
  /// plan's.
  Wave Narrowed(const FeatureSet& features) const;

 private:
  // The room for copies of paths that split is mostly never touched.
  UntouchedVector<std::uint32_t> memory_;
  Wave wave_;
};

/// Adds up the rows of split paths, in place and in a fixed order, so that the sum does
/// not depend on which path ended first: rows sample * kMaxSplitPaths + copy of a plane
/// of `rows` become rows `sample` of a plane of rows / kMaxSplitPaths. Planes that are
/// not sums (SamplePlanes::Sums) keep the first row.
void SumSplitPaths(float* values, std::uint32_t rows, const SamplePlanes& planes);

}  // namespace lanelight

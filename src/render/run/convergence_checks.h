// A run with a target checks its own error, at certain numbers of samples per pixel.
#pragma once

#include <cmath>
#include <cstdint>

#include "src/render/run/run_setting.h"

namespace lanelight {

class ConvergenceChecks {
 public:
  /// Refers to `setting` for as long as it lives. Without
  /// RunOptions::samples_needed there are none.
  explicit ConvergenceChecks(const RunSetting& setting) : setting_(setting) {}

  /// Samples per pixel of the first check after `done`; kMostSamplesPerPixel if there is
  /// none.
  std::uint64_t After(std::uint64_t done) const;
  /// How many checks there are up to what is done.
  int Count() const;
  /// Asks how many samples are needed, if there is a check at `done` samples per pixel
  /// and all pixels have (their share of) just so many.
  void CheckIfDue(std::uint64_t done);
  /// The same for a run that goes on, at the samples that it has.
  void CheckAgain() { CheckIfDue(LastLevel()); }

  /// Samples per pixel that the image needs, by the last check; at first infinite.
  double needed() const { return needed_; }
  /// No more are needed.
  bool reached() const { return reached_; }
  /// No number of them will do.
  bool hopeless() const { return hopeless_; }

 private:
  bool IsCheck(std::uint64_t done) const;
  std::uint64_t LastLevel() const;

  const RunSetting& setting_;
  double needed_ = INFINITY;
  bool reached_ = false, hopeless_ = false;
};

}  // namespace lanelight

// The error of a render while it runs.
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>

#include "src/render/estimate/estimate.h"
#include "src/render/run/run.h"

namespace lanelight {

struct RenderProgress : Progress {
  /// The last estimate, scaled to the current samples: squared errors fall as 1 /
  /// samples. Empty: none yet.
  std::optional<ErrorEstimate> error;
  /// Expected seconds until the error target is reached, by `error`; empty: no target, or
  /// not known.
  std::optional<double> target_seconds;
};

class ErrorSoFar {
 public:
  explicit ErrorSoFar(const ErrorTarget& target) : target_(target) {}

  /// Lets the run estimate its error: at its checks if it has a target, else when it
  /// shows its film. Must outlive the run.
  void Listen(std::uint64_t pixels, RunOptions& options);
  /// Returns the current error. From any thread.
  RenderProgress At(const Progress& progress) const;

 private:
  void Set(const ErrorEstimate& error, double samples, double needed);

  const ErrorTarget target_;
  mutable std::mutex mutex_;
  std::optional<ErrorEstimate> error_;
  // Over all pixels: samples of the estimate, and samples that a target needs.
  double samples_ = 0, needed_ = 0;
};

}  // namespace lanelight

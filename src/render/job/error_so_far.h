// What a render knows of its error while it goes on.
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>

#include "src/render/estimate/target.h"
#include "src/render/run/run.h"

namespace lanelight {

struct RenderProgress : Progress {
  /// What the last estimate comes to with the samples of now: squared errors fall as
  /// 1 / samples. Empty: there has been none.
  std::optional<ErrorEstimate> error;
  /// Seconds that a target of the error is expected to take from now on, by `error`;
  /// empty: no target, or not known.
  std::optional<double> target_seconds;
};

class ErrorSoFar {
 public:
  explicit ErrorSoFar(const ErrorTarget& target) : target_(target) {}

  /// Has the run estimate its error: at its looks where it has a target, else when it
  /// shows its film. `this` must live as long as the run.
  void Listen(std::uint64_t pixels, RunOptions& options);
  /// What is known now. From any thread.
  RenderProgress At(const Progress& progress) const;

 private:
  void Set(const ErrorEstimate& error, double samples, double needed);

  const ErrorTarget target_;
  mutable std::mutex mutex_;
  std::optional<ErrorEstimate> error_;
  // Of all pixels together: samples of the estimate, and that a target needs.
  double samples_ = 0, needed_ = 0;
};

}  // namespace lanelight

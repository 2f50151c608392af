// Shows the film of a run to whoever wants to know how it is so far, now and then, while
// nothing is in flight.
#pragma once

#include <atomic>

#include "src/render/run/run_setting.h"

namespace lanelight {

/// Tasks wait while the film is looked at. All of that, from the first task that waits
/// on, takes kShowShare of the run's time at most, as long as it takes as long as the
/// last time did; the first time it is taken to be kShowSeconds for each pixel.
inline constexpr double kShowShare = 0.005, kShowSeconds = 2e-7;

class FilmShow {
 public:
  /// Refers to `setting` for as long as it lives. Without RunOptions::on_film nothing is
  /// shown, nor where several ranks have parts of the film.
  explicit FilmShow(const RunSetting& setting) : setting_(setting) {}

  /// Tasks begin, after any training.
  void Start();
  /// From any thread: whether Show is due, true until it is called.
  bool Due() const { return setting_.clock.Elapsed() >= due_; }
  /// Nothing is in flight.
  void Show();

 private:
  const RunSetting& setting_;
  std::atomic<double> due_;  // seconds of the run's clock
};

}  // namespace lanelight

#include <algorithm>

#include "src/measure/study/scene_runner.h"

namespace lanelight {

void StudyClock::StartScene(double work) {
  started_ = true;
  --scenes_left_;
  ++scenes_started_;
  planned_ += work;
}

void StudyClock::FinishScene() {
  if (!started_) --scenes_left_;  // it failed before its work was known
  started_ = false;
}

double StudyClock::Total() const {
  if (scenes_started_ == 0) return 0;
  return planned_ * (1 + double(scenes_left_) / double(scenes_started_));
}

double StudyClock::Fraction() const {
  return Total() > 0 ? std::clamp(done_ / Total(), 0.0, 1.0) : 0;
}

double StudyClock::SecondsLeft() const {
  const double fraction = Fraction();
  return fraction > 0 ? Seconds() * (1 - fraction) / fraction : 0;
}

}  // namespace lanelight

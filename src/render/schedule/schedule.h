// Schedules a render whose number of samples is not fixed: how many samples it takes at a
// time, and when it checks its error. Uses no clock and no image, so tests can play
// through its decisions.
#pragma once

#include <cstdint>

namespace lanelight {

/// Returns the first of the samples per pixel at which a render with a target checks its
/// error: 4, 5, 6 and 7 times powers of two, from 16 units on (`unit` samples belong
/// together). They are the same for any target, so a render that resumes towards a
/// smaller error ends where an uninterrupted one would. They are few, since each is a
/// chance to stop at a lucky error.
std::uint64_t FirstCheck(std::uint32_t unit);
/// Returns the first check at `done` or later.
std::uint64_t CheckFrom(std::uint64_t done, std::uint32_t unit);
/// Returns the number of checks up to `done`, inclusive.
int ChecksUpTo(std::uint64_t done, std::uint32_t unit);

/// Brings all tiles from at least `begin` samples per pixel to `end`, in ranges of
/// `per_task` samples.
struct Round {
  std::uint64_t begin = 0, end = 0;
  std::uint32_t per_task = 1;

  std::uint64_t samples() const { return end - begin; }
};

/// Returns the next round of a render without a time budget, which has `done` samples per
/// pixel. The first ones are short (up to 1, 4, 16, ... times `unit` samples), so that an
/// interrupted image has no holes; once tasks have `per_task` samples, one round takes
/// all that is left.
Round RoundAfter(std::uint64_t done, std::uint32_t per_task, std::uint32_t unit);

/// Chooses rounds for a time budget. The first is as small as possible; each later one
/// takes at most half of the time left, by the speed of the one before. The last ones are
/// small again, so that the end of the budget interrupts tasks of about 1/200 of it.
class Pace {
 public:
  struct Tasks {
    std::size_t tiles = 1;
    int threads = 1;
    std::uint32_t per_task = 1;  // at most
    std::uint32_t unit = 1;      // samples that must not be divided
  };
  Pace(double budget, const Tasks& tasks) : budget_(budget), tasks_(tasks) {}

  /// Returns the round after `done` samples per pixel, `elapsed` seconds into the render.
  Round Next(std::uint64_t done, double elapsed) const;
  /// Notes that a round of so many samples per pixel took `seconds`.
  void AddMeasurement(std::uint64_t samples, double seconds);
  /// Returns the samples per pixel that the time left allows; 0 before the first round.
  double RemainingSamples(double elapsed) const;

 private:
  std::uint32_t RoundedSamples(double samples) const;

  double budget_;
  Tasks tasks_;
  double speed_ = 0;  // samples per pixel and second
};

}  // namespace lanelight

// How a render whose number of samples is not fixed proceeds: how many samples it takes
// at a time, and when it checks its own error. Decisions only: no clock
// and no image, so that tests can play through them.
#pragma once

#include <cstdint>

namespace lanelight {

/// Samples per pixel at which a render with a target checks its error, `unit` samples
/// belonging together: 4, 5, 6 and 7 times powers of two, from 16 units on. The same
/// whatever the target, so that a render which goes on towards a finer one ends where it
/// would have ended at once. Few: each is a chance to stop for a lucky error.
std::uint64_t FirstCheck(std::uint32_t unit);
/// The first one at `done` or after.
std::uint64_t CheckFrom(std::uint64_t done, std::uint32_t unit);
/// How many there are up to `done`, itself included.
int ChecksUpTo(std::uint64_t done, std::uint32_t unit);

/// Brings all tiles from at least `begin` samples per pixel to `end`, in ranges of
/// `per_task` samples.
struct Round {
  std::uint64_t begin = 0, end = 0;
  std::uint32_t per_task = 1;

  std::uint64_t samples() const { return end - begin; }
};

/// The next round of a render without a time budget, which has `done` samples per pixel.
/// The first ones are short (up to 1, 4, 16, ... samples, times `unit`), so that an
/// interruption leaves an image without holes; once tasks are as long as they can be
/// (`per_task` samples), one round takes all that is left.
Round RoundAfter(std::uint64_t done, std::uint32_t per_task, std::uint32_t unit);

/// Rounds of a render with a time budget. The first is as small as can be; each later one
/// takes at most half of the time left, by the speed of the one before. The last ones are
/// small again, and what interrupts them (the caller, when the time is over) interrupts
/// tasks of about 1/200 of the budget.
class Pace {
 public:
  struct Tasks {
    std::size_t tiles = 1;
    int threads = 1;
    std::uint32_t per_task = 1;  // at most
    std::uint32_t unit = 1;      // samples that must not be divided
  };
  Pace(double budget, const Tasks& tasks) : budget_(budget), tasks_(tasks) {}

  /// The round after `done` samples per pixel, `elapsed` seconds after the start of
  /// rendering.
  Round Next(std::uint64_t done, double elapsed) const;
  /// A round of so many samples per pixel took `seconds`.
  void Took(std::uint64_t samples, double seconds);
  /// Samples per pixel that the time left is enough for; 0 before the first round.
  double Reach(double elapsed) const;

 private:
  std::uint32_t Whole(double samples) const;

  double budget_;
  Tasks tasks_;
  double speed_ = 0;  // samples per pixel and second
};

}  // namespace lanelight

// How a render whose number of samples is not fixed proceeds: how many samples it takes
// at a time, in what groups, and when it looks at its own error. Decisions only: no clock
// and no image, so that tests can play through them.
#pragma once

#include <cstdint>

#include "src/strategy/strategy.h"

namespace lanelight {

/// Size of the groups that samples are taken in until more is known: as if independent.
std::uint32_t FirstGroupSize(const Strategy& strategy);

/// Size for a render that is predicted to take about `spp` samples per pixel, of which
/// `done` are taken: at least four, mostly seven groups; larger than `done`. Independent
/// points keep their first size.
std::uint32_t ChooseGroupSize(const Strategy& strategy, double spp, std::uint64_t done);

/// Samples per pixel at which a render looks at its error for the first time after its
/// groups are chosen: four groups, and 16 samples, so that it has seen something of every
/// pixel.
std::uint64_t FirstLook(std::uint32_t group_size);

/// ... and for the next time after `done` samples, `needed` being how many the error is
/// estimated to need. A little more than that; whole groups; at most twice as many as are
/// done, because the estimate rests on these. Few looks: each is a chance to stop for a
/// lucky error.
std::uint64_t NextLook(std::uint64_t done, double needed, std::uint32_t group_size);

/// A part of a render: all tiles take `chunks` times `per_task` samples per pixel.
struct Round {
  std::uint32_t per_task = 1, chunks = 1;
  std::uint64_t samples() const { return std::uint64_t{per_task} * chunks; }
};

/// Rounds of a render with a time budget. The first is as small as can be; each later one
/// takes at most half of the time left, by the speed of the one before. The last ones are
/// small again, and what interrupts them (the caller, when the time is over) interrupts
/// tasks of about 1/200 of the budget.
class Pace {
 public:
  struct Tasks {
    std::size_t tiles = 1;
    int threads = 1;
    Round most;              // of one round
    std::uint32_t unit = 1;  // samples that must not be divided
  };
  Pace(double budget, const Tasks& tasks) : budget_(budget), tasks_(tasks) {}

  /// The next round, `elapsed` seconds after the start of rendering.
  Round Next(double elapsed) const;
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

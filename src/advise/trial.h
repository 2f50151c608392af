// Rounds of `lanelight advise`: candidates that change any axis of a strategy, tried on
// the same pixels.
#pragma once

#include <vector>

#include "src/advise/candidates.h"
#include "src/render/job.h"
#include "src/wavefront/decision_pilot.h"
#include "src/wavefront/reuse_trial.h"

namespace lanelight {

/// A candidate, and what the rounds have found of it.
struct TriedCandidate {
  Candidate candidate;
  std::size_t index = 0;  // of the caller's
  DecisionEntry entry;    // of the last round
  bool has_learned = false;

  /// Efficiency relative to the default with its 90 % interval, in which the scatter from
  /// scene to scene of what its rays cost has a part; by the last round.
  Interval Efficiency() const;
  /// It is clearly better than the default by what it must gain: by how much more, in the
  /// logarithm; else 0.
  double Beyond() const;
};

/// The same of paths that serve their block, over those that do not.
Interval EfficiencyOf(const ReuseVerdict& verdict);

class Trial {
 public:
  /// `job` is left with the strategy of whatever was tried last. `planned`: samples of
  /// the render that is to follow, for which candidates learn.
  Trial(Job& job, std::uint64_t planned, const std::atomic<bool>* stop);

  /// Tries all, the default first, with about so many samples each of pixels that no
  /// other round has. False: the user has stopped it. What the scene refuses in the end
  /// is removed.
  bool Round(std::vector<TriedCandidate>& tried, std::uint64_t samples);

  /// Paths that serve their block beside `base`, which a round has tried, with about so
  /// many samples of whole tiles.
  std::vector<TriedBlocks> Blocks(TriedCandidate& base, std::uint64_t samples,
                                  double must_gain);

  std::uint64_t rays() const { return rays_; }

 private:
  void Use(TriedCandidate& tried);

  Job& job_;
  TrainingOptions training_;
  std::uint64_t turn_ = 0, rays_ = 0;
};

}  // namespace lanelight

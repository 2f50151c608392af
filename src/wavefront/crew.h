// Who brings the tiles of a run to more samples: this process alone, or several (ranks)
// of which each has prepared the same job. Rank 0 leads: it holds the film, decides what
// is rendered and when to stop, prints and writes. The others serve.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>

namespace lanelight {

class Films;
class Tasks;
class TaskWatcher;
struct Round;

/// Every tile is to have `limit` samples per pixel, in tasks of `per_task` of them.
/// Indices in kernels begin with sample `first`, which no tile is behind.
struct RoundWork {
  std::uint64_t first = 0, limit = 0;
  std::uint32_t per_task = 1;
};

/// A rank has failed; what() names it, its host, and why.
class RankFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a rank that serves brings along.
struct Service {
  Tasks& tasks;
  Films& films;
  std::function<void(std::uint64_t first)> begin;  // before tasks whose first sample is
  const std::atomic<bool>* stop = nullptr;         // a signal came to this rank
};

/// All ranks call the same functions in the same order: Agree and Share, then the leader
/// RunRound as often as it likes and Dismiss, the others Serve.
class Crew {
 public:
  virtual ~Crew() = default;
  virtual int rank() const = 0;
  virtual int ranks() const = 0;
  bool leads() const { return rank() == 0; }
  /// Of all ranks together.
  virtual int threads() const = 0;

  /// The text of every rank is compared with that of the leader, who throws InputError
  /// with `what`, rank and host of the first one that differs, and what `difference` (of
  /// the leader's and its text) says about it.
  using Difference =
      std::function<std::string(const std::string& leaders, const std::string& its)>;
  virtual void Agree(const std::string& what, const std::string& text,
                     const Difference& difference) = 0;
  /// Returns the leader's bytes on every rank.
  virtual std::string Share(const std::string& bytes) = 0;

  /// A round for all ranks that is long enough, from one for a single process.
  virtual Round Widen(const Round& round) const = 0;
  /// Leader: does the work, except for tiles that have not begun when the watcher has
  /// stopped it. Nothing is in flight afterwards.
  virtual void RunRound(const RoundWork& work, Tasks& tasks, TaskWatcher& watcher,
                        Films& films) = 0;
  /// Leader: a rank was interrupted, or has failed: no more is to be begun.
  virtual bool Stopped() const = 0;
  /// Leader: that have gone to other ranks and come back.
  virtual std::uint64_t bytes() const { return 0; }
  /// Leader: lets the others go. Throws RankFailure if one has failed.
  virtual void Dismiss() = 0;
  /// Others: does what the leader asks for until it lets them go.
  virtual void Serve(const Service& service) = 0;
};

/// This process alone.
class OneProcess : public Crew {
 public:
  int rank() const override { return 0; }
  int ranks() const override { return 1; }
  int threads() const override;
  void Agree(const std::string&, const std::string&, const Difference&) override {}
  std::string Share(const std::string& bytes) override { return bytes; }
  Round Widen(const Round& round) const override;
  void RunRound(const RoundWork& work, Tasks& tasks, TaskWatcher& watcher,
                Films& films) override;
  bool Stopped() const override { return false; }
  void Dismiss() override {}
  void Serve(const Service& service) override;
};

}  // namespace lanelight

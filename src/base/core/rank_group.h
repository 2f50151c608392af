// The processes (ranks) that render together, one or several, of which each has prepared
// the same job. Rank 0 leads: it decides what is rendered and when to stop, prints and
// writes. The others are its workers.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace lanelight {

/// A rank has failed; what() names it, its host, and why.
class RankFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Status of a rank (0 or 1, but for samples), or the sum over all ranks.
struct RankStatus {
  std::uint64_t failed = 0;
  std::uint64_t interrupted = 0;  // by a signal
  std::uint64_t stopped = 0;      // begins no more tasks
  std::uint64_t cancelled = 0;    // nor ends those in flight
  std::uint64_t busy = 0;         // has tasks in flight
  std::uint64_t behind = 0;       // has tiles that lack samples
  std::uint64_t samples = 0;      // that it has taken
  std::uint64_t left = 0;         // samples of this round that it has not
};

/// Collective functions are called by all ranks, in the same order, and wait for all of
/// them without keeping a core busy. Where a rank has failed before it came to one, that
/// throws RankFailure on all others. This class is the group of a process alone.
class RankGroup {
 public:
  virtual ~RankGroup() = default;
  virtual int rank() const { return 0; }
  virtual int ranks() const { return 1; }
  bool is_leader() const { return rank() == 0; }
  /// "rank 2 on node7".
  virtual std::string Name(int) const { return "rank 0"; }
  /// That the leader has sent to workers, or has had from them.
  virtual std::uint64_t bytes() const { return 0; }

  /// Collective: the numbers of all ranks, on each of them.
  virtual std::vector<int> AllGather(int number) { return {number}; }
  /// Collective: the leader's bytes are put into those of the workers.
  virtual void Broadcast(std::span<char>) {}
  /// Collective: `receive` is called on the leader, for one worker after the other.
  using Receiver = std::function<void(int rank, std::string_view bytes)>;
  virtual void Gather(std::string_view, const Receiver&) {}
  /// Collective: the sum over all ranks, also of those that have failed. `should_stop` is
  /// asked while others are waited for; if it says so, there is no sum, and nothing
  /// collective may follow.
  virtual std::optional<RankStatus> Sum(const RankStatus& own,
                                        const std::function<bool()>&) {
    return own;
  }
  /// Called by two ranks, each of the other: sends bytes and returns theirs, or nothing
  /// where should_stop said so, as in Sum.
  virtual std::optional<std::string> Swap(int, std::string bytes,
                                          const std::function<bool()>&) {
    return bytes;
  }
  /// Collective: returns the leader's bytes on every rank.
  std::string Share(std::string bytes) {
    std::uint64_t size = bytes.size();
    Broadcast({reinterpret_cast<char*>(&size), sizeof(size)});
    bytes.resize(size);
    Broadcast(bytes);
    return bytes;
  }

  /// The last call where all went well, also after a signal: returns the exit code.
  virtual int Leave(int exit_code) { return exit_code; }
  /// The last call of a rank that has failed: the leader, who has said why itself, ends
  /// all ranks; a worker tells the leader and waits for its end. Returns the exit code
  /// of a process alone.
  virtual int Fail(int exit_code, const std::string&) { return exit_code; }
};

}  // namespace lanelight

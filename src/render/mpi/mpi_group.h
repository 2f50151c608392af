// A group of ranks that talk by MPI (docs/mpi.md). Only the main thread of a process
// calls MPI, and never waits in it: all waiting is polling with back-off, so that a rank
// that waits leaves its core to others.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <string>
#include <vector>

#include "src/base/core/rank_group.h"

namespace lanelight {

class MpiGroup : public RankGroup {
 public:
  /// On all ranks at once, after MPI_Init.
  MpiGroup();

  int rank() const override { return rank_; }
  int ranks() const override { return int(hosts_.size()); }
  std::string Name(int rank) const override;
  std::uint64_t bytes() const override { return bytes_; }
  std::vector<int> AllGather(int number) override;
  void Broadcast(std::span<char> bytes) override;
  void Gather(std::string_view bytes, const Receiver& receive) override;
  std::optional<std::string> Swap(int partner, std::string bytes,
                                  const std::function<bool()>& should_stop) override;
  std::optional<RankStatus> Sum(const RankStatus& own,
                                const std::function<bool()>& should_stop) override;
  int Leave(int exit_code) override;
  int Fail(int exit_code, const std::string& message) override;

 private:
  void PollFailures();
  [[noreturn]] void ThrowFailure();
  void Collect(std::string_view bytes, const Receiver& receive);
  bool SwapBytes(int partner, std::span<char> out, std::span<char> in,
                 const std::function<bool()>& should_stop);

  int rank_ = 0;
  std::vector<std::string> hosts_;  // by rank
  std::uint64_t bytes_ = 0;
  // Operations that MPI may still be working on when this rank has given up:
  RankStatus sum_;
  std::uint64_t out_size_ = 0, in_size_ = 0;
  std::string out_, in_;
  bool aborted_ = false;  // on a rank that has not answered
  bool failed_ = false;   // a rank has, and the leader knows
};

}  // namespace lanelight

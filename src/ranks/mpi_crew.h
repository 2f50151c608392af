// A crew of processes that talk by MPI.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "src/ranks/leader_round.h"
#include "src/ranks/mail.h"
#include "src/wavefront/crew.h"
#include "src/wavefront/schedule.h"

namespace lanelight {

class MpiCrew : public Crew {
 public:
  /// On all ranks at once.
  MpiCrew();

  int rank() const override { return mail_.rank(); }
  int ranks() const override { return mail_.ranks(); }
  int threads() const override { return threads_; }
  bool Stopped() const override { return stopped_; }
  std::uint64_t bytes() const override { return mail_.bytes(); }
  void Agree(const std::string& what, const std::string& text,
             const Difference& difference) override;
  std::string Share(const std::string& bytes) override;
  Round Widen(const Round& round) const override;
  void RunRound(const RoundWork& work, Tasks& tasks, TaskWatcher& watcher,
                Films& films) override;
  void Dismiss() override;
  void Serve(const Service& service) override;

  /// Leader: a rank has not answered, and will not come to the end.
  bool gave_up() const { return gave_up_; }
  /// "rank 2 on node7".
  const std::string& Name(int rank) const {
    return members_[static_cast<std::size_t>(rank)].name;
  }
  /// Of a rank that has failed: tells the leader, who will end it.
  [[noreturn]] void Confess(const std::string& message);

 private:
  Message AwaitText(int rank);
  void TakeTexts();

  Mail mail_;
  std::vector<Member> members_;  // by rank; the leader's own first
  int threads_;
  double cost_ = 0;  // processor seconds of a sample
  std::uint32_t widen_ = 1;
  std::atomic<bool> stopped_{false};
  std::string failure_;  // the first one
  bool gave_up_ = false;
};

}  // namespace lanelight

// Messages between ranks. Only the main thread of a process sends and receives.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <list>
#include <optional>
#include <string>

#include "src/core/check.h"

namespace lanelight {

enum class Tag : int {
  kText,    // to the leader, of Agree
  kShared,  // from the leader
  kWork,    // from the leader: a batch of tiles
  kDone,    // to the leader: the same tiles, with more samples
  kFailed,  // to the leader: why
  kEnd      // from the leader
};

struct Message {
  Tag tag = Tag::kEnd;
  std::string bytes;
};

/// Nothing else may come now.
inline void CheckTag(const Message& message, Tag tag) {
  LL_CHECK_EQ(static_cast<int>(message.tag), static_cast<int>(tag));
}

/// Messages of one process, in both directions.
class Mail {
 public:
  Mail();
  int rank() const { return rank_; }
  int ranks() const { return ranks_; }
  std::uint64_t bytes() const { return bytes_; }  // in both directions

  /// Returns at once; Sent() sees to it.
  void Send(int to, Tag tag, std::string bytes);
  /// Whether all that was sent is on its way.
  bool Sent();
  void AwaitSent();

  /// What has come from a rank, in its order; nothing if there is nothing.
  std::optional<Message> Receive(int from);
  Message Await(int from);

 private:
  struct Letter {
    std::string bytes;
    MPI_Request request = MPI_REQUEST_NULL;
  };
  int rank_ = 0, ranks_ = 1;
  std::uint64_t bytes_ = 0;
  std::list<Letter> letters_;  // stay where they are until they are sent
};

}  // namespace lanelight

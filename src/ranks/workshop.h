// The side of a rank that serves: renders batches as they come.
#pragma once

#include <condition_variable>
#include <exception>
#include <list>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "src/wavefront/crew.h"
#include "src/wavefront/hand_out.h"
#include "src/wavefront/run_state.h"
#include "src/wavefront/stop_watcher.h"
#include "src/wavefront/tile_columns.h"

namespace lanelight {

/// Its threads go from one batch to the next without waiting for each other.
class Workshop {
 public:
  /// Refers to the service for as long as it lives.
  explicit Workshop(const Service& service);
  ~Workshop();

  /// A batch as the leader has packed it.
  void Add(std::string_view bytes);
  /// The answer to the oldest batch, once it is done. Throws what a thread has thrown.
  std::optional<std::string> Finished();

 private:
  struct Batch {
    std::vector<TileRange> ranges;
    std::size_t begun = 0, done = 0;
    double seconds = 0;
    RunCounts counts;
  };

  void Unpack(const TileRange& range, std::string_view& bytes);
  std::string Answer(const Batch& batch);
  void End();
  void Work();
  void WorkInThread();
  void BringOn(Batch& batch, std::unique_lock<std::mutex>& lock);

  const Service& service_;
  StopWatcher signal_;  // to this rank: ends its batches
  const TileColumns rows_;
  std::mutex mutex_;  // of all that follows
  std::condition_variable more_;
  std::list<Batch> batches_;
  double cpu_ = 0;  // of the process, when it was last told
  bool ended_ = false;
  std::exception_ptr problem_;
  std::thread thread_;
};

}  // namespace lanelight

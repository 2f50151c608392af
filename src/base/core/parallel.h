// Parallel functions on oneTBB, which no other file uses.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

namespace lanelight {

/// Limits the threads used by the functions below while it lives, within the limits that
/// there are already. 0: to nothing else, which is all cores.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Threads for a limit of `requested`; 0: all cores.
int ThreadCount(int requested);
/// Threads the functions below will use at most.
int MaxThreads();

/// Index of the calling thread inside a parallel function, below ThreadSlots().
int ThreadIndex();
/// Indices that threads may have: with a limit below the number of cores, more than there
/// are threads.
int ThreadSlots();

/// Calls body(i) for i in [0, n), in parallel, in no particular order. The first
/// exception thrown by a body is rethrown here; the remaining items may be skipped.
void ParallelFor(std::size_t n, const std::function<void(std::size_t)>& body);

/// Like ParallelFor over chunks [begin, end) of at least `grain` items.
void ParallelForRange(
    std::size_t n, std::size_t grain,
    const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Runs both, in parallel if a thread is free.
void ParallelInvoke(const std::function<void()>& a, const std::function<void()>& b);

/// Version of the oneTBB library at run time, e.g. "2021.8".
std::string TbbVersion();

}  // namespace lanelight

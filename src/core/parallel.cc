#include "src/core/parallel.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/version.h>

#include <thread>

namespace lanelight {

struct ThreadLimit::Impl {
  explicit Impl(std::size_t n)
      : control(tbb::global_control::max_allowed_parallelism, n) {}
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads)
    : impl_(std::make_unique<Impl>(
          threads > 0 ? static_cast<std::size_t>(threads)
                      : std::max(1u, std::thread::hardware_concurrency()))) {}
ThreadLimit::~ThreadLimit() = default;

int MaxThreads() {
  return static_cast<int>(
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

int ThreadIndex() { return std::max(0, tbb::this_task_arena::current_thread_index()); }

void ParallelFor(std::size_t n, const std::function<void(std::size_t)>& body) {
  tbb::parallel_for(std::size_t{0}, n, body);
}

void ParallelForRange(std::size_t n, std::size_t grain,
                      const std::function<void(std::size_t, std::size_t)>& body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, grain),
                    [&](const auto& range) { body(range.begin(), range.end()); });
}

void ParallelInvoke(const std::function<void()>& a, const std::function<void()>& b) {
  tbb::parallel_invoke(a, b);
}

std::string TbbVersion() { return TBB_runtime_version(); }

}  // namespace lanelight

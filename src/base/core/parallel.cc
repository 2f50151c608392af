#include "src/base/core/parallel.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/version.h>

#include <thread>

#ifdef LANELIGHT_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace lanelight {
namespace {

// Tells the thread sanitizer, which cannot see into oneTBB, that actions before Release()
// happen before those after Acquire(). Empty in other builds.
class SanitizerFence {
 public:
#ifdef LANELIGHT_THREAD_SANITIZER
  void Release() { __tsan_release(this); }
  void Acquire() { __tsan_acquire(this); }
#else
  void Release() {}
  void Acquire() {}
#endif
};

struct ParallelCall {
  SanitizerFence start, end;
  ParallelCall() { start.Release(); }
  ~ParallelCall() { end.Acquire(); }

  // Encloses a body, also one that throws.
  struct Body {
    ParallelCall& call;
    explicit Body(ParallelCall& c) : call(c) { call.start.Acquire(); }
    ~Body() { call.end.Release(); }
  };
};

}  // namespace

struct ThreadLimit::Impl {
  explicit Impl(std::size_t n)
      : control(tbb::global_control::max_allowed_parallelism, n) {}
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads)
    : impl_(threads > 0 ? std::make_unique<Impl>(static_cast<std::size_t>(threads))
                        : nullptr) {}
ThreadLimit::~ThreadLimit() = default;

int ThreadCount(int requested) {
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  return requested > 0 ? requested : static_cast<int>(cores);
}

int MaxThreads() {
  return static_cast<int>(
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

int ThreadSlots() {
  return std::max(MaxThreads(), tbb::this_task_arena::max_concurrency()) + 1;
}

int ThreadIndex() { return std::max(0, tbb::this_task_arena::current_thread_index()); }

void ParallelFor(std::size_t n, const std::function<void(std::size_t)>& body) {
  ParallelCall call;
  tbb::parallel_for(std::size_t{0}, n, [&](std::size_t i) {
    const ParallelCall::Body around(call);
    body(i);
  });
}

void ParallelForRange(std::size_t n, std::size_t grain,
                      const std::function<void(std::size_t, std::size_t)>& body) {
  ParallelCall call;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, grain), [&](const auto& range) {
    const ParallelCall::Body around(call);
    body(range.begin(), range.end());
  });
}

void ParallelInvoke(const std::function<void()>& a, const std::function<void()>& b) {
  ParallelCall call;
  const auto run = [&call](const std::function<void()>& body) {
    const ParallelCall::Body around(call);
    body();
  };
  tbb::parallel_invoke([&] { run(a); }, [&] { run(b); });
}

std::string TbbVersion() { return TBB_runtime_version(); }

}  // namespace lanelight

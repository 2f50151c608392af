#include "src/cli/interrupt.h"

#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "src/base/core/parallel.h"

namespace lanelight {
namespace {

std::atomic<bool> stop_requested = false;
static_assert(std::atomic<bool>::is_always_lock_free);  // set by a signal handler

const char* message = nullptr;  // set before the handler
std::size_t message_size = 0;

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP, SIGXCPU};

// Only calls that are safe in a signal handler.
void OnSignal(int) {
  const int saved = errno;
  stop_requested.store(true);
  // SIGXCPU comes again with every second of processor time.
  for (int s : kSignals) signal(s, s == SIGXCPU ? SIG_IGN : SIG_DFL);
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, message, message_size);
  errno = saved;
}

// `ulimit -t` sets both limits of processor time, and at the hard one the kernel kills
// the process. The soft limit is moved ahead, so that there is time to write.
void MoveSoftLimitAhead(int threads) {
  rlimit limit;
  if (getrlimit(RLIMIT_CPU, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY ||
      limit.rlim_cur < limit.rlim_max) {
    return;
  }
  const auto per_second = static_cast<rlim_t>(ThreadCount(threads));
  const rlim_t to_write = std::min(limit.rlim_max / 2, 2 + 2 * per_second);
  limit.rlim_cur = limit.rlim_max - to_write;
  setrlimit(RLIMIT_CPU, &limit);
}

}  // namespace

InterruptGuard::InterruptGuard(const char* text, int threads) {
  message = text;
  message_size = std::strlen(text);
  stop_requested.store(false);
  MoveSoftLimitAhead(threads);
  struct sigaction action = {};
  action.sa_handler = OnSignal;
  action.sa_flags = SA_RESTART;
  for (int s : kSignals) {
    struct sigaction old = {};
    sigaction(s, nullptr, &old);
    // A background job of a script ignores SIGINT; it keeps doing so.
    if (old.sa_handler != SIG_IGN) sigaction(s, &action, nullptr);
  }
}

InterruptGuard::~InterruptGuard() {
  for (int s : kSignals) {
    struct sigaction now = {};
    sigaction(s, nullptr, &now);
    if (now.sa_handler == OnSignal) signal(s, SIG_DFL);
  }
}

const std::atomic<bool>& InterruptGuard::stop() const { return stop_requested; }

}  // namespace lanelight

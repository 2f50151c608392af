#include "src/cli/interrupt.h"

#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace lanelight {
namespace {

std::atomic<bool> stop_requested = false;
static_assert(std::atomic<bool>::is_always_lock_free);  // set by a signal handler

const char* message = nullptr;  // set before the handler
std::size_t message_size = 0;

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};

// Only calls that are safe in a signal handler.
void OnSignal(int) {
  const int saved = errno;
  stop_requested.store(true);
  for (int s : kSignals) signal(s, SIG_DFL);
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, message, message_size);
  errno = saved;
}

}  // namespace

InterruptGuard::InterruptGuard(const char* text) {
  message = text;
  message_size = std::strlen(text);
  stop_requested.store(false);
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

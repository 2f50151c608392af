// Ctrl-C and its like during a render: the first one asks for a stop, the second one ends
// the program.
#pragma once

#include <atomic>

namespace lanelight {

inline constexpr const char* kStoppingMessage =
    "\nstopping: finishing the samples in flight, then writing the image (once more to "
    "abort)\n";
inline constexpr const char* kKeepingMessage =
    "\nstopping: finishing the samples in flight, then writing state and image (once "
    "more "
    "to abort; the last state stays)\n";

/// While it lives, the first SIGINT, SIGTERM, SIGHUP or SIGXCPU sets stop() and prints a
/// message; the next one has its ordinary effect, except SIGXCPU, of which the system
/// sends one per second. A limit of processor time that would kill at once is preceded by
/// one that sends SIGXCPU. At most one at a time.
class InterruptGuard {
 public:
  /// `message`, a literal, says what happens now.
  explicit InterruptGuard(const char* message = kStoppingMessage, int threads = 0);
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  const std::atomic<bool>& stop() const;
};

}  // namespace lanelight

// Counts calls of operator new, malloc and pthread_mutex_lock on threads that ask for it.
#pragma once

#include <cstdint>

namespace lanelight {

/// Calls since counting began on this thread.
struct InterposedCalls {
  std::uint64_t allocations = 0, locks = 0;
  std::uint64_t bytes = 0;  // asked for by the allocations
};

/// Returns whether the functions are interposed in this binary; not so under sanitizers,
/// which interpose them themselves, and without glibc.
bool CanInterpose();

/// Counts on this thread while it lives.
class CountCalls {
 public:
  CountCalls();
  ~CountCalls();
  CountCalls(const CountCalls&) = delete;
  CountCalls& operator=(const CountCalls&) = delete;
  InterposedCalls calls() const;
};

}  // namespace lanelight

#include "tests/render/wave/interposed.h"

#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <new>

#if defined(__has_feature)
#define LANELIGHT_HAS_FEATURE(x) __has_feature(x)
#else
#define LANELIGHT_HAS_FEATURE(x) 0
#endif

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) &&                       \
    !defined(__SANITIZE_THREAD__) && !LANELIGHT_HAS_FEATURE(address_sanitizer) && \
    !LANELIGHT_HAS_FEATURE(thread_sanitizer) && !LANELIGHT_HAS_FEATURE(memory_sanitizer)
#define LANELIGHT_INTERPOSE 1
#include <dlfcn.h>
#include <pthread.h>
#endif

namespace lanelight {
namespace {

// Constant initialisation: usable before and after main.
thread_local constinit bool counting = false;
thread_local constinit InterposedCalls counts{};

}  // namespace

#ifdef LANELIGHT_INTERPOSE
bool CanInterpose() { return true; }

namespace {
void NoteAllocation(std::size_t bytes) {
  if (!counting) return;
  ++counts.allocations;
  counts.bytes += bytes;
}
void NoteLock() {
  if (counting) ++counts.locks;
}
}  // namespace
#else
bool CanInterpose() { return false; }
#endif

CountCalls::CountCalls() {
  counts = {};
  counting = true;
}
CountCalls::~CountCalls() { counting = false; }
InterposedCalls CountCalls::calls() const { return counts; }

}  // namespace lanelight

#ifdef LANELIGHT_INTERPOSE

// glibc lets a program bring its own allocation functions and offers its own under these
// names. What they return is freed by glibc's free(). operator new calls malloc.
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t n) {
  lanelight::NoteAllocation(n);
  return __libc_malloc(n);
}
void* calloc(std::size_t n, std::size_t size) {
  lanelight::NoteAllocation(n * size);
  return __libc_calloc(n, size);
}
void* realloc(void* p, std::size_t n) {
  lanelight::NoteAllocation(n);
  return __libc_realloc(p, n);
}
void* aligned_alloc(std::size_t alignment, std::size_t n) {
  lanelight::NoteAllocation(n);
  return __libc_memalign(alignment, n);
}
int posix_memalign(void** out, std::size_t alignment, std::size_t n) {
  lanelight::NoteAllocation(n);
  *out = __libc_memalign(alignment, n);
  return *out == nullptr ? ENOMEM : 0;
}

int pthread_mutex_lock(pthread_mutex_t* mutex) {
  using Lock = int (*)(pthread_mutex_t*);
  static const Lock real = reinterpret_cast<Lock>(dlsym(RTLD_NEXT, "pthread_mutex_lock"));
  lanelight::NoteLock();
  return real(mutex);
}
}

#endif

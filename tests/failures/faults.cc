// A library to be loaded before a program (LD_PRELOAD), which makes the system fail it:
// the n-th call that changes something in a folder fails, or kills the program, and the
// clock on the wall runs backwards. Every such call is written down first, so that a test
// can count them and then try each.
//
//   FAULTS_FOLDER  calls on files whose paths begin so count
//   FAULTS_LOG     file to which a line goes for each of them: "write PATH"
//   FAULTS_AT      the first that fails, from 1 on; 0: none
//   FAULTS_COUNT   how many fail from there; 0: all
//   FAULTS_KIND    number of the error (ENOSPC, EROFS...); 0: SIGKILL instead of the call
//   FAULTS_CLOCK   1: each look at the clock finds it an hour earlier than the last one
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

template <class Function>
Function* Real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

long Number(const char* name) {
  const char* text = std::getenv(name);
  return text ? std::atol(text) : 0;
}

bool Counts(const char* path) {
  const char* folder = std::getenv("FAULTS_FOLDER");
  return folder && std::strncmp(path, folder, std::strlen(folder)) == 0;
}

const char* PathOf(int fd, char (&path)[PATH_MAX]) {
  char link[64];
  std::snprintf(link, sizeof(link), "/proc/self/fd/%d", fd);
  const ssize_t n = readlink(link, path, sizeof(path) - 1);
  path[n > 0 ? n : 0] = 0;
  return path;
}

void Log(const char* call, const char* path) {
  const char* log = std::getenv("FAULTS_LOG");
  if (!log) return;
  static const auto real_open = Real<int(const char*, int, ...)>("open");
  static const auto real_write = Real<ssize_t(int, const void*, size_t)>("write");
  const int fd = real_open(log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  char line[PATH_MAX + 32];
  const int n = std::snprintf(line, sizeof(line), "%s %s\n", call, path);
  if (fd < 0 || real_write(fd, line, static_cast<size_t>(n)) != n) _exit(99);
  close(fd);
}

std::atomic<long> calls{0};

// Returns whether this call is to fail; errno then says how. `half`: what a call does
// that is killed half way.
template <class Half>
bool Fails(const char* call, const char* path, const Half& half) {
  if (!Counts(path)) return false;
  const long call_number = ++calls;
  Log(call, path);
  const long at = Number("FAULTS_AT"), count = Number("FAULTS_COUNT");
  if (at == 0 || call_number < at || (count > 0 && call_number >= at + count)) {
    return false;
  }
  half();
  if (Number("FAULTS_KIND") == 0) {
    kill(getpid(), SIGKILL);
    for (;;) pause();  // it may be another thread that dies first
  }
  errno = static_cast<int>(Number("FAULTS_KIND"));
  return true;
}

bool Fails(const char* call, const char* path) {
  return Fails(call, path, [] {});
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  static const auto real = Real<int(const char*, int, ...)>("open");
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = flags & O_CREAT ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  if ((flags & O_ACCMODE) != O_RDONLY && Fails("open", path)) return -1;
  return real(path, flags, mode);
}

// As a full disk does, it may take a part of what it is given.
ssize_t write(int fd, const void* bytes, size_t size) {
  static const auto real = Real<ssize_t(int, const void*, size_t)>("write");
  char path[PATH_MAX];
  const auto half = [&] { [[maybe_unused]] auto n = real(fd, bytes, size / 2); };
  if (fd > STDERR_FILENO && Fails("write", PathOf(fd, path), half)) return -1;
  return real(fd, bytes, size);
}

int fsync(int fd) {
  static const auto real = Real<int(int)>("fsync");
  char path[PATH_MAX];
  return Fails("fsync", PathOf(fd, path)) ? -1 : real(fd);
}

int rename(const char* from, const char* to) {
  static const auto real = Real<int(const char*, const char*)>("rename");
  return Fails("rename", to) ? -1 : real(from, to);
}

// A file system that takes nothing may still let go.
int unlink(const char* path) {
  static const auto real = Real<int(const char*)>("unlink");
  if (Number("FAULTS_KIND") == 0 && Fails("unlink", path)) return -1;
  return real(path);
}

int clock_gettime(clockid_t clock, struct timespec* time) {
  static const auto real = Real<int(clockid_t, struct timespec*)>("clock_gettime");
  static std::atomic<long> looks{0};
  const int result = real(clock, time);
  if (clock == CLOCK_REALTIME && Number("FAULTS_CLOCK")) time->tv_sec -= 3600 * ++looks;
  return result;
}

}  // extern "C"

#include "src/base/core/file_lock.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>
#include <utility>

#include "src/base/core/error.h"
#include "src/base/core/hash.h"

namespace lanelight {
namespace {

using LockSeconds = std::chrono::duration<double>;

constexpr LockSeconds kFirstPause(1e-3), kLongestPause(50e-3);

[[noreturn]] void Fail(const std::string& path, const char* what) {
  throw InputError("{}: {}: {}", path, what, std::strerror(errno));
}

// Bytes beyond the end of a file can be locked too.
std::uint64_t ByteOf(const std::string& name) {
  return Hash64(name) & ((std::uint64_t{1} << 62) - 1);
}

// Returns 0 if done. Locks of the process would be lost with the first descriptor of the
// file that any thread closes, so the open file holds them.
int SetLock(int fd, int type, std::uint64_t byte) {
  struct flock range = {};  // l_pid must be 0
  range.l_type = static_cast<short>(type);
  range.l_whence = SEEK_SET;
  range.l_start = static_cast<off_t>(byte);
  range.l_len = 1;
  int result;
  do {
    result = fcntl(fd, F_OFD_SETLK, &range);
  } while (result != 0 && errno == EINTR);
  return result;
}

bool LacksLockSupport(int error) {
  return error == ENOSYS || error == ENOLCK || error == EOPNOTSUPP || error == EINVAL;
}

}  // namespace

ScopedLock::ScopedLock(ScopedLock&& other) noexcept
    : file_(std::exchange(other.file_, nullptr)), byte_(other.byte_) {}

ScopedLock& ScopedLock::operator=(ScopedLock&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(byte_, other.byte_);
  return *this;
}

// Need not succeed: closing the file frees the lock too.
ScopedLock::~ScopedLock() {
  if (file_ != nullptr) SetLock(file_->fd_.get(), F_UNLCK, byte_);
}

LockFile::LockFile(const std::string& path)
    : path_(path), fd_(open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  if (fd_.get() < 0) Fail(path_, "cannot open");
  const ScopedLock probe(this, ByteOf("is there locking?"));
  supports_locks_ =
      SetLock(fd_.get(), F_WRLCK, probe.byte_) == 0 || !LacksLockSupport(errno);
}

std::optional<ScopedLock> LockFile::TryLock(const std::string& name) const {
  if (!supports_locks_) return ScopedLock(nullptr, 0);
  const std::uint64_t byte = ByteOf(name);
  if (SetLock(fd_.get(), F_WRLCK, byte) == 0) return ScopedLock(this, byte);
  if (errno == EAGAIN || errno == EACCES) return std::nullopt;
  Fail(path_, "cannot lock");
}

// F_OFD_SETLKW would not end at signals that restart system calls.
std::optional<ScopedLock> LockFile::Wait(
    const std::string& name, const std::function<bool(double)>& keep_waiting) const {
  const auto start = std::chrono::steady_clock::now();
  for (LockSeconds pause = kFirstPause;; pause = std::min(2 * pause, kLongestPause)) {
    if (auto lock = TryLock(name)) return lock;
    const LockSeconds waited = std::chrono::steady_clock::now() - start;
    if (!keep_waiting(waited.count())) return std::nullopt;
    std::this_thread::sleep_for(pause);
  }
}
bool LockFile::IsNamed() const {
  struct stat own, named;
  return fstat(fd_.get(), &own) == 0 && stat(path_.c_str(), &named) == 0 &&
         own.st_dev == named.st_dev && own.st_ino == named.st_ino;
}

void LockFile::SetNote(const std::string& text) {
  // On a full disk the file stays empty.
  if (ftruncate(fd_.get(), 0) != 0) return;
  [[maybe_unused]] const ssize_t n = pwrite(fd_.get(), text.data(), text.size(), 0);
}

std::string LockFile::Note() const {
  char text[256];
  const ssize_t n = pread(fd_.get(), text, sizeof(text), 0);
  return std::string(text, n > 0 ? static_cast<std::size_t>(n) : 0);
}

}  // namespace lanelight

#include "src/sweep/claims.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>
#include <utility>

#include "src/core/error.h"
#include "src/sweep/grid.h"

namespace lanelight {
namespace {

// Bytes beyond the end of a file can be locked too.
long Offset(const std::string& key) {
  return static_cast<long>(HashText(key) & ((std::uint64_t{1} << 62) - 1));
}

// 0, or errno.
int Lock(int file, short type, long offset) {
  struct flock range = {};
  range.l_type = type;
  range.l_whence = SEEK_SET;
  range.l_start = offset;
  range.l_len = 1;
  while (fcntl(file, F_OFD_SETLK, &range) != 0) {
    if (errno != EINTR) return errno;
  }
  return 0;
}

bool IsTaken(int error) { return error == EAGAIN || error == EACCES; }

bool IsUnsupported(int error) {
  return error == ENOLCK || error == ENOSYS || error == EINVAL || error == EOPNOTSUPP;
}

}  // namespace

Claims::Claim::Claim(Claim&& other) noexcept
    : file_(std::exchange(other.file_, -1)), offset_(other.offset_) {}

Claims::Claim::~Claim() {
  if (file_ >= 0) Lock(file_, F_UNLCK, offset_);
}

Claims::Claims(const std::string& path, bool optional) : path_(path) {
  file_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) {
    throw InputError(fmt::format("cannot write '{}': {}", path, std::strerror(errno)));
  }
  const long probe = Offset("is there locking?");
  const int error = Lock(file_, F_WRLCK, probe);
  if (error == 0) Lock(file_, F_UNLCK, probe);
  if (!IsUnsupported(error)) return;
  locking_ = false;
  if (optional) return;
  close(file_);
  throw InputError(fmt::format(
      "the file system of '{}' has no locks ({}), by which processes agree on "
      "who renders what; give each process a part of its own with --part I/N",
      path, std::strerror(error)));
}

Claims::~Claims() { close(file_); }

std::optional<Claims::Claim> Claims::Take(const std::string& key) const {
  if (!locking_) return Claim(-1, 0);
  const long offset = Offset(key);
  const int error = Lock(file_, F_WRLCK, offset);
  if (error == 0) return Claim(file_, offset);
  if (IsTaken(error)) return std::nullopt;
  throw InputError(fmt::format("cannot lock '{}': {}", path_, std::strerror(error)));
}

std::optional<Claims::Claim> Claims::Wait(const std::string& key,
                                          const std::atomic<bool>* stop) const {
  // Not F_OFD_SETLKW, which signals do not end where they restart system calls.
  constexpr auto kPause = std::chrono::milliseconds(50);
  while (stop == nullptr || !*stop) {
    if (auto claim = Take(key)) return claim;
    std::this_thread::sleep_for(kPause);
  }
  return std::nullopt;
}

}  // namespace lanelight

#include "src/core/file_lock.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>

#include "src/core/check.h"
#include "src/core/error.h"

namespace lanelight {
namespace {

[[noreturn]] void Fail(const std::string& path, const char* what) {
  throw InputError(fmt::format("{}: {}: {}", path, what, std::strerror(errno)));
}

// Zero if done. Locks of the open file, not of the process: those would be lost with the
// first descriptor of the file that any thread closes.
int SetLock(int fd, int type, std::uint64_t begin, std::uint64_t size) {
  struct flock range = {};  // l_pid must be 0
  range.l_type = static_cast<short>(type);
  range.l_whence = SEEK_SET;
  range.l_start = static_cast<off_t>(begin);
  range.l_len = static_cast<off_t>(size);
  int result;
  do {
    result = fcntl(fd, F_OFD_SETLK, &range);
  } while (result != 0 && errno == EINTR);
  return result;
}

}  // namespace

LockFile::LockFile(const std::string& path)
    : path_(path), fd_(open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  if (fd_.get() < 0) Fail(path_, "cannot open");
}

LockOutcome LockFile::TryLock(std::uint64_t begin, std::uint64_t size) {
  LL_CHECK_GT(size, 0u);  // to the kernel, 0 is everything from there on
  if (SetLock(fd_.get(), F_WRLCK, begin, size) == 0) return LockOutcome::kTaken;
  if (errno == EAGAIN || errno == EACCES) return LockOutcome::kBusy;
  if (errno == ENOSYS || errno == ENOLCK || errno == EOPNOTSUPP || errno == EINVAL) {
    return LockOutcome::kUnknown;
  }
  Fail(path_, "cannot lock");
}

void LockFile::Unlock(std::uint64_t begin, std::uint64_t size) {
  LL_CHECK_GT(size, 0u);
  if (SetLock(fd_.get(), F_UNLCK, begin, size) != 0) Fail(path_, "cannot unlock");
}

bool LockFile::IsNamed() const {
  struct stat own, named;
  return fstat(fd_.get(), &own) == 0 && stat(path_.c_str(), &named) == 0 &&
         own.st_dev == named.st_dev && own.st_ino == named.st_ino;
}

void LockFile::SetNote(const std::string& text) {
  // On a full disk the file stays as empty as it is.
  if (ftruncate(fd_.get(), 0) != 0) return;
  [[maybe_unused]] const ssize_t n = pwrite(fd_.get(), text.data(), text.size(), 0);
}

std::string LockFile::Note() const {
  char text[256];
  const ssize_t n = pread(fd_.get(), text, sizeof(text), 0);
  return std::string(text, n > 0 ? static_cast<std::size_t>(n) : 0);
}

}  // namespace lanelight

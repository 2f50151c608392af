#include "src/image/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "src/core/error.h"

namespace lanelight {
namespace {

[[noreturn]] void Fail(const std::string& path, const char* what, int error) {
  throw InputError(fmt::format("{}: {}: {}", path, what, std::strerror(error)));
}

class FileDescriptor {
 public:
  explicit FileDescriptor(int fd) : fd_(fd) {}
  ~FileDescriptor() { Close(); }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  int get() const { return fd_; }
  bool Close() { return fd_ < 0 || close(std::exchange(fd_, -1)) == 0; }

 private:
  int fd_;
};

// True once everything is written; errno says why not.
bool WriteAll(int fd, std::string_view content) {
  while (!content.empty()) {
    const ssize_t n = write(fd, content.data(), content.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    content.remove_prefix(static_cast<std::size_t>(n));
  }
  return true;
}

// Devices and pipes cannot be replaced (renaming over /dev/null would destroy it).
bool IsSpecialFile(const std::string& path) {
  struct stat info;
  return stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode) &&
         !S_ISDIR(info.st_mode);
}

void WriteInPlace(const std::string& path, std::string_view content) {
  FileDescriptor file(open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (file.get() < 0) Fail(path, "cannot open for writing", errno);
  if (!WriteAll(file.get(), content) || !file.Close()) Fail(path, "cannot write", errno);
}

}  // namespace

void WriteFileAtomically(const std::string& path, std::string_view content) {
  if (IsSpecialFile(path)) return WriteInPlace(path, content);
  static std::atomic<unsigned> counter{0};
  const std::string temporary =
      fmt::format("{}.{}.{}.tmp", path, getpid(), counter.fetch_add(1));
  FileDescriptor file(
      open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (file.get() < 0) Fail(path, "cannot create", errno);
  const bool complete = WriteAll(file.get(), content) && fsync(file.get()) == 0 &&
                        file.Close() && rename(temporary.c_str(), path.c_str()) == 0;
  if (complete) return;
  const int error = errno;
  unlink(temporary.c_str());
  Fail(path, "cannot write", error);
}

std::string ReadWholeFile(const std::string& path) {
  FileDescriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) Fail(path, "cannot open", errno);
  struct stat info;
  std::string content;
  if (fstat(file.get(), &info) == 0 && S_ISREG(info.st_mode)) {
    content.reserve(static_cast<std::size_t>(info.st_size) + 1);
  }
  std::size_t size = 0;
  for (;;) {
    content.resize(std::max(content.capacity(), size + 65536));
    const ssize_t n = read(file.get(), content.data() + size, content.size() - size);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) Fail(path, "cannot read", errno);
    if (n == 0) break;
    size += static_cast<std::size_t>(n);
  }
  content.resize(size);
  return content;
}

}  // namespace lanelight

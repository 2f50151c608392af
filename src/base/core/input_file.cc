#include "src/base/core/input_file.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>

namespace lanelight {
namespace {

const char* KindOf(mode_t mode) {
  if (S_ISREG(mode)) return "";
  if (S_ISDIR(mode)) return "a directory";
  if (S_ISFIFO(mode)) return "a FIFO (a pipe)";
  return S_ISSOCK(mode) ? "a socket" : "a device";
}

// `failed`: what the system's function has returned that was to fill `info`.
void RequireRegular(const std::string& path, int failed, const struct stat& info) {
  if (failed != 0) throw Unreadable(path, std::strerror(errno));
  if (S_ISREG(info.st_mode)) return;
  throw Unreadable(
      path,
      fmt::format(
          "it is {}, not a regular file{}", KindOf(info.st_mode),
          S_ISFIFO(info.st_mode) ? ": write what comes from it to a file first" : ""));
}

}  // namespace

Unreadable::Unreadable(const std::string& path, const std::string& reason)
    : InputError(fmt::format("{}: cannot read: {}", path, reason)), reason_(reason) {}

std::string SpecialFile(const std::string& path) {
  struct stat info;
  return ::stat(path.c_str(), &info) == 0 ? KindOf(info.st_mode) : "";
}

InputFile OpenInputFile(const std::string& path) {
  struct stat info;
  // Opening a device may already do something.
  RequireRegular(path, ::stat(path.c_str(), &info), info);
  // The path may lead elsewhere by now.
  FileDescriptor fd(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  RequireRegular(path, fd.get() < 0 ? -1 : fstat(fd.get(), &info), info);
  return {std::move(fd), static_cast<std::size_t>(info.st_size)};
}

std::string ReadWholeFile(const std::string& path) {
  const InputFile file = OpenInputFile(path);
  std::string content(file.size, '\0');
  std::size_t done = 0;
  while (done < content.size()) {
    const ssize_t n = read(file.fd.get(), content.data() + done, content.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw Unreadable(path, std::strerror(errno));
    if (n == 0) break;  // the file has become shorter meanwhile
    done += static_cast<std::size_t>(n);
  }
  content.resize(done);
  return content;
}

}  // namespace lanelight

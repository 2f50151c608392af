#include "src/base/image/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <regex>

#include "src/base/core/error.h"
#include "src/base/core/input_file.h"

namespace lanelight {
namespace {

[[noreturn]] void Fail(const std::string& path, const char* what, int error) {
  throw InputError("{}: {}: {}", path, what, std::strerror(error));
}

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

void WriteInPlace(const std::string& path, std::string_view content) {
  FileDescriptor file(open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (file.get() < 0) Fail(path, "cannot open for writing", errno);
  if (!WriteAll(file.get(), content) || !file.Close()) Fail(path, "cannot write", errno);
}

// Flushes the name of a file to the disk. Also true where that is impossible: some file
// systems do not support it, and a folder can be writable but not readable. The content
// is safe even then, under the name of the old or the new file.
bool SyncFolder(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path();
  const FileDescriptor fd(
      open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (fd.get() < 0) return errno == EACCES;
  return fsync(fd.get()) == 0 || errno == EINVAL || errno == EROFS;
}

// Creates a file beside `path`; -1 with errno. Passes over existing names, which belong
// to another machine or to a killed process of the same number.
int CreateTemporary(const std::string& path, std::string& name) {
  static std::atomic<unsigned> counter{0};
  const std::string start = TemporaryStart(path);
  int file = -1;
  do {
    name = fmt::format("{}.{}.{}.tmp", start, getpid(), counter.fetch_add(1));
    file = open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (file < 0 && errno == EEXIST);
  return file;
}

void WriteAndRename(const std::string& path, std::string_view content) {
  std::string temporary;
  FileDescriptor file(CreateTemporary(path, temporary));
  if (file.get() < 0) Fail(path, "cannot create", errno);
  const bool complete = WriteAll(file.get(), content) && fsync(file.get()) == 0 &&
                        file.Close() && rename(temporary.c_str(), path.c_str()) == 0;
  if (complete) return;
  const int error = errno;
  unlink(temporary.c_str());
  Fail(path, "cannot write", error);
}

// True if a temporary file can have this name; `start` is its TemporaryStart.
bool IsTemporaryOf(const std::string& name, const std::string& start) {
  static const std::regex digits(R"(\.\d+\.\d+\.tmp)");
  return name.starts_with(start) && std::regex_match(name.substr(start.size()), digits);
}

}  // namespace

std::string LinkTarget(const std::string& path) {
  namespace fs = std::filesystem;
  constexpr int kMaxLinks = 40;  // as the system has it
  fs::path place = path;
  std::error_code error;
  for (int i = 0; i < kMaxLinks && fs::is_symlink(place, error); ++i) {
    const fs::path target = fs::read_symlink(place, error);
    if (error) break;
    place = place.parent_path() / target;  // that of an absolute path is itself
  }
  return place.string();
}

std::string TemporaryStart(const std::string& path) {
  // Most file systems limit names to 255 bytes; some require whole characters.
  constexpr std::size_t kMaxNameLength = 220;
  const std::size_t slash = path.rfind('/');
  const std::size_t name = slash == path.npos ? 0 : slash + 1;
  if (path.size() - name <= kMaxNameLength) return path;
  std::size_t end = name + kMaxNameLength;
  while (end > name && (static_cast<unsigned char>(path[end]) & 0xc0) == 0x80) --end;
  return path.substr(0, end);
}

void WriteFileAtomically(const std::string& path, std::string_view content) {
  struct stat info;
  if (stat(path.c_str(), &info) == 0) {
    // Without a reader, writing to a pipe would block.
    if (S_ISFIFO(info.st_mode) || S_ISSOCK(info.st_mode)) {
      throw InputError(path +
                       ": cannot write: it is a pipe or a socket, not a regular file");
    }
    // A device cannot be replaced: renaming over /dev/null would destroy it.
    const bool replaceable = S_ISREG(info.st_mode) || S_ISDIR(info.st_mode);
    if (!replaceable) return WriteInPlace(path, content);
  }
  const std::string file = LinkTarget(path);
  WriteAndRename(file, content);
  if (!SyncFolder(file))
    Fail(file, "written, but its directory cannot be flushed to disk", errno);
}

void RemoveTemporaries(const std::string& path) {
  namespace fs = std::filesystem;
  const fs::path file = LinkTarget(path);
  const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
  const std::string start = TemporaryStart(file.filename());
  std::error_code ignored;
  for (fs::directory_iterator i(folder, ignored), end; i != end; i.increment(ignored)) {
    if (IsTemporaryOf(i->path().filename(), start)) fs::remove(i->path(), ignored);
  }
}

void CheckCreatable(const std::string& path) {
  std::string temporary;
  FileDescriptor file(CreateTemporary(LinkTarget(path), temporary));
  if (file.get() < 0) {
    throw InputError("cannot write '{}': {}", path, std::strerror(errno));
  }
  unlink(temporary.c_str());
}

}  // namespace lanelight

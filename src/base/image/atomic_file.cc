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

#include "src/base/core/error.h"
#include "src/base/core/file_descriptor.h"

namespace lanelight {
namespace {

[[noreturn]] void Fail(const std::string& path, const char* what, int error) {
  throw InputError(fmt::format("{}: {}: {}", path, what, std::strerror(error)));
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

// Devices and pipes cannot be replaced (renaming over /dev/null would destroy it).
bool IsSpecialFile(const std::string& path) {
  struct stat info;
  return stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode) &&
         !S_ISDIR(info.st_mode);
}

// A reader that never comes would block the program.
bool IsPipe(const std::string& path) {
  struct stat info;
  return stat(path.c_str(), &info) == 0 &&
         (S_ISFIFO(info.st_mode) || S_ISSOCK(info.st_mode));
}

void WriteInPlace(const std::string& path, std::string_view content) {
  FileDescriptor file(open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (file.get() < 0) Fail(path, "cannot open for writing", errno);
  if (!WriteAll(file.get(), content) || !file.Close()) Fail(path, "cannot write", errno);
}

// Puts the name of a file onto the disk. True if done, or if it cannot be done here: some
// file systems do not know it, and a folder may be writable but not readable. The content
// is safe even so, and the name is that of the old file or the new one.
bool SyncFolder(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path();
  const FileDescriptor fd(
      open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (fd.get() < 0) return errno == EACCES;
  return fsync(fd.get()) == 0 || errno == EINVAL || errno == EROFS;
}

// A new file beside `path`; -1 with errno. A name that is there already is another
// machine's, or was left by a killed process of the same number: the next one is taken.
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

// Returns whether `name` is one that a temporary file of `start` may have, which is of
// TemporaryStart.
bool IsTemporaryOf(const std::string& name, const std::string& start) {
  constexpr std::string_view kEnd = ".tmp";
  if (!name.starts_with(start + ".") || !name.ends_with(kEnd)) return false;
  if (name.size() <= start.size() + 1 + kEnd.size()) return false;
  const std::string middle =
      name.substr(start.size() + 1, name.size() - start.size() - 1 - kEnd.size());
  const std::size_t dot = middle.find('.');
  return dot != middle.npos && dot > 0 && dot + 1 < middle.size() &&
         middle.find_first_not_of("0123456789", dot + 1) == middle.npos &&
         middle.find_first_not_of("0123456789") == dot;
}

}  // namespace

std::string LinkTarget(const std::string& path) {
  namespace fs = std::filesystem;
  constexpr int kMostLinks = 40;  // as the system has it
  fs::path place = path;
  std::error_code error;
  for (int i = 0; i < kMostLinks && fs::is_symlink(place, error); ++i) {
    const fs::path target = fs::read_symlink(place, error);
    if (error) break;
    place = place.parent_path() / target;  // that of an absolute path is itself
  }
  return place.string();
}

std::string TemporaryStart(const std::string& path) {
  // Most file systems have 255 bytes for a name, and some want whole characters.
  constexpr std::size_t kMost = 220;
  const std::size_t slash = path.rfind('/');
  const std::size_t name = slash == path.npos ? 0 : slash + 1;
  if (path.size() - name <= kMost) return path;
  std::size_t end = name + kMost;
  while (end > name && (static_cast<unsigned char>(path[end]) & 0xc0) == 0x80) --end;
  return path.substr(0, end);
}

void WriteFileAtomically(const std::string& path, std::string_view content) {
  if (IsPipe(path)) {
    throw InputError(path +
                     ": cannot write: it is a pipe or a socket, not a regular file");
  }
  if (IsSpecialFile(path)) return WriteInPlace(path, content);
  const std::string file = LinkTarget(path);
  WriteAndRename(file, content);
  if (!SyncFolder(file)) Fail(file, "written, but its folder cannot be", errno);
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
    throw InputError(fmt::format("cannot write '{}': {}", path, std::strerror(errno)));
  }
  unlink(temporary.c_str());
}

}  // namespace lanelight

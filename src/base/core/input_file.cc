#include "src/base/core/input_file.h"

#include <fmt/format.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "src/base/core/check.h"
#include "src/base/core/error.h"

namespace lanelight {
namespace {

const char* KindOf(mode_t mode) {
  if (S_ISREG(mode)) return "";
  if (S_ISDIR(mode)) return "a directory";
  if (S_ISFIFO(mode)) return "a FIFO (a pipe)";
  return S_ISSOCK(mode) ? "a socket" : "a device";
}

// `failed`: the result of the system call that fills `info`.
void RequireRegular(const std::string& path, int failed, const struct stat& info) {
  if (failed != 0) throw Unreadable(path, std::strerror(errno));
  if (S_ISREG(info.st_mode)) return;
  throw Unreadable(
      path,
      fmt::format(
          "it is {}, not a regular file{}", KindOf(info.st_mode),
          S_ISFIFO(info.st_mode) ? ": write what comes from it to a file first" : ""));
}

constexpr std::size_t kMiB = std::size_t{1} << 20;
constexpr std::size_t kMaxStep = std::size_t{1} << 30;  // zlib counts in 32 bits
constexpr int kGzipOnly = 15 + 16;                      // window bits, as zlib wants them

class Inflater {
 public:
  explicit Inflater(std::string_view packed) : rest_(packed) {
    LL_CHECK(inflateInit2(&stream_, kGzipOnly) == Z_OK);
  }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  std::string All(std::size_t max_size) {
    std::string out;
    std::size_t size = 0;
    while (!ended_ && size <= max_size) {
      if (size == out.size()) {
        // One byte more than allowed shows that there is more.
        const std::size_t grown = std::max(2 * size, rest_.size() * 4 + 4096);
        out.resize(std::min(grown, max_size + 1));
      }
      size = Step(out, size);
    }
    if (size > max_size) {
      throw InputError("it unpacks to more than {} MiB; unpack it yourself",
                       max_size / kMiB);
    }
    out.resize(size);
    return out;
  }

 private:
  // Fills `out` from `size` on; returns the new size. Sets ended_ after the last member.
  std::size_t Step(std::string& out, std::size_t size) {
    const std::size_t in = std::min(rest_.size(), kMaxStep);
    const std::size_t room = std::min(out.size() - size, kMaxStep);
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(rest_.data()));
    stream_.avail_in = static_cast<uInt>(in);
    stream_.next_out = reinterpret_cast<Bytef*>(out.data() + size);
    stream_.avail_out = static_cast<uInt>(room);
    const int result = inflate(&stream_, Z_NO_FLUSH);
    const std::size_t consumed = in - stream_.avail_in;
    rest_.remove_prefix(consumed);
    if (result == Z_STREAM_END) {
      ended_ = rest_.find_first_not_of('\0') == rest_.npos;  // zeros pad what tapes hold
      if (!ended_) LL_CHECK(inflateReset(&stream_) == Z_OK);
    } else if (result == Z_BUF_ERROR || (result == Z_OK && rest_.empty() &&
                                         consumed == 0 && stream_.avail_out > 0)) {
      throw InputError("the compressed data is truncated");
    } else if (result != Z_OK) {
      throw InputError("the compressed data is damaged ({})",
                       stream_.msg == nullptr ? "gzip" : stream_.msg);
    }
    return size + room - stream_.avail_out;
  }

  z_stream stream_ = {};
  std::string_view rest_;
  bool ended_ = false;
};

}  // namespace

Unreadable::Unreadable(const std::string& path, const std::string& reason)
    : InputError("{}: cannot read: {}", path, reason), reason_(reason) {}

std::string SpecialFile(const std::string& path) {
  struct stat info;
  return ::stat(path.c_str(), &info) == 0 ? KindOf(info.st_mode) : "";
}

InputFile OpenInputFile(const std::string& path) {
  struct stat info;
  // Opening a device can have effects.
  RequireRegular(path, ::stat(path.c_str(), &info), info);
  // The path can name another file now.
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

bool IsGzip(std::string_view path, std::string_view content) {
  return path.ends_with(".gz") || content.starts_with("\x1f\x8b");
}

std::size_t MaxUnpackedSize(std::size_t packed) {
  const std::size_t max_bytes = 4096 * kMiB;
  return packed > max_bytes / 100 ? max_bytes : std::max(100 * packed, 256 * kMiB);
}

std::string Gunzip(std::string_view packed, std::size_t max_size) {
  return Inflater(packed).All(max_size);
}

}  // namespace lanelight

#include "src/base/state/seal.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <vector>

#include "src/base/core/check.h"
#include "src/base/core/error.h"
#include "src/base/core/hash.h"

namespace lanelight {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::string_view kMagic = "lanelight state\n";

struct SealBlock {
  char magic[16];
  std::uint64_t schema, length, content;
  char zeros[464];
  std::uint64_t seal;
};
static_assert(sizeof(SealBlock) == kSealBytes && kMagic.size() == 16);

std::uint64_t HashOfSeal(const SealBlock& block) {
  return Hash64(&block, offsetof(SealBlock, seal));
}

template <class... Args>
[[noreturn]] void Refuse(const std::string& path, fmt::format_string<Args...> format,
                         Args&&... args) {
  throw InputError("{}: {}", path, fmt::format(format, std::forward<Args>(args)...));
}

// Reads up to `size` bytes; returns how many there were.
std::size_t Read(int fd, const std::string& path, void* bytes, std::size_t size) {
  std::size_t done = 0;
  while (done < size) {
    const ssize_t n = read(fd, static_cast<char*>(bytes) + done, size - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) Refuse(path, "cannot read: {}", std::strerror(errno));
    if (n == 0) break;
    done += static_cast<std::size_t>(n);
  }
  return done;
}

void CheckBlock(const SealBlock& block, std::size_t size, const std::string& path,
                std::uint64_t schema) {
  if (size == 0) Refuse(path, "is empty, not a state file");
  if (std::memcmp(block.magic, kMagic.data(), std::min(size, kMagic.size())) != 0) {
    Refuse(path, "not a state file of lanelight, or its beginning is damaged");
  }
  if (size < sizeof(block)) {
    Refuse(path, "the state is truncated to {} bytes", size);
  }
  if (HashOfSeal(block) != block.seal) {
    Refuse(path, "the state is damaged: the checksum of its first 512 bytes is wrong");
  }
  if (block.schema != schema) {
    Refuse(path, "the state is of schema {}; this program reads schema {}", block.schema,
           schema);
  }
}

}  // namespace

void Seal(char* file, std::size_t bytes, std::uint64_t schema) {
  LL_CHECK_GE(bytes, kSealBytes);
  SealBlock block = {};
  std::memcpy(block.magic, kMagic.data(), kMagic.size());
  block.schema = schema;
  block.length = bytes;
  block.content = Hash64(file + kSealBytes, bytes - kSealBytes);
  block.seal = HashOfSeal(block);
  std::memcpy(file, &block, sizeof(block));
}

std::uint64_t CheckSeal(int fd, const std::string& path, std::uint64_t schema) {
  SealBlock block = {};
  CheckBlock(block, Read(fd, path, &block, sizeof(block)), path, schema);
  struct stat info;
  if (fstat(fd, &info) != 0) Refuse(path, "cannot read: {}", std::strerror(errno));
  const std::uint64_t size = static_cast<std::uint64_t>(info.st_size);
  if (size != block.length) {
    Refuse(path, "the state is truncated: it has {} of {} bytes", size, block.length);
  }
  StreamHash hash;
  std::vector<char> buffer(1 << 18);  // stays in the second cache
  for (;;) {
    const std::size_t n = Read(fd, path, buffer.data(), buffer.size());
    hash.Add(buffer.data(), n);
    if (n < buffer.size()) break;
  }
  if (hash.Digest() != block.content) {
    Refuse(path, "the state is damaged: the checksum of its content is wrong");
  }
  return size;
}

}  // namespace lanelight

// Hashes are XXH3's, in one piece or in several.
#include "src/base/core/hash.h"

#include <xxhash.h>

#include <catch2/catch.hpp>
#include <string>
#include <vector>

namespace lanelight {
namespace {

std::string BytesToHash(std::size_t size) {
  std::string bytes;
  for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(i * i / 7 + i);
  return bytes;
}

}  // namespace

TEST_CASE("hashes equal those of the library", "[core][hash]") {
  for (std::size_t size : {0u, 1u, 16u, 240u, 241u, 5000u}) {
    const std::string bytes = BytesToHash(size);
    CHECK(Hash64(bytes) == XXH3_64bits(bytes.data(), size));
    const XXH128_hash_t wide = XXH3_128bits(bytes.data(), size);
    CHECK(HashTo128(bytes.data(), size) == Hash128{wide.low64, wide.high64});
  }
}

TEST_CASE("hashing in pieces gives the hash of the whole", "[core][hash]") {
  const std::string bytes = BytesToHash(3000);
  StreamHash hash;
  for (std::size_t begin = 0; begin < bytes.size(); begin += 7) {
    hash.Add(bytes.data() + begin, std::min<std::size_t>(7, bytes.size() - begin));
  }
  CHECK(hash.Digest() == Hash64(bytes));
}

TEST_CASE("the length of an array is part of its hash", "[core][hash]") {
  const auto digest = [](const std::vector<int>& a, const std::vector<int>& b) {
    StreamHash hash;
    hash.AddArray(a);
    hash.AddArray(b);
    return hash.Digest();
  };
  CHECK(digest({1, 2}, {3}) == digest({1, 2}, {3}));
  CHECK(digest({1, 2}, {3}) != digest({1}, {2, 3}));
  CHECK(digest({}, {0}) != digest({0}, {}));
}

}  // namespace lanelight

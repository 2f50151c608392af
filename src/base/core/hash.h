// XXH3 hashes of bytes; not cryptographic.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <type_traits>

namespace lanelight {

std::uint64_t Hash64(const void* bytes, std::size_t size);
inline std::uint64_t Hash64(std::string_view text) {
  return Hash64(text.data(), text.size());
}

struct Hash128 {
  std::uint64_t low = 0, high = 0;
  friend bool operator==(const Hash128&, const Hash128&) = default;
};
Hash128 HashTo128(const void* bytes, std::size_t size);

/// Hash64 of bytes that come in pieces.
class StreamHash {
 public:
  StreamHash();
  ~StreamHash();
  StreamHash(const StreamHash&) = delete;
  StreamHash& operator=(const StreamHash&) = delete;
  void Add(const void* bytes, std::size_t size);
  /// Adds the number of values, then their bytes.
  template <class Values>
  void AddArray(const Values& values) {
    static_assert(std::is_trivially_copyable_v<typename Values::value_type>);
    const std::uint64_t count = values.size();
    Add(&count, sizeof(count));
    Add(values.data(), count * sizeof(typename Values::value_type));
  }
  std::uint64_t Digest() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lanelight

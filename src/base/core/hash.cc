#include "src/base/core/hash.h"

#include <xxhash.h>

#include <new>

namespace lanelight {

std::uint64_t Hash64(const void* bytes, std::size_t size) {
  return XXH3_64bits(bytes, size);
}

Hash128 HashTo128(const void* bytes, std::size_t size) {
  const XXH128_hash_t hash = XXH3_128bits(bytes, size);
  return {hash.low64, hash.high64};
}

struct StreamHash::State {
  XXH3_state_t* const of_library = XXH3_createState();
  ~State() { XXH3_freeState(of_library); }
};

StreamHash::StreamHash() : state_(std::make_unique<State>()) {
  if (state_->of_library == nullptr) throw std::bad_alloc();
  XXH3_64bits_reset(state_->of_library);
}
StreamHash::~StreamHash() = default;

void StreamHash::Add(const void* bytes, std::size_t size) {
  XXH3_64bits_update(state_->of_library, bytes, size);
}

std::uint64_t StreamHash::Digest() const {
  return XXH3_64bits_digest(state_->of_library);
}

}  // namespace lanelight

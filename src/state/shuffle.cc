#include "src/state/shuffle.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include "src/core/check.h"

// Values are halved until bytes are left, or bytes joined to pairs until values are
// there: simple loops over a block in the first cache, which compilers vectorise.
namespace lanelight {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::size_t kBlock = 512;

template <class Half, class Whole>
void Split(const Whole* whole, std::size_t n, Half* low, Half* high) {
  for (std::size_t i = 0; i < n; ++i) low[i] = static_cast<Half>(whole[i]);
  for (std::size_t i = 0; i < n; ++i) {
    high[i] = static_cast<Half>(whole[i] >> (8 * sizeof(Half)));
  }
}

template <class Half, class Whole>
void Join(const Half* low, const Half* high, std::size_t n, Whole* whole) {
  for (std::size_t i = 0; i < n; ++i) {
    whole[i] = static_cast<Whole>(low[i] | Whole{high[i]} << (8 * sizeof(Half)));
  }
}

// Plane b of the block begins at planes + b * stride.
void Split32(const std::uint32_t* values, std::size_t n, std::size_t stride,
             unsigned char* planes) {
  std::uint16_t low[kBlock], high[kBlock];
  Split(values, n, low, high);
  Split(low, n, planes, planes + stride);
  Split(high, n, planes + 2 * stride, planes + 3 * stride);
}

void Join32(const unsigned char* planes, std::size_t n, std::size_t stride,
            std::uint32_t* values) {
  std::uint16_t low[kBlock], high[kBlock];
  Join(planes, planes + stride, n, low);
  Join(planes + 2 * stride, planes + 3 * stride, n, high);
  Join(low, high, n, values);
}

}  // namespace

void Shuffle(const void* values, std::size_t size, std::size_t count,
             unsigned char* planes) {
  LL_CHECK(size == 4 || size == 8);
  for (std::size_t i = 0; i < count; i += kBlock) {
    const std::size_t n = std::min(kBlock, count - i);
    std::uint32_t low[kBlock], high[kBlock];
    const char* source = static_cast<const char*>(values) + i * size;
    if (size == 4) {
      std::memcpy(low, source, n * 4);
    } else {
      std::uint64_t whole[kBlock];
      std::memcpy(whole, source, n * 8);
      Split(whole, n, low, high);
      Split32(high, n, count, planes + 4 * count + i);
    }
    Split32(low, n, count, planes + i);
  }
}

void Unshuffle(const unsigned char* planes, std::size_t size, std::size_t count,
               void* values) {
  LL_CHECK(size == 4 || size == 8);
  for (std::size_t i = 0; i < count; i += kBlock) {
    const std::size_t n = std::min(kBlock, count - i);
    std::uint32_t low[kBlock], high[kBlock];
    char* target = static_cast<char*>(values) + i * size;
    Join32(planes + i, n, count, low);
    if (size == 4) {
      std::memcpy(target, low, n * 4);
    } else {
      std::uint64_t whole[kBlock];
      Join32(planes + 4 * count + i, n, count, high);
      Join(low, high, n, whole);
      std::memcpy(target, whole, n * 8);
    }
  }
}

}  // namespace lanelight

#include "src/state/chunk_codec.h"

#include <libdeflate.h>
#include <zlib.h>

#include <cstdint>
#include <new>

#include "src/core/check.h"
#include "src/state/shuffle.h"

namespace lanelight {
namespace {

constexpr int kFastest = 1, kStored = 0;
constexpr int kWindowBits = 15, kMemLevel = 9;  // both the most: blocks of 32 Ki symbols

// Whether Huffman codes would gain next to nothing on these bytes: two of a sample are
// the same about as often as two of 256 equally likely ones. 1.15 is a Renyi entropy of
// 7.8 bits, which no Shannon entropy is below; two thousand bytes know it to 1 %.
bool IsNoise(const unsigned char* bytes, std::size_t n) {
  constexpr std::size_t kSample = 2048;
  if (n < kSample) return false;
  std::uint32_t counts[256] = {};
  const std::size_t stride = n / kSample;
  for (std::size_t i = 0; i < kSample; ++i) ++counts[bytes[i * stride]];
  double equal = 0;  // ordered pairs
  for (std::uint32_t c : counts) equal += double(c) * (double(c) - 1);
  return equal * 256 < 1.15 * double(kSample) * double(kSample - 1);
}

}  // namespace

struct ChunkEncoder::Stream : z_stream {
  Stream() : z_stream{} {
    const int result =
        deflateInit2(this, kFastest, Z_DEFLATED, kWindowBits, kMemLevel, Z_RLE);
    if (result != Z_OK) throw std::bad_alloc();
  }
  ~Stream() { deflateEnd(this); }
};

ChunkEncoder::ChunkEncoder() : stream_(std::make_unique<Stream>()) {}
ChunkEncoder::~ChunkEncoder() = default;

void ChunkEncoder::Encode(const void* values, std::size_t size, std::size_t count,
                          std::vector<unsigned char>& out) {
  planes_.resize(size * count);
  Shuffle(values, size, count, planes_.data());
  z_stream& z = *stream_;
  LL_CHECK_EQ(deflateReset(&z), Z_OK);
  out.resize(deflateBound(&z, planes_.size()) + 64 * size);
  z.next_out = out.data();
  z.avail_out = static_cast<uInt>(out.size());
  z.avail_in = 0;
  for (std::size_t b = 0; b < size; ++b) {
    unsigned char* plane = planes_.data() + b * count;
    const int level = IsNoise(plane, count) ? kStored : kFastest;
    LL_CHECK_EQ(deflateParams(&z, level, Z_RLE), Z_OK);
    z.next_in = plane;
    z.avail_in = static_cast<uInt>(count);
    const bool last = b + 1 == size;
    LL_CHECK_EQ(deflate(&z, last ? Z_FINISH : Z_BLOCK), last ? Z_STREAM_END : Z_OK);
    LL_CHECK_EQ(z.avail_in, 0u);
  }
  out.resize(z.total_out);
}

struct ChunkDecoder::Stream {
  libdeflate_decompressor* decompressor = libdeflate_alloc_decompressor();
  Stream() {
    if (decompressor == nullptr) throw std::bad_alloc();
  }
  ~Stream() { libdeflate_free_decompressor(decompressor); }
};

ChunkDecoder::ChunkDecoder() : stream_(std::make_unique<Stream>()) {}
ChunkDecoder::~ChunkDecoder() = default;

bool ChunkDecoder::Decode(const std::vector<unsigned char>& chunk, std::size_t size,
                          std::size_t count, void* values) {
  planes_.resize(size * count);
  const libdeflate_result result =
      libdeflate_zlib_decompress(stream_->decompressor, chunk.data(), chunk.size(),
                                 planes_.data(), planes_.size(), nullptr);
  if (result != LIBDEFLATE_SUCCESS) return false;
  Unshuffle(planes_.data(), size, count, values);
  return true;
}

}  // namespace lanelight

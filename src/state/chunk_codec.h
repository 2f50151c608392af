// One chunk of a dataset with HDF5's filters "shuffle" and "deflate", without HDF5: many
// threads may compress and expand chunks at a time, which its own filters do not allow.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace lanelight {

/// Compresses chunks; one thread at a time. Sums of floats in double are mostly noise:
/// bytes that look like noise are stored, the others deflated (runs and Huffman codes),
/// which takes half the time of deflating all and gains as much.
class ChunkEncoder {
 public:
  ChunkEncoder();
  ~ChunkEncoder();
  ChunkEncoder(const ChunkEncoder&) = delete;
  ChunkEncoder& operator=(const ChunkEncoder&) = delete;

  /// `out` becomes the chunk of `count` values of `size` bytes (4 or 8).
  void Encode(const void* values, std::size_t size, std::size_t count,
              std::vector<unsigned char>& out);

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
  std::vector<unsigned char> planes_;
};

/// Expands chunks; one thread at a time.
class ChunkDecoder {
 public:
  ChunkDecoder();
  ~ChunkDecoder();
  ChunkDecoder(const ChunkDecoder&) = delete;
  ChunkDecoder& operator=(const ChunkDecoder&) = delete;

  /// False unless the chunk expands to exactly `count` values of `size` bytes and its
  /// checksum (Adler-32) is right.
  bool Decode(const std::vector<unsigned char>& chunk, std::size_t size,
              std::size_t count, void* values);

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
  std::vector<unsigned char> planes_;
};

}  // namespace lanelight

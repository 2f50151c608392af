#define QOI_IMPLEMENTATION
#define QOI_NO_STDIO
#include <qoi.h>

#include <algorithm>
#include <cstdlib>
#include <memory>

#include "src/base/core/error.h"
#include "src/base/image/decode.h"

namespace lanelight {
namespace {

constexpr std::size_t kHeader = 14, kEnd = 8;  // bytes before and after the pixels

// Bytes of the chunk that begins with this byte.
std::size_t ChunkSize(unsigned char first) {
  if (first == QOI_OP_RGB) return 4;
  if (first == QOI_OP_RGBA) return 5;
  return (first & QOI_MASK_2) == QOI_OP_LUMA ? 2 : 1;
}

std::size_t ChunkPixels(unsigned char first) {
  if (first == QOI_OP_RGB || first == QOI_OP_RGBA) return 1;
  return (first & QOI_MASK_2) == QOI_OP_RUN ? (first & 0x3f) + std::size_t{1} : 1;
}

// True if the chunks hold so many pixels. The library repeats the last pixel where chunks
// are missing.
bool HasPixels(const std::string& content, std::size_t pixels) {
  std::size_t at = kHeader;
  while (pixels > 0) {
    if (at + kEnd >= content.size()) return false;
    const auto first = static_cast<unsigned char>(content[at]);
    at += ChunkSize(first);
    pixels -= std::min(pixels, ChunkPixels(first));
  }
  return at + kEnd <= content.size();
}

std::size_t NumberAt(const std::string& content, int at) {
  return qoi_read_32(reinterpret_cast<const unsigned char*>(content.data()), &at);
}

}  // namespace

Image DecodeQoi(const std::string& path, const std::string& content) {
  const std::string truncated = path + ": the image file is truncated";
  if (content.size() < kHeader + kEnd) throw InputError(truncated);
  const std::size_t width = NumberAt(content, 4), height = NumberAt(content, 8);
  constexpr double kLongestRun = 62;
  CheckImageFits(path, static_cast<long long>(width), static_cast<long long>(height),
                 kLongestRun, content.size());
  if (!HasPixels(content, width * height)) throw InputError(truncated);
  qoi_desc header;
  const std::unique_ptr<void, decltype(&std::free)> pixels(
      qoi_decode(content.data(), static_cast<int>(content.size()), &header, 0),
      &std::free);
  if (!pixels) throw InputError(path + ": the image file is damaged: its QOI header");
  Image image;
  image.width = static_cast<int>(width), image.height = static_cast<int>(height);
  image.channels = header.channels;
  image.names = ChannelNames(image.channels);
  const auto* bytes = static_cast<const std::uint8_t*>(pixels.get());
  const std::size_t samples = image.Offset(0, image.height, 0);
  if (header.colorspace == QOI_SRGB) {
    image.bytes.assign(bytes, bytes + samples);
  } else {
    for (std::size_t i = 0; i < samples; ++i) {
      image.pixels.push_back(static_cast<float>(bytes[i]) / 255);
    }
  }
  return image;
}

}  // namespace lanelight

// Portable float map: a text header, then float rows from the bottom up.
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <string_view>

#include "src/base/core/check.h"
#include "src/base/core/error.h"
#include "src/base/core/input_file.h"
#include "src/base/core/value_types.h"
#include "src/base/image/atomic_file.h"
#include "src/base/image/decode.h"

namespace lanelight {
namespace {

static_assert(std::endian::native == std::endian::little);

bool IsSpace(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

// Next word of the header; `at` moves past it and one white space character.
std::string_view NextWord(std::string_view text, std::size_t& at) {
  while (at < text.size() && IsSpace(text[at])) ++at;
  const std::size_t begin = at;
  while (at < text.size() && !IsSpace(text[at])) ++at;
  const std::string_view word = text.substr(begin, at - begin);
  if (at < text.size()) ++at;
  return word;
}

template <class T>
T HeaderNumber(const std::string& path, std::string_view word, const char* what) {
  const std::optional<T> value = ParseNumber<T>(word);
  if (!value) {
    throw InputError("{}: bad {} \"{}\" in the PFM header", path, what,
                     word.substr(0, 20));
  }
  return *value;
}

float FromBytes(const char* bytes, bool big_endian) {
  std::uint32_t word;
  std::memcpy(&word, bytes, 4);
  return std::bit_cast<float>(big_endian ? __builtin_bswap32(word) : word);
}

}  // namespace

Image ReadPfm(const std::string& path) {
  const std::string file = ReadWholeFile(path);
  std::size_t at = 0;
  const std::string_view magic = NextWord(file, at);
  if (magic != "PF" && magic != "Pf") {
    throw InputError(path + ": not a PFM file (it begins with neither PF nor Pf)");
  }
  const auto width = HeaderNumber<long long>(path, NextWord(file, at), "width");
  const auto height = HeaderNumber<long long>(path, NextWord(file, at), "height");
  CheckImageSize(path, width, height);
  const auto scale = HeaderNumber<double>(path, NextWord(file, at), "scale");
  if (!std::isfinite(scale) || scale == 0) {
    throw InputError(path + ": the scale of a PFM file must be finite and not zero");
  }
  const int channels = magic == "PF" ? 3 : 1;
  const std::size_t row = static_cast<std::size_t>(width) * channels;
  const std::size_t need = row * static_cast<std::size_t>(height) * 4;
  if (file.size() - at < need) {
    throw InputError("{}: the image file is truncated: {} bytes of pixels, {} expected",
                     path, file.size() - at, need);
  }
  Image image = MakeImage(static_cast<int>(width), static_cast<int>(height),
                          ChannelNames(channels));
  const float factor = static_cast<float>(std::abs(scale));
  for (int y = 0; y < image.height; ++y) {
    const char* from = file.data() + at + row * 4 * (image.height - 1 - y);
    float* to = image.pixels.data() + row * y;
    for (std::size_t i = 0; i < row; ++i)
      to[i] = factor * FromBytes(from + 4 * i, scale > 0);
  }
  return image;
}

void WritePfm(const std::string& path, const Image& image) {
  LL_CHECK(!image.is_bytes() && (image.channels == 1 || image.channels == 3));
  std::string file = fmt::format("{}\n{} {}\n-1\n", image.channels == 3 ? "PF" : "Pf",
                                 image.width, image.height);
  const std::size_t row = image.Offset(0, 1, 0);
  for (int y = image.height - 1; y >= 0; --y) {
    file.append(reinterpret_cast<const char*>(image.pixels.data() + row * y), row * 4);
  }
  WriteFileAtomically(path, file);
}

}  // namespace lanelight

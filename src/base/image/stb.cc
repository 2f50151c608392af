
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wsign-compare"
#define STBI_NO_STDIO
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_GIF
#define STBI_ONLY_PNM
#define STBI_ONLY_PSD
#define STBI_ONLY_TGA
#define STBI_ONLY_JPEG
#define STBI_ONLY_BMP
#define STBI_ONLY_HDR
#include <stb/stb_image.h>
#define STBI_WRITE_NO_STDIO
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string_view>
#include <type_traits>

#include "src/base/core/check.h"
#include "src/base/core/error.h"
#include "src/base/core/input_file.h"
#include "src/base/image/decode.h"

namespace lanelight {
namespace {

// The input of stb. stb reads zeros past the end of a file, so that a truncated image
// would look valid; here every read past the end is detected.
class Source {
 public:
  explicit Source(const std::string& content) : content_(content) {}

  /// Gives runs of equal bytes, not zeros, past the end. The decoder of HDR files goes
  /// through zeros for ever; runs end it, or fail.
  void EndInRuns() { runs_ = true; }

  static const stbi_io_callbacks* Callbacks() {
    static const stbi_io_callbacks callbacks = {&Source::Read, &Source::Skip,
                                                &Source::End};
    return &callbacks;
  }
  void Rewind() {
    at_ = 0;
    look_ahead_ = nullptr;
    overrun_ = false;
  }
  bool overrun() const { return overrun_; }

 private:
  static int Read(void* self, char* data, int size) {
    return static_cast<Source*>(self)->ReadBytes(data, size);
  }
  static void Skip(void* self, int n) {
    Source* source = static_cast<Source*>(self);
    const long long to = static_cast<long long>(source->at_) + n;  // n < 0 steps back
    const long long end = static_cast<long long>(source->content_.size());
    source->overrun_ |= to > end;
    source->at_ = static_cast<std::size_t>(std::clamp(to, 0LL, end));
  }
  static int End(void* self) {
    const Source* source = static_cast<const Source*>(self);
    return source->at_ >= source->content_.size();
  }
  // Reads into stb's look-ahead buffer, the target of the first read, may be short at the
  // end of the file, but not empty. Other reads need all bytes.
  int ReadBytes(char* data, int size) {
    if (look_ahead_ == nullptr) look_ahead_ = data;
    const std::size_t n =
        std::min(static_cast<std::size_t>(std::max(size, 0)), content_.size() - at_);
    overrun_ |= n < static_cast<std::size_t>(size) && (n == 0 || data != look_ahead_);
    std::memcpy(data, content_.data() + at_, n);
    at_ += n;
    if (!runs_ || n > 0) return static_cast<int>(n);
    std::memset(data, 0xff, static_cast<std::size_t>(std::max(size, 0)));
    return size;
  }

  const std::string& content_;
  std::size_t at_ = 0;
  const char* look_ahead_ = nullptr;
  bool overrun_ = false, runs_ = false;
};

struct FreeStb {
  void operator()(void* p) const { stbi_image_free(p); }
};

struct Format {
  std::string_view magic;  // what its files begin with
  double pixels_per_byte;  // at best
};
// The last one matches any file.
constexpr Format kFormats[] = {
    {"\xff\xd8", 512},  // JPEG: a bit for a block of 8 x 8
    {"\xff\xff", 512},  // the same, after fill bytes
    {"GIF8", 4096},     // the longest run that a code stands for, in 8 bits or more
    {"8BPS", 64},       // PSD: runs of 128 in two bytes, as in TGA
    {"BM", 8},          // BMP: a bit each, runs are not read
    {"P5", 1},          // PGM
    {"P6", 1},          // PPM
    {"#?", 16},         // HDR: four runs of 127 in eight bytes
    {"", 64},           // TGA
};

double PixelsPerByte(const std::string& content) {
  return std::find_if(std::begin(kFormats), std::end(kFormats),
                      [&](const Format& f) { return content.starts_with(f.magic); })
      ->pixels_per_byte;
}

[[noreturn]] void FailDecode(const std::string& path) {
  const char* reason = stbi_failure_reason();
  throw InputError(path +
                   ": cannot decode the image: " + (reason ? reason : "unknown type"));
}

// Size and channels, checked before anything is allocated.
Image ReadStbHeader(const std::string& path, const std::string& content, Source& source) {
  if (content.starts_with(kFormats[0].magic) || content.starts_with(kFormats[1].magic)) {
    CheckJpeg(path, content);
  }
  Image image;
  if (!stbi_info_from_callbacks(Source::Callbacks(), &source, &image.width, &image.height,
                                &image.channels)) {
    if (source.overrun()) throw InputError(path + ": the image file is truncated");
    throw InputError(path +
                     ": not an image that can be read; supported: exr, pfm, hdr, png, "
                     "qoi, jpg, tga, bmp, gif, psd, ppm, pgm");
  }
  // The height of a BMP with rows from the top is negative.
  CheckImageFits(path, image.width, std::abs(static_cast<long long>(image.height)),
                 PixelsPerByte(content), content.size());
  source.Rewind();
  if (content[0] == 'P' && stbi_is_16_bit_from_callbacks(Source::Callbacks(), &source)) {
    throw InputError(path + ": PGM and PPM of 16 bits are not read; save as PNG");
  }
  source.Rewind();
  return image;
}

template <class T, class Load>
Image DecodeByStb(const std::string& path, const std::string& content, Load load,
                  AlignedVector<T> Image::* pixels) {
  Source source(content);
  Image image = ReadStbHeader(path, content, source);
  if constexpr (std::is_same_v<T, float>) source.EndInRuns();
  const std::unique_ptr<T, FreeStb> data(load(Source::Callbacks(), &source, &image.width,
                                              &image.height, &image.channels, 0));
  if (source.overrun()) throw InputError(path + ": the image file is truncated");
  if (!data) FailDecode(path);
  image.names = ChannelNames(image.channels);
  (image.*pixels).assign(data.get(), data.get() + image.Offset(0, image.height, 0));
  return image;
}

}  // namespace

Image DecodeBytes(const std::string& path, const std::string& content) {
  if (content.starts_with("\x89PNG")) return DecodePng(path, content);
  if (content.starts_with("qoif")) return DecodeQoi(path, content);
  return DecodeByStb<std::uint8_t>(path, content, &stbi_load_from_callbacks,
                                   &Image::bytes);
}

Image ReadHdr(const std::string& path) {
  return DecodeByStb<float>(path, ReadWholeFile(path), &stbi_loadf_from_callbacks,
                            &Image::pixels);
}

std::string EncodePng(int width, int height, const std::vector<std::uint8_t>& rgb) {
  LL_CHECK_EQ(rgb.size(), static_cast<std::size_t>(width) * height * 3);
  std::string file;
  const auto append = [](void* to, void* data, int size) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(data), size);
  };
  const int stride = 3 * width;
  LL_CHECK(stbi_write_png_to_func(append, &file, width, height, 3, rgb.data(), stride));
  return file;
}

}  // namespace lanelight

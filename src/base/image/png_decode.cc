#include <png.h>

#include <csetjmp>
#include <cstring>
#include <vector>

#include "src/base/core/error.h"
#include "src/base/image/decode.h"

namespace lanelight {
namespace {

// libpng reports errors by longjmp. Objects live here, in the caller's frame; functions
// that call setjmp have no objects with destructors.
struct PngReader {
  explicit PngReader(const std::string& file) : content(file) {
    png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, &Fail, &Warn);
    info = png_create_info_struct(png);
  }
  ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  [[noreturn]] static void Fail(png_structp png, png_const_charp why) {
    static_cast<PngReader*>(png_get_error_ptr(png))->reason = why;
    png_longjmp(png, 1);
  }
  static void Warn(png_structp, png_const_charp) {}
  static void Read(png_structp png, png_bytep to, std::size_t size) {
    auto* self = static_cast<PngReader*>(png_get_io_ptr(png));
    if (self->content.size() - self->at < size) {
      self->truncated = true;
      png_error(png, "truncated");
    }
    std::memcpy(to, self->content.data() + self->at, size);
    self->at += size;
  }

  const std::string& content;
  std::size_t at = 0;
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::string reason;
  bool truncated = false;
};

bool ReadHeader(PngReader& r) {
  if (setjmp(png_jmpbuf(r.png)) != 0) return false;
  png_set_read_fn(r.png, &r, &PngReader::Read);
  png_set_crc_action(r.png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
  png_set_user_limits(r.png, kMaxImageSide, kMaxImageSide);
  // Skips texts, profiles and the like, which may unpack to any size.
  png_set_keep_unknown_chunks(r.png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
  png_read_info(r.png, r.info);
  return true;
}

bool SetOutput(PngReader& r) {
  if (setjmp(png_jmpbuf(r.png)) != 0) return false;
  png_set_expand(r.png);  // palettes, fewer bits than 8, a transparent colour
  png_set_strip_16(r.png);
  png_set_interlace_handling(r.png);
  png_read_update_info(r.png, r.info);
  return true;
}

bool ReadRows(PngReader& r, png_bytepp rows) {
  if (setjmp(png_jmpbuf(r.png)) != 0) return false;
  png_read_image(r.png, rows);
  png_read_end(r.png, nullptr);
  return true;
}

void Require(bool good, const std::string& path, const PngReader& r) {
  if (good) return;
  throw InputError(path + (r.truncated ? ": the image file is truncated"
                                       : ": the image file is damaged: " + r.reason));
}

}  // namespace

Image DecodePng(const std::string& path, const std::string& content) {
  PngReader reader(content);
  Require(reader.info != nullptr, path, reader);
  Require(ReadHeader(reader), path, reader);
  Image image;
  image.width = static_cast<int>(png_get_image_width(reader.png, reader.info));
  image.height = static_cast<int>(png_get_image_height(reader.png, reader.info));
  const int bits = png_get_bit_depth(reader.png, reader.info) *
                   png_get_channels(reader.png, reader.info);
  constexpr double kMaxExpansion = 1032;  // bytes from one, by deflate
  CheckImageFits(path, image.width, image.height, 8 * kMaxExpansion / bits,
                 content.size());
  Require(SetOutput(reader), path, reader);
  image.channels = png_get_channels(reader.png, reader.info);
  image.names = ChannelNames(image.channels);
  image.bytes.resize(image.Offset(0, image.height, 0));
  std::vector<png_bytep> rows;
  for (int y = 0; y < image.height; ++y) {
    rows.push_back(image.bytes.data() + image.Offset(0, y, 0));
  }
  Require(ReadRows(reader, rows.data()), path, reader);
  return image;
}

}  // namespace lanelight

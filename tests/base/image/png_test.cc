// PNG files of every kind, built by hand; damage and sizes.
#include <catch2/catch.hpp>
#include <zlib.h>

#include "tests/base/image/image_files.h"

namespace lanelight {
namespace {

std::string Chunk(const std::string& type, const std::string& data) {
  const std::string summed = type + data;
  const uLong sum = crc32(0, reinterpret_cast<const Bytef*>(summed.data()),
                          static_cast<uInt>(summed.size()));
  return BigEndian(static_cast<std::uint32_t>(data.size()), 4) + summed +
         BigEndian(static_cast<std::uint32_t>(sum), 4);
}

std::string Deflated(const std::string& raw) {
  std::string out(compressBound(raw.size()), '\0');
  uLongf size = out.size();
  compress(reinterpret_cast<Bytef*>(out.data()), &size,
           reinterpret_cast<const Bytef*>(raw.data()), raw.size());
  out.resize(size);
  return out;
}

struct PngFile {
  std::uint32_t width = 1, height = 1;
  int depth = 8, color = 0, interlace = 0;
  std::string before;  // chunks before the pixels
  std::string rows;    // each begins with its filter

  std::string Text() const {
    std::string header = BigEndian(width, 4) + BigEndian(height, 4);
    for (int value : {depth, color, 0, 0, interlace}) header += static_cast<char>(value);
    return "\x89PNG\r\n\x1a\n" + Chunk("IHDR", header) + before +
           Chunk("IDAT", Deflated(rows)) + Chunk("IEND", "");
  }
};

Bytes PngSamples(const PngFile& file) {
  const Image image = ReadAs("a.png", file.Text());
  CHECK(image.width == static_cast<int>(file.width));
  CHECK(image.height == static_cast<int>(file.height));
  return Bytes(image.bytes.begin(), image.bytes.end());
}

constexpr int kPngGrey = 0, kPngColor = 2, kPngPalette = 3, kPngGreyAlpha = 4,
              kPngColorAlpha = 6;

TEST_CASE("PNG: grey of any depth is scaled to bytes", "[image]") {
  CHECK(PngSamples({4, 1, 1, kPngGrey, 0, "", Raw({0, 0xa0})}) == Bytes{255, 0, 255, 0});
  CHECK(PngSamples({4, 1, 2, kPngGrey, 0, "", Raw({0, 0x1b})}) == Bytes{0, 85, 170, 255});
  CHECK(PngSamples({2, 1, 4, kPngGrey, 0, "", Raw({0, 0x1f})}) == Bytes{17, 255});
  CHECK(PngSamples({2, 1, 8, kPngGrey, 0, "", Raw({0, 7, 200})}) == Bytes{7, 200});
  // The upper eight of 16 bits.
  CHECK(PngSamples({2, 1, 16, kPngGrey, 0, "", Raw({0, 7, 255, 200, 0})}) ==
        Bytes{7, 200});
}

TEST_CASE("PNG: colours, alpha and filters", "[image]") {
  CHECK(PngSamples({2, 2, 8, kPngColor, 0, "",
                    Raw({1, 1, 2, 3, 10, 20, 30,       // from the left
                         2, 1, 1, 1, 255, 0, 0})}) ==  // from above
        Bytes{1, 2, 3, 11, 22, 33, 2, 3, 4, 10, 22, 33});
  const PngFile deep = {
      1, 1, 16, kPngColorAlpha, 0, "", Raw({0, 1, 9, 2, 9, 3, 9, 4, 9})};
  CHECK(PngSamples(deep) == Bytes{1, 2, 3, 4});
  CHECK(ReadAs("a.png", deep.Text()).names ==
        std::vector<std::string>{"R", "G", "B", "A"});
  const PngFile grey = {1, 1, 8, kPngGreyAlpha, 0, "", Raw({0, 5, 6})};
  CHECK(PngSamples(grey) == Bytes{5, 6});
  CHECK(ReadAs("a.png", grey.Text()).names == std::vector<std::string>{"Y", "A"});
}

TEST_CASE("PNG: palettes and transparent colours", "[image]") {
  const std::string palette = Chunk("PLTE", Raw({1, 2, 3, 4, 5, 6, 7, 8, 9}));
  CHECK(PngSamples({2, 1, 8, kPngPalette, 0, palette, Raw({0, 2, 0})}) ==
        Bytes{7, 8, 9, 1, 2, 3});
  CHECK(PngSamples({3, 1, 2, kPngPalette, 0, palette + Chunk("tRNS", Raw({40, 50})),
                    Raw({0, 0x18})}) == Bytes{1, 2, 3, 40, 4, 5, 6, 50, 7, 8, 9, 255});
  CHECK(PngSamples({2, 1, 8, kPngColor, 0, Chunk("tRNS", Raw({0, 1, 0, 2, 0, 3})),
                    Raw({0, 1, 2, 3, 1, 2, 4})}) == Bytes{1, 2, 3, 0, 1, 2, 4, 255});
  CHECK(PngSamples({2, 1, 4, kPngGrey, 0, Chunk("tRNS", Raw({0, 1})), Raw({0, 0x12})}) ==
        Bytes{17, 0, 34, 255});
  // All 16 bits are compared.
  CHECK(PngSamples({2, 1, 16, kPngGrey, 0, Chunk("tRNS", Raw({3, 1})),
                    Raw({0, 3, 1, 3, 2})}) == Bytes{3, 0, 3, 255});
}

TEST_CASE("PNG: interlaced rows and ignored chunks", "[image]") {
  // 3 x 3: passes 1, 4, 5, 6 and 7 have pixels.
  const std::string rows = Raw({0, 1, 0, 3, 0, 7, 9, 0, 2, 0, 8, 0, 4, 5, 6});
  CHECK(PngSamples({3, 3, 8, kPngGrey, 1, "", rows}) == Bytes{1, 2, 3, 4, 5, 6, 7, 8, 9});
  const std::string ignored = Chunk("gAMA", BigEndian(100000, 4)) +
                              Chunk("sBIT", Raw({3})) + Chunk("tEXt", Raw({65, 0, 65})) +
                              Chunk("zTXt", Raw({65, 0, 0, 1, 2, 3})) +
                              Chunk("prVt", "anything");
  CHECK(PngSamples({2, 1, 8, kPngGrey, 0, ignored, Raw({0, 100, 200})}) ==
        Bytes{100, 200});
}

TEST_CASE("PNG: every flipped bit and every truncation is an error", "[image]") {
  const std::string whole =
      PngFile{9,
              3,
              8,
              kPngGrey,
              0,
              Chunk("tEXt", Raw({65, 0, 65})),
              Raw({0, 1, 2, 3, 4, 5, 6, 7, 8, 9}) + Raw({2, 1, 2, 3, 4, 5, 6, 7, 8, 9}) +
                  Raw({1, 1, 2, 3, 4, 5, 6, 7, 8, 9})}
          .Text();
  REQUIRE(ImageError("a.png", whole) == "");
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    std::string damaged = whole;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ 1 << bit % 8);
    INFO(bit);
    CHECK(ImageError("a.png", damaged) != "");
  }
  for (std::size_t size = 0; size < whole.size(); ++size) {
    INFO(size);
    CHECK(ImageError("a.png", whole.substr(0, size)) != "");
  }
  CHECK_THAT(ImageError("a.png", whole.substr(0, whole.size() - 20)),
             Catch::Contains("truncated"));
}

TEST_CASE("PNG: sizes are checked against limits and the file's length", "[image]") {
  PngFile file = {20000, 10000, 8, kPngColor, 0, "", Raw({0, 1, 2, 3})};
  CHECK_THAT(ImageError("a.png", file.Text()),
             Catch::Contains("cannot hold 20000 x 10000 pixels"));
  file.width = 100000;
  CHECK(ImageError("a.png", file.Text()) != "");
  file.width = file.height = 65536;
  file.depth = 1, file.color = kPngGrey;
  CHECK_THAT(ImageError("a.png", file.Text()), Catch::Contains("65536 x 65536"));
  // Rows that are missing, though the stream is whole.
  CHECK(ImageError("a.png",
                   PngFile{9, 9, 8, kPngGrey, 0, "", std::string(20, '\0')}.Text()) !=
        "");
}

}  // namespace
}  // namespace lanelight

// GIF, PSD, PGM, PPM and BMP: values, cuts, sizes that the file cannot hold.
#include <catch2/catch.hpp>

#include "tests/base/image/image_files.h"

namespace lanelight {
namespace {

// `count` bytes of a number, the lowest first.
std::string Little(int value, int count) {
  std::string out;
  for (int i = 0; i < count; ++i) out += static_cast<char>(value >> 8 * i);
  return out;
}

std::string Big(int value, int count) {
  return BigEndian(static_cast<std::uint32_t>(value), count);
}

// A GIF of four colours. Each pixel is a code of 3 bits after one that resets the table.
std::string Gif(int width, int height, const Bytes& indices) {
  std::string file = "GIF89a" + Little(width, 2) + Little(height, 2) + Raw({0xf1, 0, 0});
  file += Raw({1, 2, 3, 40, 50, 60, 7, 8, 9, 255, 0, 0});
  file += "," + Little(0, 4) + Little(width, 2) + Little(height, 2) + Raw({0, 2});
  constexpr int kReset = 4, kEnd = 5;
  std::string bits;  // the first one first
  const auto add = [&](int code) {
    for (int i = 0; i < 3; ++i) bits += static_cast<char>('0' + (code >> i & 1));
  };
  for (int index : indices) add(kReset), add(index);
  add(kEnd);
  std::string data((bits.size() + 7) / 8, '\0');
  for (std::size_t i = 0; i < bits.size(); ++i) {
    data[i / 8] = static_cast<char>(data[i / 8] | (bits[i] - '0') << i % 8);
  }
  return file + static_cast<char>(data.size()) + data + Raw({0, ';'});
}

std::string Psd(int width, int height, int compression, const std::string& data) {
  return "8BPS" + Big(1, 2) + std::string(6, '\0') + Big(3, 2) + Big(height, 4) +
         Big(width, 4) + Big(8, 2) + Big(3, 2) + std::string(12, '\0') +
         Big(compression, 2) + data;
}

std::string Bmp(int width, int height, const std::string& data) {
  return "BM" + Little(54 + static_cast<int>(data.size()), 4) + Little(0, 4) +
         Little(54, 4) + Little(40, 4) + Little(width, 4) + Little(height, 4) +
         Little(1, 2) + Little(24, 2) + std::string(24, '\0') + data;
}

Bytes Samples(const std::string& name, const std::string& text) {
  const Image image = ReadAs(name, text);
  REQUIRE(image.width == 2);
  REQUIRE(image.height == 1);
  return Bytes(image.bytes.begin(), image.bytes.end());
}

void CheckCuts(const std::string& name, const std::string& text, std::size_t tail = 0) {
  for (std::size_t size = 0; size + tail < text.size(); ++size) {
    INFO(name << ": " << size << " of " << text.size() << " bytes");
    CHECK(ImageError(name, text.substr(0, size)) != "");
  }
}

TEST_CASE("GIF is decoded", "[image]") {
  const std::string file = Gif(2, 1, {1, 3});
  CHECK(Samples("a.gif", file) == Bytes{40, 50, 60, 255, 255, 0, 0, 255});
  CheckCuts("a.gif", file, 4);  // the last code, block and frame carry no pixels
  // The first of several frames counts.
  const std::string two =
      file.substr(0, file.size() - 1) + Gif(2, 1, {0, 0}).substr(13 + 12);
  CHECK(Samples("a.gif", two)[0] == 40);
}

TEST_CASE("PSD is decoded, plain or in runs", "[image]") {
  const std::string plain = Psd(2, 1, 0, Raw({1, 2, 30, 40, 50, 60}));
  CHECK(Samples("a.psd", plain) == Bytes{1, 30, 50, 255, 2, 40, 60, 255});
  CheckCuts("a.psd", plain);
  const std::string runs =
      Psd(2, 1, 1, Raw({0, 2, 0, 3, 0, 2, 255, 9, 1, 30, 40, 255, 50}));
  CHECK(Samples("b.psd", runs) == Bytes{9, 30, 50, 255, 9, 40, 50, 255});
  CheckCuts("b.psd", runs);
}

TEST_CASE("PGM and PPM are decoded", "[image]") {
  const std::string grey = "P5\n# made by hand\n2 1\n255\n" + Raw({7, 200});
  CHECK(Samples("a.pgm", grey) == Bytes{7, 200});
  CHECK(ReadAs("a.pgm", grey).names == std::vector<std::string>{"Y"});
  CheckCuts("a.pgm", grey);
  const std::string color = "P6 2 1 255\n" + Raw({1, 2, 3, 4, 5, 6});
  CHECK(Samples("a.ppm", color) == Bytes{1, 2, 3, 4, 5, 6});
  CheckCuts("a.ppm", color);
  CHECK_THAT(ImageError("a.pgm", "P5\n2 1\n65535\n" + Raw({1, 2, 3, 4})),
             Catch::Contains("16 bits"));
}

TEST_CASE("BMP is decoded", "[image]") {
  const std::string file = Bmp(2, 1, Raw({3, 2, 1, 6, 5, 4, 0, 0}));
  CHECK(Samples("a.bmp", file) == Bytes{1, 2, 3, 4, 5, 6});
  CheckCuts("a.bmp", file);
  const std::string rows = Raw({3, 2, 1, 0, 6, 5, 4, 0});
  CHECK(ReadAs("a.bmp", Bmp(1, 2, rows)).bytes[0] == 4);   // from the bottom
  CHECK(ReadAs("a.bmp", Bmp(1, -2, rows)).bytes[0] == 1);  // from the top
}

TEST_CASE("JPEG: a Huffman table that is too long is refused", "[image]") {
  const std::string start =
      Raw({255, 0xd8, 255, 0xc0, 0, 11, 8, 0, 8, 0, 8, 1, 1, 0x11, 0});
  for (int codes : {16, 17}) {
    const std::string table = Raw({0}) + std::string(16, static_cast<char>(codes));
    // Fill bytes, and a comment that looks like a table, stand before it.
    const std::string file = start + Raw({255, 0xfe, 0, 6, 255, 0xc4, 255, 255}) +
                             Raw({255, 255, 0xc4}) + Big(19 + 16 * codes, 2) + table +
                             std::string(16 * static_cast<std::size_t>(codes), 'x');
    const std::string error = ImageError("a.jpg", file);
    INFO(error);
    CHECK(error != "");
    CHECK((error.find("256 codes") != error.npos) == (codes == 17));
  }
}

TEST_CASE("image formats are detected by content, not by name", "[image]") {
  CHECK(Samples("a.png", Gif(2, 1, {1, 3}))[0] == 40);
  CHECK(Samples("noextension", "P5 2 1 255\n" + Raw({7, 200})) == Bytes{7, 200});
  CHECK_THAT(ImageError("a.xyz", std::string(500, 'q')),
             Catch::Contains("a.xyz: not an image") && Catch::Contains("qoi"));
}

TEST_CASE("sizes larger than the file are refused early", "[image]") {
  CHECK_THAT(ImageError("a.gif", Gif(9000, 9000, {1})), Catch::Contains("cannot hold"));
  for (int compression : {0, 1}) {
    CHECK_THAT(ImageError("a.psd", Psd(9000, 9000, compression, "x")),
               Catch::Contains("cannot hold"));
  }
  CHECK_THAT(ImageError("a.ppm", "P6 9000 9000 255\nx"), Catch::Contains("cannot hold"));
  CHECK_THAT(ImageError("a.bmp", Bmp(9000, 9000, "x")), Catch::Contains("cannot hold"));
  CHECK_THAT(ImageError("a.bmp", Bmp(9000, -9000, "x")), Catch::Contains("cannot hold"));
  const std::string tga = Raw({0, 0, 10}) + std::string(9, '\0') + Little(9000, 2) +
                          Little(9000, 2) + Raw({24, 0}) + "x";
  CHECK_THAT(ImageError("a.tga", tga), Catch::Contains("cannot hold"));
  CHECK_THAT(ImageError("a.hdr",
                        "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n"
                        "-Y 9000 +X 9000\nx"),
             Catch::Contains("cannot hold"));
  const std::string jpeg = Raw({255, 0xd8, 255, 0xc0, 0, 11, 8}) + Big(9000, 2) +
                           Big(9000, 2) + Raw({1, 1, 0x11, 0});
  CHECK_THAT(ImageError("a.jpg", jpeg), Catch::Contains("cannot hold"));
  std::string scans = Raw({255, 0xd8, 255, 0xc2, 0, 11, 8}) + Big(900, 2) + Big(900, 2) +
                      Raw({1, 1, 0x11, 0});
  for (int i = 0; i < 1000; ++i) scans += Raw({255, 0xda, 0, 8, 1, 1, 0, 0, 63, 0});
  CHECK_THAT(ImageError("a.jpg", scans), Catch::Contains("more than 500 scans"));
}

}  // namespace
}  // namespace lanelight

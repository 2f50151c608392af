// Readers of PFM, PNG, TGA, HDR: values, orientation, truncation, absurd sizes.
#include "src/base/image/image.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "src/base/core/error.h"
#include "src/base/image/atomic_file.h"
#include "src/base/image/decode.h"
#include "tests/base/image/temporary_folder.h"

namespace lanelight {
namespace {

// 3 x 2, top row 10 11 12, bottom row 20 21 22 (plus 100 per channel, modulo 256).
std::vector<std::uint8_t> SmallRgb() {
  std::vector<std::uint8_t> rgb;
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 3; ++x) {
      for (int c = 0; c < 3; ++c) {
        rgb.push_back(static_cast<std::uint8_t>(10 * (y + 1) + x + 80 * c));
      }
    }
  }
  return rgb;
}

std::string TgaHeader(int type, int width, int height, int bits, bool from_top) {
  std::string header(18, '\0');
  header[2] = static_cast<char>(type);
  header[12] = static_cast<char>(width & 255), header[13] = static_cast<char>(width >> 8);
  header[14] = static_cast<char>(height & 255),
  header[15] = static_cast<char>(height >> 8);
  header[16] = static_cast<char>(bits);
  header[17] = static_cast<char>(from_top ? 0x20 : 0);
  return header;
}

// Blue, green, red per pixel.
std::string TgaPixels(bool from_top) {
  const auto rgb = SmallRgb();
  std::string out;
  for (int row = 0; row < 2; ++row) {
    const int y = from_top ? row : 1 - row;
    for (int x = 0; x < 3; ++x) {
      for (int c = 2; c >= 0; --c) out += static_cast<char>(rgb[(y * 3 + x) * 3 + c]);
    }
  }
  return out;
}

// A 16 x 16 grey JPEG, quality 50: the upper half is 40, the lower 200.
constexpr const char* kJpegHex =
    "ffd8ffe000104a46494600010100000100010000ffdb008400100b0c0e0c0a100e0d0e1211101318"
    "281a181616183123251d283a333d3c3933383740485c4e404457453738506d51575f626768673e4d"
    "71797064785c656763011112121815182f1a1a2f6342384263636363636363636363636363636363"
    "63636363636363636363636363636363636363636363636363636363636363636363ffc000110800"
    "10001003012200021101031101ffc401a20000010501010101010100000000000000000102030405"
    "060708090a0b100002010303020403050504040000017d0102030004110512213141061351610722"
    "7114328191a1082342b1c11552d1f02433627282090a161718191a25262728292a3435363738393a"
    "434445464748494a535455565758595a636465666768696a737475767778797a838485868788898a"
    "92939495969798999aa2a3a4a5a6a7a8a9aab2b3b4b5b6b7b8b9bac2c3c4c5c6c7c8c9cad2d3d4d5"
    "d6d7d8d9dae1e2e3e4e5e6e7e8e9eaf1f2f3f4f5f6f7f8f9fa010003010101010101010101000000"
    "0000000102030405060708090a0b1100020102040403040705040400010277000102031104052131"
    "061241510761711322328108144291a1b1c109233352f0156272d10a162434e125f11718191a2627"
    "28292a35363738393a434445464748494a535455565758595a636465666768696a73747576777879"
    "7a82838485868788898a92939495969798999aa2a3a4a5a6a7a8a9aab2b3b4b5b6b7b8b9bac2c3c4"
    "c5c6c7c8c9cad2d3d4d5d6d7d8d9dae2e3e4e5e6e7e8e9eaf2f3f4f5f6f7f8f9faffda000c030100"
    "02110311003f00e4e8af50a2803fffd9";

std::string FromHex(const std::string& hex) {
  std::string bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2) {
    bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  }
  return bytes;
}

void CheckTruncations(const TemporaryFolder& folder, const std::string& extension,
                      const std::string& whole, std::size_t tail) {
  for (std::size_t keep = 0; keep + tail < whole.size(); ++keep) {
    INFO(extension << ": " << keep << " of " << whole.size() << " bytes");
    const std::string name = "cut." + extension;
    const std::string path = folder.Write(name, whole.substr(0, keep));
    CHECK_THROWS_WITH(ReadImage(path), Catch::Contains(name));
  }
}

}  // namespace

TEST_CASE("PNG round-trips bytes", "[image]") {
  const TemporaryFolder folder;
  const std::string file = EncodePng(3, 2, SmallRgb());
  const Image image = ReadImage(folder.Write("a.png", file));
  CHECK(image.width == 3);
  CHECK(image.height == 2);
  CHECK(image.names == std::vector<std::string>{"R", "G", "B"});
  CHECK(std::vector<std::uint8_t>(image.bytes.begin(), image.bytes.end()) == SmallRgb());
  CheckTruncations(folder, "png", file, 16);  // the last chunk carries no pixels
}

TEST_CASE("TGA is read in either direction, plain or run-length coded", "[image]") {
  const TemporaryFolder folder;
  const bool from_top = GENERATE(false, true);
  const std::string plain = TgaHeader(2, 3, 2, 24, from_top) + TgaPixels(from_top);
  const Image image = ReadImage(folder.Write("a.tga", plain));
  CHECK(std::vector<std::uint8_t>(image.bytes.begin(), image.bytes.end()) == SmallRgb());
  CheckTruncations(folder, "tga", plain, 0);

  std::string coded = TgaHeader(10, 3, 2, 24, from_top);
  coded += static_cast<char>(5);  // one packet of six literal pixels
  coded += TgaPixels(from_top);
  const Image decoded = ReadImage(folder.Write("b.TGA", coded));
  CHECK(std::vector<std::uint8_t>(decoded.bytes.begin(), decoded.bytes.end()) ==
        SmallRgb());
  CheckTruncations(folder, "tga", coded, 0);

  std::string run = TgaHeader(10, 200, 1, 24, from_top);
  run += static_cast<char>(0x80 | 127), run += "abc";
  run += static_cast<char>(0x80 | 71), run += "xyz";
  const Image runs = ReadImage(folder.Write("c.tga", run));
  CHECK(runs.bytes[runs.Offset(127, 0, 0)] == 'c');
  CHECK(runs.bytes[runs.Offset(128, 0, 0)] == 'z');
}

TEST_CASE("a truncated TGA is detected at any length", "[image]") {
  const TemporaryFolder folder;
  const std::string whole =
      TgaHeader(2, 64, 33, 32, true) + std::string(64 * 33 * 4, 'p');
  CHECK(ReadImage(folder.Write("whole.tga", whole)).bytes.size() == 64 * 33 * 4);
  for (std::size_t keep = 18; keep < whole.size(); keep += 13) {
    INFO(keep);
    CHECK_THROWS_WITH(ReadImage(folder.Write("cut.tga", whole.substr(0, keep))),
                      Catch::Contains("truncated"));
  }
}

TEST_CASE("JPEG is decoded, and a truncated JPEG is refused", "[image]") {
  const TemporaryFolder folder;
  const std::string whole = FromHex(kJpegHex);
  const Image image = ReadImage(folder.Write("a.jpeg", whole));
  REQUIRE(image.width == 16);
  REQUIRE(image.height == 16);
  CHECK(std::abs(image.bytes[image.Offset(8, 2, 0)] - 40) <= 3);
  CHECK(std::abs(image.bytes[image.Offset(8, 13, 0)] - 200) <= 3);
  CheckTruncations(folder, "jpg", whole, 0);
}

TEST_CASE("PFM: both byte orders, scale, grey, orientation", "[image]") {
  const TemporaryFolder folder;
  Image image = MakeImage(3, 2, {"R", "G", "B"});
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = 0.5f * i - 1;
  const std::string path = folder.File("a.pfm");
  WritePfm(path, image);
  CHECK(ReadImage(path).pixels == image.pixels);

  // The first row of the file is the bottom one.
  const std::string little("Pf\n1 2\n-2\n\0\0\x80\x3f\0\0\0\x40", 18);  // 1, 2
  const Image grey = ReadImage(folder.Write("grey.pfm", little));
  CHECK(grey.names == std::vector<std::string>{"Y"});
  CHECK(grey.At(0, 0, 0) == 4);
  CHECK(grey.At(0, 1, 0) == 2);
  const std::string big("Pf\n1 2\n1\n\x3f\x80\0\0\x40\0\0\0", 17);
  CHECK(ReadImage(folder.Write("big.pfm", big)).At(0, 0, 0) == 2);

  CheckTruncations(folder, "pfm", little, 0);
  for (const char* bad :
       {"P6\n1 1\n1\n....", "PF\nx 1\n1\n", "PF\n1 -1\n1\n", "PF\n1 1\n0\n....",
        "PF\n999999999 9\n1\n", "PF\n60000 60000\n1\n", "PF\n1 1\nnan\n", "PF 1"}) {
    INFO(bad);
    CHECK_THROWS_WITH(ReadImage(folder.Write("bad.pfm", bad)),
                      Catch::Contains("bad.pfm"));
  }
}

TEST_CASE("HDR shared exponents are decoded", "[image]") {
  const TemporaryFolder folder;
  std::string file = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
  file += std::string("\x80\x40\x20\x81", 4);  // mantissas 128 64 32, exponent 129 - 136
  file += std::string("\x00\x00\x00\x00", 4);
  const Image image = ReadImage(folder.Write("a.hdr", file));
  CHECK(image.width == 2);
  CHECK(image.At(0, 0, 0) == Approx(1.0f));
  CHECK(image.At(0, 0, 1) == Approx(0.5f));
  CHECK(image.At(0, 0, 2) == Approx(0.25f));
  CHECK(image.At(1, 0, 0) == 0);
  CheckTruncations(folder, "hdr", file, 0);
}

TEST_CASE("absurd sizes and unknown formats are refused", "[image]") {
  const TemporaryFolder folder;
  const std::string huge = TgaHeader(2, 65535, 65535, 24, true) + "x";
  CHECK_THROWS_WITH(ReadImage(folder.Write("huge.tga", huge)),
                    Catch::Contains("65535 x 65535"));
  CHECK_THROWS_WITH(ReadImage(folder.File("absent.png")),
                    Catch::Contains("No such file"));
  CHECK_THROWS_WITH(ReadImage(folder.Write("noise.jpg", std::string(500, 'q'))),
                    Catch::Contains("noise.jpg"));
  CHECK_THROWS_AS(CheckImageSize("a", 0, 4), InputError);
}

TEST_CASE("tone mapping: exposure, clamp, sRGB, NaN", "[image]") {
  CHECK(TonemapToByte(0, 0) == 0);
  CHECK(TonemapToByte(1, 0) == 255);
  CHECK(TonemapToByte(7, 0) == 255);
  CHECK(TonemapToByte(-1, 0) == 0);
  CHECK(TonemapToByte(SrgbToLinear(128 / 255.0), 0) == 128);
  CHECK(TonemapToByte(0.25, 2) == 255);
  CHECK(TonemapToByte(4, -2) == 255);
  CHECK(TonemapToByte(std::numeric_limits<double>::infinity(), 0) == 255);

  const TemporaryFolder folder;
  Image image = MakeImage(2, 1, {"R", "G", "B", "variance.R"});
  image.At(0, 0, 0) = 1, image.At(1, 0, 1) = std::nanf("");
  WritePng(folder.File("a.png"), image);
  const Image back = ReadImage(folder.File("a.png"));
  CHECK(std::vector<int>(back.bytes.begin(), back.bytes.end()) ==
        std::vector<int>{255, 0, 0, 255, 0, 255});
  CHECK_THROWS_WITH(WritePng(folder.File("b.png"), MakeImage(1, 1, {"depth"})),
                    Catch::Contains("b.png"));
}

TEST_CASE("the sRGB curve and its inverse agree", "[image]") {
  for (int i = 0; i <= 1000; ++i) {
    CHECK(LinearToSrgb(SrgbToLinear(i / 1000.0)) == Approx(i / 1000.0).margin(2e-6));
  }
  CHECK(SrgbToLinear(0.5) == Approx(0.21404114));
}

}  // namespace lanelight

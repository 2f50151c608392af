// QOI images: every chunk, damage and sizes.
#include <catch2/catch.hpp>
#include <qoi.h>

#include <cstdlib>
#include <memory>
#include <random>

#include "tests/base/image/image_files.h"

namespace lanelight {
namespace {

std::string QoiHeader(int width, int height, int channels, int colorspace) {
  return "qoif" + BigEndian(static_cast<std::uint32_t>(width), 4) +
         BigEndian(static_cast<std::uint32_t>(height), 4) + static_cast<char>(channels) +
         static_cast<char>(colorspace);
}

const std::string kQoiEnd = Raw({0, 0, 0, 0, 0, 0, 0, 1});

// 7 pixels by each kind of chunk.
const std::string kQoiChunks =
    Raw({0xfe, 100, 50, 200,        // R, G, B
         0x40 | 3 << 4 | 2 << 2,    // differences 1, 0, -2
         0x80 | 42, 0x08 << 4 | 9,  // green + 10, red + 10, ...
         0xc0 | 1,                  // twice more
         0xff, 1, 2, 3, 4,          // R, G, B, A
         (100 * 3 + 50 * 5 + 200 * 7 + 255 * 11) % 64});

TEST_CASE("QOI: every kind of chunk", "[image]") {
  const Image image = ReadAs("a.qoi", QoiHeader(7, 1, 4, 0) + kQoiChunks + kQoiEnd);
  CHECK(image.names == std::vector<std::string>{"R", "G", "B", "A"});
  CHECK(Bytes(image.bytes.begin(), image.bytes.end()) ==
        Bytes{100, 50,  200, 255, 101, 50,  198, 255, 111, 60, 209, 255, 111, 60,
              209, 255, 111, 60,  209, 255, 1,   2,   3,   4,  100, 50,  200, 255});
  const Image rgb = ReadAs("a.qoi", QoiHeader(7, 1, 3, 0) + kQoiChunks + kQoiEnd);
  CHECK(rgb.names == std::vector<std::string>{"R", "G", "B"});
  CHECK(rgb.bytes.size() == 21);
}

TEST_CASE("QOI: linear samples become floats", "[image]") {
  const Image image = ReadAs("a.qoi", QoiHeader(7, 1, 3, 1) + kQoiChunks + kQoiEnd);
  REQUIRE_FALSE(image.is_bytes());
  CHECK(image.At(0, 0, 0) == 100 / 255.f);
  CHECK(image.At(0, 0, 2) == 200 / 255.f);
}

TEST_CASE("QOI: files round-trip under any name", "[image]") {
  std::mt19937 random(1);
  for (const int channels : {3, 4}) {
    std::vector<std::uint8_t> pixels(40 * 30 * static_cast<std::size_t>(channels));
    std::uint8_t value = 0;
    for (std::uint8_t& sample : pixels) {
      if (random() % 4 == 0) value = static_cast<std::uint8_t>(value + random() % 40);
      sample = value;
    }
    const qoi_desc shape = {40, 30, static_cast<unsigned char>(channels), QOI_SRGB};
    int size = 0;
    const std::unique_ptr<void, decltype(&std::free)> file(
        qoi_encode(pixels.data(), &shape, &size), &std::free);
    REQUIRE(file);
    const std::string text(static_cast<const char*>(file.get()),
                           static_cast<std::size_t>(size));
    const Image image = ReadAs("a.texture", text);
    CHECK(
        std::equal(image.bytes.begin(), image.bytes.end(), pixels.begin(), pixels.end()));
    for (std::size_t cut = 0; cut < text.size(); cut += 1 + cut / 50) {
      INFO(cut);
      CHECK(ImageError("a.qoi", text.substr(0, text.size() - 1 - cut)) != "");
    }
  }
}

TEST_CASE("QOI: every truncation and every bad header is an error", "[image]") {
  const std::string whole = QoiHeader(7, 1, 4, 0) + kQoiChunks + kQoiEnd;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    INFO(size);
    CHECK(ImageError("a.qoi", whole.substr(0, size)) != "");
  }
  CHECK_THAT(ImageError("a.qoi", QoiHeader(8, 1, 4, 0) + kQoiChunks + kQoiEnd),
             Catch::Contains("truncated"));
  CHECK_THAT(ImageError("a.qoi", QoiHeader(7, 1, 5, 0) + kQoiChunks + kQoiEnd),
             Catch::Contains("damaged"));
  CHECK_THAT(ImageError("a.qoi", QoiHeader(7, 1, 4, 2) + kQoiChunks + kQoiEnd),
             Catch::Contains("damaged"));
  CHECK_THAT(ImageError("a.qoi", QoiHeader(0, 1, 4, 0) + kQoiChunks + kQoiEnd),
             Catch::Contains("0 x 1"));
  CHECK_THAT(ImageError("a.qoi", QoiHeader(9000, 9000, 4, 0) + kQoiChunks + kQoiEnd),
             Catch::Contains("cannot hold"));
  CHECK_THAT(ImageError("a.qoi", QoiHeader(-1, -1, 4, 0) + kQoiChunks + kQoiEnd),
             Catch::Contains("4294967295"));
}

}  // namespace
}  // namespace lanelight

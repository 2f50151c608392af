// Packets byte by byte, as the source of tev (Thomas Müller, 2025) reads them: lengths
// count themselves, truths are 0 or 1, and data is as long as the furthest value that
// offsets and strides name.
#include "src/render/job/display.h"

#include <catch2/catch.hpp>
#include <vector>

namespace lanelight {
namespace {

// Hexadecimal bytes, with spaces anywhere; what is in quotes is text.
std::string BytesOf(const std::string& text) {
  std::string bytes;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\'') {
      quoted = !quoted;
    } else if (quoted) {
      bytes += text[i];
    } else if (text[i] != ' ') {
      bytes += static_cast<char>(std::stoi(text.substr(i++, 2), nullptr, 16));
    }
  }
  return bytes;
}

}  // namespace

TEST_CASE("an image is created with the bytes that tev expects", "[render]") {
  CHECK(CreateImagePacket("a.exr", 300, 2) ==
        BytesOf("1e000000 04 01 'a.exr' 00"  // length, type, brought to the front, name
                "2c010000 02000000"          // width, height
                "03000000 'R'00 'G'00 'B'00"));
}

TEST_CASE("pixels are updated with the bytes that tev expects", "[render]") {
  const std::vector<float> rgb = {1, -2, 0.5f, 0.25f, 0, 4};
  CHECK(UpdateImagePacket("a.exr", {1, 5, 3, 6}, rgb) ==
        BytesOf("6e000000 06 00 'a.exr' 00"   // length, type, left where it is, name
                "03000000 'R'00 'G'00 'B'00"  // channels
                "01000000 05000000 02000000 01000000"  // x, y, width, height
                "0000000000000000 0100000000000000 0200000000000000"  // offsets
                "0300000000000000 0300000000000000 0300000000000000"  // strides
                "0000803f 000000c0 0000003f 0000803e 00000000 00008040"));
}

}  // namespace lanelight

// libFuzzer target for the scene parser and the PLY reader. Seeds: tests/scene/broken and
// scenes. Needs clang and its sanitizer run-time libraries; from the root of the
// repository:
//
//   ./run build parse_fuzz
//   mkdir -p corpus && build/release/tests/parse_fuzz -max_total_time=60 corpus \
//     tests/scene/broken tests/scene/broken/parts scenes
#include "tests/fuzz/parse_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lanelight::FuzzParse({reinterpret_cast<const char*>(data), size});
  return 0;
}

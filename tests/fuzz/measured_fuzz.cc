// libFuzzer target for the reader of measured reflectance. Needs clang and its sanitizer
// run-time libraries; from the root of the repository:
//
//   ./run build measured_fuzz
//   mkdir -p corpus && build/release/tests/measured_fuzz -max_total_time=60 corpus
//
// An input is a list of changes of ten bytes to a small file: two say where, eight what;
// what is left over is how much of the file there is.
#include "tests/fuzz/measured_fuzz.h"

#include <cstdint>
#include <cstring>

#include "tests/reference/measured.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lanelight;
  static const std::string seed = [] {
    reference::MeasuredModel model = reference::MetalModel(0.3, 0.3);
    model.thetas = 2, model.size = 2, model.normals_size = 3;
    return reference::MeasuredFile(model);
  }();
  std::string file = seed;
  for (; size >= 10; data += 10, size -= 10) {
    const std::size_t at = (data[0] | data[1] << 8) % (file.size() - 8);
    std::memcpy(file.data() + at, data + 2, 8);
  }
  if (size >= 2) file.resize((data[0] | data[1] << 8) % (file.size() + 1));
  FuzzMeasuredFile(file);
  return 0;
}

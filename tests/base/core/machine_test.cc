// Code that depends on the processor stays in src/base/core/machine.*, and works.
#include "src/base/core/machine.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <limits>
#include <regex>
#include <set>
#include <sstream>
#include <string>

namespace lanelight {
namespace {

namespace fs = std::filesystem;

// Files that may contain such words. Highway's own names of targets are not among the
// words: kernels/targets.h lists them, and a kernel may depend on its target.
const std::set<std::string> kMachineFiles = {"src/base/core/machine.h",
                                             "src/base/core/machine.cc",
                                             "tests/base/core/machine_test.cc"};

/// The first word of `text` that only one kind of processor understands; "" if none.
std::string MachineWord(const std::string& text) {
  static const std::regex words(
      R"re(__x86_64__|__i386__|__amd64__|__aarch64__|__arm__|__ARM_\w+|__SSE\w*__)re"
      R"re(|__AVX\w*__|\b_mm\d*_\w+|\b_MM_\w+|\w*mmintrin|x86intrin|arm_neon|arm_sve)re"
      R"re(|cpuid|rdtscp?\b|\basm\b|__asm__|__builtin_ia32_\w+|\b[fm]pcr\b|mxcsr)re"
      R"re(|HWY_ARCH_\w+)re");
  std::smatch found;
  return std::regex_search(text, found, words) ? found.str() : "";
}

std::string TextOf(const fs::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("only one file contains processor-specific code", "[machine]") {
  const fs::path root = LANELIGHT_SOURCE_DIR;
  int files = 0;
  for (const char* top : {"src", "kernels", "bench", "tests"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      const std::string extension = entry.path().extension();
      if (extension != ".h" && extension != ".cc") continue;
      const std::string name = fs::relative(entry.path(), root).generic_string();
      if (kMachineFiles.count(name) > 0) continue;
      INFO(name);
      CHECK(MachineWord(TextOf(entry.path())) == "");
      ++files;
    }
  }
  CHECK(files > 600);
}

TEST_CASE("processor-specific code is detected", "[machine]") {
  CHECK(MachineWord("#if defined(__x86_64__)\n") == "__x86_64__");
  CHECK(MachineWord("x = _mm256_add_ps(x, y);") == "_mm256_add_ps");
  CHECK(MachineWord("#include <immintrin.h>") == "immintrin");
  CHECK(MachineWord("return __rdtsc();") == "rdtsc");
  CHECK(MachineWord("#if HWY_ARCH_X86") == "HWY_ARCH_X86");
  CHECK(MachineWord("#ifdef __ARM_NEON") == "__ARM_NEON");
  CHECK(MachineWord("#if HWY_TARGET <= HWY_AVX3") == "");
}

#if defined(__x86_64__) || defined(__aarch64__)
TEST_CASE("subnormal numbers are flushed only within the scope", "[machine]") {
  volatile float minimum = std::numeric_limits<float>::min();
  volatile float subnormal = minimum / 4, scale = 1024, half = 0.5f;
  REQUIRE(subnormal > 0);
  {
    const FlushToZero flush;
    const volatile float result = minimum * half, operand = subnormal * scale;
    CHECK(result == 0);
    CHECK(operand == 0);
  }
  const volatile float result = minimum * half, operand = subnormal * scale;
  CHECK(result > 0);
  CHECK(operand == 256 * minimum);
}
#endif

}  // namespace lanelight

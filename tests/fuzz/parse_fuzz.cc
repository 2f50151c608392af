// libFuzzer target for the scene parser and the PLY reader. Seeds: tests/broken and
// scenes. Needs clang; from the root of the repository:
//
//   clang++ -std=c++20 -O1 -g -fsanitize=fuzzer,address,undefined -I. \
//     tests/fuzz/parse_fuzz.cc src/scene/{suggest,lex,params,params_read}.cc \
//     src/scene/{parse,parse_files,parse_meshes,quad,ply,ply_header}.cc \
//     src/scene/directives*.cc src/scene/interpret_*.cc src/image/spectrum*.cc \
//     src/core/{parallel,transform}.cc -lfmt -ltbb -o parse_fuzz
//   mkdir -p corpus && ./parse_fuzz -max_total_time=60 corpus tests/broken \
//     tests/broken/parts scenes
#include "tests/fuzz/parse_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lanelight::FuzzParse({reinterpret_cast<const char*>(data), size});
  return 0;
}

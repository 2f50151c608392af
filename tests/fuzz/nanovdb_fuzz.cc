// libFuzzer target for the reader of NanoVDB files and for what uses their grids. Needs
// clang and its sanitizer run-time libraries; from the root of the repository:
//
//   ./run build nanovdb_fuzz
//   mkdir -p corpus && build/release/tests/nanovdb_fuzz -max_total_time=60 -max_len=121
//   corpus
#include "tests/fuzz/nanovdb_fuzz.h"

namespace lanelight {
namespace {

using test::SparseCodec;
using Changes = std::vector<NanoVdbChange>;

// In place: nothing of a grid's 300 kB is copied.
void FuzzGrid(NanoVdbSeed& seed, const Changes& changes, bool compile) {
  std::vector<std::pair<std::uint8_t*, std::uint64_t>> before;
  for (const NanoVdbChange& change : changes) {
    auto* place = seed.grid.data() + change.Place(seed.grid_words, seed.grid.size());
    before.emplace_back(place, 0);
    std::memcpy(&before.back().second, place, 8);
    change.Apply(place);
  }
  FuzzNanoVdbGrid(seed.grid, compile);
  for (; !before.empty(); before.pop_back()) {
    std::memcpy(before.back().first, &before.back().second, 8);
  }
}

// Of a file changes may make another length, too.
void FuzzFile(const NanoVdbSeed& seed, const Changes& changes, bool compile) {
  std::string file = seed.file;
  for (const NanoVdbChange& change : changes) {
    if (file.size() < 8) break;
    const std::size_t at = change.Place(seed.file_words, file.size());
    if (change.how % 4 < 3) {
      change.Apply(file.data() + at);
    } else if (change.how < 192) {
      file.insert(at, file.substr(at, change.value % 65));
    } else {
      file.resize(at);
    }
  }
  FuzzNanoVdbFile(std::move(file), compile);
}

}  // namespace
}  // namespace lanelight

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lanelight;
  static std::vector<NanoVdbSeed> grids = MakeNanoVdbSeeds(SparseCodec::kNone);
  static const std::vector<NanoVdbSeed> files[] = {MakeNanoVdbSeeds(SparseCodec::kNone),
                                                   MakeNanoVdbSeeds(SparseCodec::kZip),
                                                   MakeNanoVdbSeeds(SparseCodec::kBlosc)};
  if (size == 0) return 0;
  Changes changes;
  std::uint32_t sum = data[0];
  for (std::size_t at = 1; at + NanoVdbChange::kBytes <= size;
       at += NanoVdbChange::kBytes) {
    changes.emplace_back(data + at);
    sum =
        31 * sum + changes.back().how + static_cast<std::uint32_t>(changes.back().value);
  }
  // What takes long is left to a few inputs: compiling, and files with voxels.
  const bool compile = sum % 128 == 127;
  const unsigned kind = data[0] % 12;
  if (kind < 9) {
    FuzzGrid(grids[kind % grids.size()], changes, compile);
  } else {
    const auto& seeds = files[kind - 9];
    FuzzFile(data[0] < 240 ? seeds[kEmptySeed] : seeds[data[0] % seeds.size()], changes,
             compile);
  }
  return 0;
}

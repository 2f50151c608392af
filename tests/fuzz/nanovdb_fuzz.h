// Fuzz inputs for the reader of NanoVDB files. A grid with voxels takes 300 kB, nearly
// all of them zeros, so that an input is not a file itself: it is a list of changes to a
// valid one.
#pragma once

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "src/base/core/error.h"
#include "src/base/image/nanovdb_file.h"
#include "src/base/image/sparse_grid.h"
#include "src/scene/compile/media.h"
#include "tests/base/image/sparse_grid_file.h"
#include "tests/base/image/temporary_folder.h"

namespace lanelight {

/// Places of the words of 8 bytes that are not zero, or among the first.
inline std::vector<std::size_t> WordsOf(const void* bytes, std::size_t size) {
  constexpr std::size_t kHead = 1600;
  std::vector<std::size_t> words;
  for (std::size_t at = 0; at + 8 <= size; at += 8) {
    std::uint64_t word;
    std::memcpy(&word, static_cast<const char*>(bytes) + at, sizeof word);
    if (at < kHead || word != 0) words.push_back(at);
  }
  return words;
}

/// A valid file and its grid "density", before which another one stands.
struct NanoVdbSeed {
  std::string file;
  GridBytes grid;
  std::vector<std::size_t> file_words, grid_words;
};

inline NanoVdbSeed MakeNanoVdbSeed(const test::SparseFileGrid& grid,
                                   test::SparseCodec codec) {
  const TemporaryFolder folder;
  test::SparseFileGrid other;  // one without voxels
  other.name = "other";
  other.value = [](int, int, int) { return 0.0f; };
  test::WriteSparseFile(folder.File("a.nvdb"), {other, grid}, codec);
  std::ifstream file(folder.File("a.nvdb"), std::ios::binary);
  NanoVdbSeed seed;
  seed.grid = ReadStoredGrid(file, "density")->bytes;
  file.seekg(0);
  seed.file.assign(std::istreambuf_iterator<char>(file), {});
  seed.file_words = WordsOf(seed.file.data(), seed.file.size());
  seed.grid_words = WordsOf(seed.grid.data(), seed.grid.size());
  return seed;
}

/// Which of them has no voxels, and is short.
inline constexpr std::size_t kEmptySeed = 6;

/// Of every kind of values, with nodes of all levels and without. Not with checksums,
/// which would notice most changes before anything else does, but for the last one.
inline std::vector<NanoVdbSeed> MakeNanoVdbSeeds(test::SparseCodec codec) {
  using test::SparseType;
  test::SparseFileGrid grid;
  grid.low[0] = -2, grid.high[1] = 3;
  grid.value = [](int i, int j, int k) {
    return 2 + 0.25f * static_cast<float>(i * j + k);  // not below 0
  };
  grid.voxel_size = 0.5;
  grid.checksum = false;
  std::vector<NanoVdbSeed> seeds;
  for (const SparseType type : {SparseType::kFloat, SparseType::kFpN, SparseType::kFp4,
                                SparseType::kFp8, SparseType::kFp16}) {
    grid.type = type;
    seeds.push_back(MakeNanoVdbSeed(grid, codec));
  }
  grid.checksum = true;
  const NanoVdbSeed checked = MakeNanoVdbSeed(grid, codec);
  grid.type = SparseType::kFloat;
  grid.checksum = false;
  grid.tiles = true;
  grid.low[0] = 0, grid.high[0] = 15, grid.high[1] = 7;
  grid.value = [](int i, int, int) { return i < 8 ? 1.0f : 2.0f; };
  seeds.push_back(MakeNanoVdbSeed(grid, codec));
  grid.tiles = false;
  grid.value = [](int, int, int) { return 0.0f; };
  seeds.push_back(MakeNanoVdbSeed(grid, codec));
  seeds.push_back(checked);
  return seeds;
}

/// Twelve bytes of an input: how, where, and a value.
struct NanoVdbChange {
  static constexpr std::size_t kBytes = 12;
  unsigned how;
  std::size_t where;
  std::uint64_t value;

  explicit NanoVdbChange(const unsigned char* input)
      : how(input[0]), where(input[1] | input[2] << 8 | input[3] << 16) {
    std::memcpy(&value, input + 4, sizeof value);
  }
  /// Place of a word of 8 bytes: mostly one of `words`, or a few bytes further.
  std::size_t Place(const std::vector<std::size_t>& words, std::size_t size) const {
    const std::size_t n = where % words.size();
    return ((how & 4) != 0 ? where : words[n] + (how >> 3) % 8) % (size - 7);
  }
  void Apply(void* place) const {
    std::uint64_t word;
    std::memcpy(&word, place, sizeof word);
    word += value;
    if (how % 4 == 0) std::memcpy(place, &value, 4);
    if (how % 4 == 1) std::memcpy(place, &value, 8);
    if (how % 4 == 2) std::memcpy(place, &word, 8);
  }
};

/// What the renderer does with a grid that has been read: nothing of it may come out as
/// anything but numbers within the bounds that the grid states.
inline void UseNanoVdb(std::shared_ptr<const SparseGrid> grid, bool compile) {
  const auto demand = [](bool holds, const char* what) {
    if (!holds) throw std::logic_error(what);
  };
  const Vec3d low = grid->index_from_world().Point(grid->box_min());
  const Vec3d high = grid->index_from_world().Point(grid->box_max());
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  std::vector<float> ends = {-kInfinity, -4096.5f, 1.5f, 7.25f, 4095.5f, 9.99e8f, NAN};
  for (int a = 0; a < 3; ++a) {
    demand(std::abs(low[a]) <= 1e9 && std::abs(high[a]) <= 1e9, "the box");
    ends.push_back(static_cast<float>(low[a]));
    ends.push_back(static_cast<float>(high[a]));
  }
  const float slack = 1e-5f * std::max(-grid->smallest(), grid->largest());
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const float x = ends[i], y = ends[(i + 1) % ends.size()], z = ends[i / 2];
    float v = NAN;
    grid->Interpolate(&x, &y, &z, 1, &v);
    demand(v == 0 || (v >= grid->smallest() - slack && v <= grid->largest() + slack),
           "a value out of the grid's bounds");
  }
  const int box[2][3] = {{-2000000000, -9, 0}, {8, 4, 20}};
  demand(grid->LargestIn(box[0], box[1]) <= grid->largest(), "a bound out of the grid's");
  if (!compile || grid->smallest() < 0) return;
  Medium medium;
  medium.kind = MediumKind::kNanoVdb;
  medium.sparse_density = grid;
  medium.box_min = grid->box_min(), medium.box_max = grid->box_max();
  medium.sigma_s = {1, 1, 1};
  const MediumGrid compiled = CompileMediumGrid(medium, WorldFrame());
  for (const float v : compiled.majorants)
    demand(std::isfinite(v) && v >= 0, "majorants");
}

/// Reads the file's grid "density" and uses it. InputError that names the file is the
/// only exception that may arise; it is swallowed here, and everything else is left to
/// the caller. Returns true if the file was accepted.
inline bool FuzzNanoVdbFile(std::string bytes, bool compile) {
  std::istringstream file(std::move(bytes));
  try {
    const auto grid = ReadSparseGrid(file, "fuzz.nvdb", "density");
    if (grid == nullptr) return false;
    UseNanoVdb(grid, compile);
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find("\"fuzz.nvdb\"") != std::string_view::npos) {
      return false;
    }
    throw std::logic_error(std::string("does not name the file: ") + error.what());
  }
  return true;
}

/// The same for a grid as it lies in memory.
inline bool FuzzNanoVdbGrid(const GridBytes& bytes, bool compile) {
  try {
    UseNanoVdb(MakeSparseGrid(bytes), compile);
  } catch (const InputError&) {
    return false;
  }
  return true;
}

}  // namespace lanelight

// NanoVDB files that are damaged, or made to do damage: they load, or are an error that
// names the file and says where; nothing is followed out of them, and none takes more
// memory or time than its size explains.
#include <catch2/catch.hpp>

#include <sstream>

#include "tests/fuzz/nanovdb_fuzz.h"
#include "tests/support/input_error.h"

namespace lanelight::test {
namespace {

// Places in the file of MakeNanoVdbSeed that has no compression, after its header of 16
// bytes: what is said of each of two grids, with names of 6 and 8 bytes.
constexpr std::size_t kSecondMeta = 16 + 176 + 6;
constexpr std::size_t kSizeInMeta = 0, kNameSizeInMeta = 136;

std::size_t GridPlace(const NanoVdbSeed& seed) {
  return seed.file.size() - seed.grid.size();
}

template <typename T>
std::string WithWord(std::string file, std::size_t at, T value) {
  std::memcpy(file.data() + at, &value, sizeof value);
  return file;
}

std::string ErrorOfBytes(const std::string& bytes) {
  std::istringstream file(bytes);
  return InputErrorOf([&] { ReadSparseGrid(file, "x.nvdb", "density"); });
}

// All bits of the word of 4 bytes at `at`, then one of one of its bytes.
int CountLoads(const std::string& file, std::size_t at) {
  std::string changed = file;
  for (int i = 0; i < 4; ++i) changed[at + i] ^= static_cast<char>(0xff);
  int loads = FuzzNanoVdbFile(changed, false) ? 1 : 0;
  changed = file;
  changed[at + at / 4 % 4] ^= static_cast<char>(1 << at / 16 % 8);
  return loads + (FuzzNanoVdbFile(changed, false) ? 1 : 0);
}

}  // namespace

TEST_CASE("NanoVDB: a file with any word changed loads or is an error with its name",
          "[image][nanovdb]") {
  for (const SparseCodec codec :
       {SparseCodec::kNone, SparseCodec::kZip, SparseCodec::kBlosc}) {
    const auto seeds = MakeNanoVdbSeeds(codec);
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      // zlib's checksum finds a change before the type of values matters.
      if (codec == SparseCodec::kZip && i > 0 && i < 5) continue;
      const std::string& file = seeds[i].file;
      INFO("codec " << static_cast<int>(codec) << ", seed " << i);
      REQUIRE(FuzzNanoVdbFile(file, true) == (i != kEmptySeed));
      int changes = 0, loads = 0;
      // All others are zeros that no voxel has to do with, nearly all in unused entries.
      for (const std::size_t at : seeds[i].file_words) {
        loads += CountLoads(file, at) + CountLoads(file, at + 4), changes += 4;
      }
      CHECK(changes >= 300);
      CHECK(loads < changes);
      // Without checksums and compression most values may be any.
      if (codec == SparseCodec::kNone && i < kEmptySeed) CHECK(loads > changes / 20);
    }
  }
}

TEST_CASE("NanoVDB: a file truncated at any length is an error with its name",
          "[image][nanovdb]") {
  for (const SparseCodec codec :
       {SparseCodec::kNone, SparseCodec::kZip, SparseCodec::kBlosc}) {
    const std::string file = MakeNanoVdbSeeds(codec)[0].file;
    for (std::size_t size = 0; size < file.size(); size += size < 1000 ? 1 : 1009) {
      CHECK(!FuzzNanoVdbFile(file.substr(0, size), false));
    }
  }
}

TEST_CASE("NanoVDB: sizes beyond the file are refused before allocation",
          "[image][nanovdb]") {
  constexpr std::uint64_t kHuge = std::uint64_t{1} << 50;
  for (const SparseCodec codec :
       {SparseCodec::kNone, SparseCodec::kZip, SparseCodec::kBlosc}) {
    const NanoVdbSeed seed = MakeNanoVdbSeeds(codec)[0];
    const std::string grid =
        ErrorOfBytes(WithWord(seed.file, kSecondMeta + kSizeInMeta, kHuge));
    CHECK_THAT(grid, Catch::Contains("\"x.nvdb\": byte ") &&
                         Catch::Contains(std::to_string(kHuge) + " bytes"));
    const std::string name = ErrorOfBytes(
        WithWord(seed.file, kSecondMeta + kNameSizeInMeta, std::uint32_t{1} << 30));
    CHECK_THAT(name, Catch::Contains("\"x.nvdb\": byte 374: the name of a grid"));
  }
}

TEST_CASE("NanoVDB: errors name the damaged part of a grid", "[image][nanovdb]") {
  const auto seeds = MakeNanoVdbSeeds(SparseCodec::kNone);
  const std::size_t at = GridPlace(seeds[0]);
  constexpr std::size_t kTree = 672, kRoot = kTree + 64, kTile = kRoot + 64;
  const auto error = [&](std::size_t place, auto value) {
    return ErrorOfBytes(WithWord(seeds[0].file, at + place, value));
  };
  const std::string where = "grid \"density\" from byte " + std::to_string(at) +
                            " of NanoVDB file \"x.nvdb\" is damaged at its byte ";
  // The root; the first tile's child, out of the grid, in its head, and amiss by a byte.
  CHECK_THAT(error(kTree + 24, 1ull << 30), Catch::Contains(where + "696: points to"));
  CHECK_THAT(error(kTile + 8, 1ull << 30), Catch::Contains(where + "808: points to"));
  CHECK_THAT(error(kTile + 8, 0ull - kRoot), Catch::Contains(where + "808: points to"));
  CHECK_THAT(error(kTile + 8, 97ull), Catch::Contains(where + "808: points to"));
  CHECK_THAT(error(kTree + 32, 5), Catch::Contains(where + "704: 5 nodes of level 0"));
}

TEST_CASE("NanoVDB: boxes as large as index space", "[image][nanovdb]") {
  const NanoVdbSeed seed = MakeNanoVdbSeeds(SparseCodec::kNone)[0];
  const std::size_t grid = GridPlace(seed);
  constexpr std::size_t kIndexBox = 672 + 64, kWorldBox = 560;
  std::string file = seed.file;
  for (int a = 0; a < 3; ++a) {
    file = WithWord(file, grid + kIndexBox + 4 * a, std::numeric_limits<int>::min());
    file = WithWord(file, grid + kIndexBox + 12 + 4 * a, std::numeric_limits<int>::max());
  }
  std::istringstream stream(file);
  const auto found = ReadSparseGrid(stream, "x.nvdb", "density");
  CHECK(found->smallest() == 0);
  CHECK(found->largest() == 2 + 0.25f * (7 * 3 + 7));
  for (const double end : {-1e300, -1e10, 1e10, double{INFINITY}}) {
    const std::size_t corner = kWorldBox + (end > 0 ? 24 : 0);
    CHECK_THAT(ErrorOfBytes(WithWord(file, grid + corner, end)),
               Catch::Contains("bounding box up to voxel"));
  }
}

}  // namespace lanelight::test

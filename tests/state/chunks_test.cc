// Parts of the state file by themselves: tiles, shuffling, chunks, memory.
#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>

#include "src/core/parallel.h"
#include "src/state/chunk_codec.h"
#include "src/state/shuffle.h"
#include "src/state/tiles.h"
#include "tests/image/temporary_folder.h"
#include "tests/state/random_film.h"

namespace lanelight {
namespace {

using Catch::Contains;

std::vector<unsigned char> Noise(std::size_t n) {
  std::mt19937 random(7);
  std::vector<unsigned char> bytes(n);
  for (unsigned char& b : bytes) b = static_cast<unsigned char>(random());
  return bytes;
}

// Kilobytes of a line of /proc/self/status.
long Status(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind(key + ":", 0) == 0) return std::stol(line.substr(key.size() + 1));
  }
  return -1;
}

}  // namespace

TEST_CASE("shuffling is what HDF5 says it is", "[state]") {
  for (std::size_t size : {4u, 8u}) {
    for (std::size_t count : {0u, 1u, 7u, 511u, 512u, 513u, 5000u}) {
      const std::vector<unsigned char> values = Noise(size * count);
      std::vector<unsigned char> planes(values.size()), back(values.size());
      Shuffle(values.data(), size, count, planes.data());
      bool right = true;
      for (std::size_t i = 0; i < values.size(); ++i) {
        right &= planes[i % size * count + i / size] == values[i];
      }
      CHECK(right);
      Unshuffle(planes.data(), size, count, back.data());
      CHECK(back == values);
    }
  }
}

TEST_CASE("noise is stored, other planes shrink, and both come back", "[state]") {
  const std::vector<unsigned char> noise = Noise(8 * 32768);
  ChunkEncoder encoder;
  ChunkDecoder decoder;
  std::vector<unsigned char> chunk, back(noise.size());
  encoder.Encode(noise.data(), 8, 32768, chunk);
  CHECK(chunk.size() < noise.size() + 200);
  REQUIRE(decoder.Decode(chunk, 8, 32768, back.data()));
  CHECK(back == noise);

  // One plane of zeros, one of two values, six of noise.
  std::vector<unsigned char> mixed = noise;
  for (std::size_t i = 0; i < mixed.size(); i += 8) mixed[i] = 0, mixed[i + 3] %= 2;
  encoder.Encode(mixed.data(), 8, 32768, chunk);
  CHECK(chunk.size() < 6.3 * 32768);
  REQUIRE(decoder.Decode(chunk, 8, 32768, back.data()));
  CHECK(back == mixed);

  CHECK_FALSE(decoder.Decode(chunk, 8, 32767, back.data()));
  chunk.back() ^= 1;
  CHECK_FALSE(decoder.Decode(chunk, 8, 32768, back.data()));
  chunk.resize(chunk.size() / 2);
  CHECK_FALSE(decoder.Decode(chunk, 8, 32768, back.data()));
}

TEST_CASE("tiles that are wrong are found", "[state]") {
  const PixelRect film = {0, 0, 10, 10};
  CHECK(TileProblem({}, film).empty());
  CHECK(TileProblem({{0, 0, 5, 5}, {5, 0, 10, 5}, {0, 5, 10, 10}}, film).empty());
  CHECK_THAT(TileProblem({{3, 3, 3, 4}}, film), Contains("no pixels"));
  CHECK_THAT(TileProblem({{3, 3, 4, 11}}, film), Contains("[3, 4) x [3, 11)"));
  CHECK_THAT(TileProblem({{-1, 0, 4, 4}}, film), Contains("not inside"));

  // Against all pairs of pixels.
  std::mt19937 random(3);
  const auto upto = [&](int n) { return static_cast<int>(random() % unsigned(n)); };
  int overlaps = 0;
  for (int k = 0; k < 3000; ++k) {
    std::vector<PixelRect> tiles;
    std::vector<int> covered(100);
    for (int i = 0; i < 4; ++i) {
      const int x = upto(9), y = upto(9);
      tiles.push_back(
          {x, y, std::min(10, x + 1 + upto(4)), std::min(10, y + 1 + upto(4))});
      for (int v = tiles[i].y0; v < tiles[i].y1; ++v) {
        for (int u = tiles[i].x0; u < tiles[i].x1; ++u) ++covered[v * 10 + u];
      }
    }
    const bool overlap = *std::max_element(covered.begin(), covered.end()) > 1;
    overlaps += overlap;
    REQUIRE(TileProblem(tiles, film).empty() != overlap);
  }
  CHECK(overlaps > 500);
  CHECK(overlaps < 2900);
}

TEST_CASE("memory for reading does not grow with the state", "[state]") {
  const TemporaryFolder folder;
  std::vector<std::uint64_t> table(6u << 20), read(table.size());  // 48 MiB
  std::mt19937_64 random(1);
  for (std::uint64_t& n : table) n = random();
  StateContent content;
  content.tables = {MakeStateColumn<std::uint64_t>("table", "", table)};
  SerialiseState(content).Write(folder.File("state"));
  std::fill(read.begin(), read.end(), 1);
  std::ofstream("/proc/self/clear_refs") << "5";  // the peak begins here
  const long before = Status("VmHWM");
  const StateFile file(folder.File("state"));
  file.ReadTable(MakeStateColumn<std::uint64_t>("table", "", read));
  const long grown = Status("VmHWM") - before;
  CHECK(read == table);
  REQUIRE(before > 0);
  CHECK(grown < 4096 + 3072 * MaxThreads());
}

}  // namespace lanelight

// NanoVDB files: what is stored, quantised and compressed, and what cannot be read.
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <limits>

#include "src/base/core/error.h"
#include "src/base/image/sparse_grid.h"
#include "tests/base/image/sparse_grid_file.h"
#include "tests/base/image/temporary_folder.h"
#include "tests/support/input_error.h"

namespace lanelight::test {
namespace {

// On both sides of 0, over several blocks, in pieces.
float Pattern(int i, int j, int k) {
  const int n = (i * 7 + j * 3 + k * 5 + 900) % 11;
  return n < 6 ? 0.0f : 0.25f * static_cast<float>(n);
}

SparseFileGrid PatternGrid(SparseType type = SparseType::kFloat) {
  SparseFileGrid grid;
  grid.low[0] = -9, grid.low[1] = -3, grid.low[2] = 2;
  grid.high[0] = 12, grid.high[1] = 9, grid.high[2] = 20;
  grid.value = Pattern;
  grid.voxel_size = 0.5;
  grid.origin[0] = 3, grid.origin[2] = -1;
  grid.type = type;
  return grid;
}

double Inside(int i, int j, int k) {
  const bool in = i >= -9 && i <= 12 && j >= -3 && j <= 9 && k >= 2 && k <= 20;
  return in ? double{Pattern(i, j, k)} : 0;
}

double PatternAt(double x, double y, double z) {
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  const int k = static_cast<int>(std::floor(z));
  double sum = 0;
  for (int n = 0; n < 8; ++n) {
    const int a = i + (n & 1), b = j + (n >> 1 & 1), c = k + (n >> 2);
    sum += (1 - std::abs(x - a)) * (1 - std::abs(y - b)) * (1 - std::abs(z - c)) *
           Inside(a, b, c);
  }
  return sum;
}

void CheckPattern(const SparseGrid& grid, double tolerance) {
  for (int n = 0; n < 500; ++n) {
    const float x = -11 + std::fmod(0.37f * n, 25.0f);
    const float y = -5 + std::fmod(0.73f * n, 16.0f);
    const float z = std::fmod(1.19f * n, 23.0f);
    float found = -1;
    grid.Interpolate(&x, &y, &z, 1, &found);
    INFO(x << " " << y << " " << z);
    CHECK(std::abs(found - PatternAt(x, y, z)) <= tolerance);
  }
}

std::string ErrorOf(const std::string& path) {
  return InputErrorOf([&] { ReadSparseGrid(path, "density"); });
}

}  // namespace

TEST_CASE("NanoVDB: values, place and bounds", "[image][nanovdb]") {
  const TemporaryFolder folder;
  const std::string path = folder.File("a.nvdb");
  SparseFileGrid other = PatternGrid();
  other.name = "other";
  WriteSparseFile(path, {other, PatternGrid()});
  CHECK(ReadSparseGrid(path, "temperature") == nullptr);
  const auto grid = ReadSparseGrid(path, "density");
  REQUIRE(grid != nullptr);
  CheckPattern(*grid, 1e-5);
  CHECK(grid->Value(5, 4, 3) == Pattern(5, 4, 3));
  CHECK(grid->largest() == 2.5f);
  CHECK(grid->smallest() == 0);
  CHECK(grid->box_min().x == Approx(3 - 4.5));  // of voxels -9 to 12, and one more
  CHECK(grid->box_max().x == Approx(3 + 6.5));
  CHECK(grid->index_from_world().Point({4, 0, 0}).x == Approx(2));
  CHECK(grid->index_from_world().Point({4, 0, 0}).z == Approx(2));
  const float nan = std::numeric_limits<float>::quiet_NaN(), zero = 0;
  float out = 1;
  grid->Interpolate(&nan, &zero, &zero, 1, &out);
  CHECK(out == 0);
}

TEST_CASE("NanoVDB: bounds of boxes are valid and tight", "[image][nanovdb]") {
  const TemporaryFolder folder;
  SparseFileGrid negative = PatternGrid(), blocks = PatternGrid();
  negative.value = [](int i, int j, int k) { return Pattern(i, j, k) - 3; };
  blocks.value = [](int i, int j, int k) { return Pattern(i >> 3, j >> 3, k >> 3); };
  blocks.tiles = true;
  for (const SparseFileGrid& of : {PatternGrid(), negative, blocks}) {
    WriteSparseFile(folder.File("a.nvdb"), {of});
    const auto grid = ReadSparseGrid(folder.File("a.nvdb"), "density");
    for (int n = 0; n < 60; ++n) {
      const int low[3] = {-12 + n % 7 * 3, -6 + n % 5 * 3, n % 4 * 6};
      const int high[3] = {low[0] + n % 9, low[1] + n % 3, low[2] + n % 11};
      float expected = -INFINITY;
      for (int i = low[0]; i <= high[0]; ++i) {
        for (int j = low[1]; j <= high[1]; ++j) {
          for (int k = low[2]; k <= high[2]; ++k) {
            expected = std::max(expected, grid->Value(i, j, k));
          }
        }
      }
      CHECK(grid->LargestIn(low, high) == expected);
    }
    // Across the edges of nodes, where the background begins.
    const int inside[3] = {1, 1, 3}, outside[3] = {1, 1, 4096};
    CHECK(grid->LargestIn(inside, outside) >= 0);
  }
}

TEST_CASE("NanoVDB: quantised and compressed", "[image][nanovdb]") {
  const TemporaryFolder folder;
  const std::string path = folder.File("a.nvdb");
  WriteSparseFile(path, {PatternGrid()});
  const std::size_t whole = ReadSparseGrid(path, "density")->bytes();
  // Steps of a block's range, which is 2.5 at most: half of one is the largest error.
  const struct {
    SparseType type;
    double tolerance;
  } kTypes[] = {{SparseType::kFp4, 2.5 / 15 / 2 + 1e-5},
                {SparseType::kFp8, 2.5 / 255 / 2 + 1e-5},
                {SparseType::kFp16, 2.5 / 65535 / 2 + 1e-5},
                {SparseType::kFpN, 0.05}};
  for (const auto& [type, tolerance] : kTypes) {
    WriteSparseFile(path, {PatternGrid(type)});
    const auto grid = ReadSparseGrid(path, "density");
    INFO(static_cast<int>(type));
    CheckPattern(*grid, tolerance);
    CHECK(grid->bytes() < whole - 5000);  // as stored
  }
  for (const SparseCodec codec : {SparseCodec::kZip, SparseCodec::kBlosc}) {
    WriteSparseFile(path, {PatternGrid()}, codec);
    CheckPattern(*ReadSparseGrid(path, "density"), 1e-5);
  }
}

TEST_CASE("NanoVDB: unsupported files are errors", "[image][nanovdb]") {
  const TemporaryFolder folder;
  const std::string path = folder.File("a.nvdb");
  CHECK_THAT(ErrorOf(path), Catch::Contains("No such file"));
  CHECK_THAT(ErrorOf(folder.Write("b.nvdb", "a long text that is no NanoVDB file")),
             Catch::Contains("cannot read NanoVDB file"));
  SparseFileGrid level_set = PatternGrid();
  level_set.level_set = true;
  WriteSparseFile(path, {level_set});
  CHECK_THAT(ErrorOf(path), Catch::Contains("level set"));
  SparseFileGrid infinite = PatternGrid();
  infinite.value = [](int i, int, int) { return i == 3 ? INFINITY : 1.0f; };
  WriteSparseFile(path, {infinite});
  CHECK_THAT(ErrorOf(path), Catch::Contains("not finite"));
  WriteSparseFile(path, {PatternGrid()});
  std::string bytes;
  {
    std::ifstream file(path, std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(file), {});
  }
  CHECK_THAT(ErrorOf(folder.Write("c.nvdb", bytes.substr(0, bytes.size() / 2))),
             Catch::Contains("cannot read NanoVDB file"));
  bytes[bytes.size() / 2] ^= 1;
  CHECK_THAT(ErrorOf(folder.Write("d.nvdb", bytes)), Catch::Contains("is damaged"));
}

}  // namespace lanelight::test

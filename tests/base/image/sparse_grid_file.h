// NanoVDB files for tests, written by NanoVDB's own code.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace lanelight::test {

enum class SparseType { kFloat, kFp4, kFp8, kFp16, kFpN };
enum class SparseCodec { kNone, kZip, kBlosc };

/// A fog volume: voxel (i, j, k) of low to high is value(i, j, k), which 0 leaves out;
/// index point x is at voxel_size * x + origin of the file's world.
struct SparseFileGrid {
  std::string name = "density";
  int low[3] = {0, 0, 0}, high[3] = {7, 7, 7};
  std::function<float(int, int, int)> value;
  double voxel_size = 1, origin[3] = {0, 0, 0};
  SparseType type = SparseType::kFloat;
  bool level_set = false;
  bool checksum = true;
  bool tiles = false;  // blocks of one value take up one value of the node above them
};

void WriteSparseFile(const std::string& path, const std::vector<SparseFileGrid>& grids,
                     SparseCodec codec = SparseCodec::kNone);

}  // namespace lanelight::test

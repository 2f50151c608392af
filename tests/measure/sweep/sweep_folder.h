// A sweep of a few small cells, and what tests look at in its directory.
#pragma once

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "src/base/image/exr.h"
#include "tests/cli/process.h"
#include "tests/measure/study/study_file.h"

namespace lanelight {

/// Writes two scenes and a sweep of 2 x 3 x 2 x 2 cells less 2 into the directory;
/// returns the path of the sweep.
inline std::string WriteSweep(const TempDirectory& directory) {
  const std::string sphere = WriteSphereScene(directory);
  std::filesystem::copy_file(sphere, directory / "other.pbrt");
  return WriteText(directory / "sweep.toml", R"([grid]
scene = ["sphere.pbrt", "other.pbrt"]
resolution = "48x36"
strategy = ["default", "points=independent", "points=stratified"]
spp = [4, 64]
seed = [1, 2]
[[exclude]]
scene = "other.pbrt"
strategy = "points=stratified"
spp = 64
)");
}
inline constexpr int kSweepCells = 22;

/// The names of the cells that are done.
inline std::vector<std::string> DoneCells(const std::string& out) {
  std::vector<std::string> names;
  if (!std::filesystem::is_directory(out + "/cells")) return names;
  for (const auto& entry : std::filesystem::directory_iterator(out + "/cells")) {
    if (std::filesystem::exists(entry.path() / "report.json")) {
      names.push_back(entry.path().filename().string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// The pixels of all channels of the images of all cells.
inline std::map<std::string, std::vector<float>> CellPixels(const std::string& out) {
  std::map<std::string, std::vector<float>> pixels;
  for (const std::string& name : DoneCells(out)) {
    const Image image = ReadExr(out + "/cells/" + name + "/image.exr");
    pixels[name].assign(image.pixels.begin(), image.pixels.end());
  }
  return pixels;
}

/// Returns whether two sets of images are the same, bit by bit.
inline bool SamePixels(const std::map<std::string, std::vector<float>>& a,
                       const std::map<std::string, std::vector<float>>& b) {
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(), [](const auto& x, const auto& y) {
           return x.first == y.first && x.second.size() == y.second.size() &&
                  std::memcmp(x.second.data(), y.second.data(),
                              x.second.size() * sizeof(float)) == 0;
         });
}

/// Returns superfluous files: temporary ones, and images without a report.
inline std::vector<std::string> Rubbish(const std::string& out) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(out)) {
    const auto folder = entry.path().parent_path();
    const bool alone = entry.path().filename() == "image.exr" &&
                       !std::filesystem::exists(folder / "report.json");
    if (alone || entry.path().extension() == ".tmp") names.push_back(entry.path());
  }
  return names;
}

}  // namespace lanelight

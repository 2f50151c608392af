#include "src/render/job/partial_outputs.h"

#include <fmt/format.h>

#include <filesystem>

#include "src/base/core/error.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

bool IsTaken(const std::string& path) {
  std::error_code ignored;  // a file that cannot be looked at cannot be written either
  return !path.empty() && path != "-" && fs::exists(path, ignored);
}

// Returns whether the file is an image of the same render with no more samples. The new
// image then contains its samples, since a sample depends on seed, pixel and number only.
bool IsEarlierImage(const std::string& path, const ExrOptions& image) {
  try {
    const auto before = ReadExrHeader(path).at(0).attributes;
    for (const char* name : {"sceneHash", "settings", "strategy", "seed", "version"}) {
      const auto found = before.find(name);
      if (found == before.end() || found->second != image.attributes.at(name))
        return false;
    }
    // Files store it as float.
    const auto spp = static_cast<float>(std::get<double>(image.attributes.at("spp")));
    return std::get<double>(before.at("spp")) <= spp;
  } catch (const std::exception&) {
    return false;  // not an image of this program
  }
}

bool MayWrite(const RenderTargets& targets, const ExrOptions& image) {
  // PNG and report belong to the image.
  if (IsTaken(targets.exr)) return IsEarlierImage(targets.exr, image);
  return !IsTaken(targets.png) && !IsTaken(targets.json);
}

}  // namespace

std::string PartialPath(const std::string& path, int number) {
  if (path.empty() || path == "-") return path;
  const fs::path whole = path;
  const std::string suffix =
      number == 1 ? ".partial" : fmt::format(".partial-{}", number);
  return whole.parent_path() /
         (whole.stem().string() + suffix + whole.extension().string());
}

RenderTargets PartialTargets(RenderTargets targets, int number) {
  if (number == 0) return targets;
  for (std::string* path : {&targets.exr, &targets.png, &targets.json}) {
    *path = PartialPath(*path, number);
  }
  return targets;
}

int FreePartialNumber(const RenderTargets& targets, const ExrOptions& image, int first) {
  int number = first;
  while (!MayWrite(PartialTargets(targets, number), image)) ++number;
  return number;
}

}  // namespace lanelight

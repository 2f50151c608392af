#include "bench/calibrate/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "src/base/core/error.h"

namespace lanelight::bench {

namespace fs = std::filesystem;

std::vector<std::string> AllScenes() {
  std::vector<std::string> scenes, shared;
  std::error_code none;  // a folder that is not there
  for (const auto& entry : fs::directory_iterator("scenes", none)) {
    if (entry.path().extension() == ".pbrt") scenes.push_back(entry.path().string());
  }
  const char* folder = std::getenv("LANELIGHT_SCENES");
  for (const auto& entry :
       fs::directory_iterator(folder ? folder : "../shared/scenes", none)) {
    const fs::path scene = entry.path() / "scene-v4.pbrt";
    if (fs::is_regular_file(scene, none)) shared.push_back(scene.string());
  }
  std::sort(scenes.begin(), scenes.end());
  std::sort(shared.begin(), shared.end());
  scenes.insert(scenes.end(), shared.begin(), shared.end());
  if (scenes.empty()) {
    throw InputError(
        "no scenes/*.pbrt here: run in the project's folder, or name scenes");
  }
  return scenes;
}

std::string SceneName(const std::string& path) {
  const fs::path file = fs::absolute(path);
  return (file.parent_path().filename() / file.stem()).string();
}

std::array<int, 2> ParseResolution(const std::string& text) {
  int width = 0, height = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2 || width < 1 ||
      height < 1) {
    throw InputError(fmt::format("--resolutions: '{}' is not WxH, like 48x48", text));
  }
  return {width, height};
}

}  // namespace lanelight::bench

#include "src/scene/description/scene_names.h"

#include <filesystem>
#include <set>

namespace lanelight {

namespace fs = std::filesystem;

std::string SceneName(const std::string& path) {
  const fs::path file(path);
  const std::string stem = file.stem().string();
  const std::string folder = file.parent_path().filename().string();
  const bool generic = stem == "reference" || stem == "scene" || stem == "scene-v4";
  return generic && folder.find_first_not_of('.') != folder.npos ? folder : stem;
}

std::vector<std::string> SceneNames(const std::vector<std::string>& paths) {
  std::vector<std::string> names;
  std::set<std::string> used;
  for (const std::string& path : paths) {
    const std::string name = SceneName(fs::absolute(path).string());
    names.push_back(name);
    for (int i = 2; !used.insert(names.back()).second; ++i) {
      names.back() = name + "-" + std::to_string(i);
    }
  }
  return names;
}

}  // namespace lanelight

#include "src/scene/scene_names.h"

#include <filesystem>
#include <set>

namespace lanelight {
namespace {

namespace fs = std::filesystem;

std::string NameOf(const std::string& path) {
  const fs::path file(path);
  const std::string stem = file.stem().string();
  const std::string folder = fs::absolute(file).parent_path().filename().string();
  const bool generic = stem == "reference" || stem == "scene" || stem == "scene-v4";
  return generic && !folder.empty() ? folder : stem;
}

}  // namespace

std::vector<std::string> SceneNames(const std::vector<std::string>& paths) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const std::string& path : paths) {
    const std::string name = NameOf(path);
    names.push_back(name);
    for (int i = 2; !taken.insert(names.back()).second; ++i) {
      names.back() = name + "-" + std::to_string(i);
    }
  }
  return names;
}

}  // namespace lanelight

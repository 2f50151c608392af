// Short names of scenes.
#pragma once

#include <string>
#include <vector>

namespace lanelight {

/// The file's name without its ending, or its folder's, where the path says it and the
/// file is called "reference", "scene" or "scene-v4".
std::string SceneName(const std::string& path);

/// A SceneName for each file, by its absolute path, no two the same: "-2", "-3", ...
/// follow what is taken.
std::vector<std::string> SceneNames(const std::vector<std::string>& paths);

}  // namespace lanelight

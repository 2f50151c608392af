// What scenes are called where their paths would be too long.
#pragma once

#include <string>
#include <vector>

namespace lanelight {

/// A name for each file, no two the same: the file's without its ending, or its folder's
/// where the file is called "reference", "scene" or "scene-v4"; "-2", "-3", ... follow
/// what is taken.
std::vector<std::string> SceneNames(const std::vector<std::string>& paths);

}  // namespace lanelight

// pbrt-v4 text scenes (with Include, Import and PLY meshes) to SceneDescription.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "src/scene/description.h"

namespace lanelight {

struct ParseOptions {
  bool skip_unsupported = false;  // media and the like become notes instead of errors
};

/// Parses the file and everything it includes; meshes are read in parallel.
/// Throws InputError: place, what was found, what is supported, the nearest known name.
SceneDescription ParseScene(const std::string& path, const ParseOptions& options = {});

/// Parses text as if it stood in a file called `name` inside `directory`.
SceneDescription ParseSceneText(std::string_view text, const std::string& name,
                                const std::string& directory,
                                const ParseOptions& options = {});

}  // namespace lanelight

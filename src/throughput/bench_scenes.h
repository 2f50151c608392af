// The scenes of `lanelight bench` where none is given: texts that are part of the
// program, so that everybody measures the same (from scenes/, by embed_scenes.py).
#pragma once

#include <string>
#include <vector>

#include "src/scene/description.h"

namespace lanelight {

struct BenchScene {
  const char* name;
  const char* stresses;  // what of the renderer it keeps busy
  const char* text;
};

/// In the order in which they are measured.
const std::vector<BenchScene>& BenchScenes();

/// The description of the scene of that name, or of the file. Throws InputError.
SceneDescription ReadBenchScene(const std::string& scene);

}  // namespace lanelight

// The default scenes of `lanelight bench`. Their texts are part of the program
// (embed_scenes.py), so that all users measure the same scenes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lanelight {

struct SceneDescription;  // src/scene/description/description.h

struct BenchScene {
  const char* name;
  std::uint64_t spp;     // of a render; fixed, so that measurements can be compared
  const char* stresses;  // the parts of the renderer that take most of the time
  const char* text;
};

/// Returns the scenes in the order in which they are measured.
const std::vector<BenchScene>& BenchScenes();

/// Returns the default samples per pixel of that scene; kFileSpp for scene files.
std::uint64_t BenchSpp(const std::string& scene);
inline constexpr std::uint64_t kFileSpp = 16;

/// Reads the scene of that name, or the scene file. Throws InputError.
SceneDescription ReadBenchScene(const std::string& scene);

}  // namespace lanelight

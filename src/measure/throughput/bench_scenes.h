// The scenes of `lanelight bench` where none is given: texts that are part of the
// program, so that everybody measures the same (from scenes/, by embed_scenes.py).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lanelight {

struct SceneDescription;  // src/scene/description/description.h

struct BenchScene {
  const char* name;
  std::uint64_t spp;     // of a render: fixed, so that any two measurements have the same
  const char* stresses;  // what of the renderer it keeps busy
  const char* text;
};

/// In the order in which they are measured.
const std::vector<BenchScene>& BenchScenes();

/// Samples per pixel of a render of that scene, if nothing else is asked for; kFileSpp
/// for scene files.
std::uint64_t BenchSpp(const std::string& scene);
inline constexpr std::uint64_t kFileSpp = 16;

/// The description of the scene of that name, or of the file. Throws InputError.
SceneDescription ReadBenchScene(const std::string& scene);

}  // namespace lanelight

// A compiled scene file, and the seconds that reading and compiling it took.
#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "src/scene/accel/bvh_report.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// Data that all jobs of a scene share besides the compiled scene.
struct LoadedScene {
  SceneDescription description;  // overrides applied; meshes released after compiling
  std::set<std::string> files;   // that the scene reads, its own among them
  std::string transport_why;     // why paths carry what they do, if the scene decides
  std::uint64_t scene_hash = 0;  // see HashSceneFiles()
  double load_seconds = 0;       // reading and parsing
  double build_seconds = 0;      // compiling: acceleration structure, lights, textures
  BvhReport trees;               // over shapes: part of that
};

}  // namespace lanelight

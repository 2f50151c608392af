// The scenes that several renderers share. They are no part of the project: tests that
// need them are reported as skipped where they are missing.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace lanelight {

/// $LANELIGHT_SCENES, or else ../shared/scenes beside the project.
inline std::filesystem::path SharedScenes() {
  if (const char* folder = std::getenv("LANELIGHT_SCENES")) return folder;
  return std::filesystem::path(LANELIGHT_SOURCE_DIR) / ".." / "shared" / "scenes";
}

/// Returns whether there are shared scenes. If not, prints the line by which ctest knows
/// that a test is skipped (tests/CMakeLists.txt). It counts for all test cases of a file,
/// failed ones too: so a file has either none or only such as need the scenes.
inline bool HaveSharedScenes() {
  if (std::filesystem::is_directory(SharedScenes())) return true;
  std::printf("skipped: no shared scenes in %s (set LANELIGHT_SCENES)\n",
              SharedScenes().c_str());
  return false;
}

}  // namespace lanelight

// One fuzz input for the scene parser and the PLY reader.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "src/base/core/error.h"
#include "src/scene/parse/parse.h"
#include "src/scene/parse/ply.h"

namespace lanelight {

/// Parses the bytes as a PLY file if they start like one, else as a scene without access
/// to files. InputError is the only exception that may arise; it is swallowed here, and
/// everything else is left to the caller. Returns true if the input was accepted.
inline bool FuzzParse(std::string_view bytes) {
  try {
    if (bytes.substr(0, 3) == "ply") {
      ParsePly(bytes, "fuzz.ply");
    } else {
      ParseOptions options;
      options.allow_files = false;
      options.skip_unsupported = bytes.size() % 2 == 0;
      ParseSceneText(bytes, "fuzz.pbrt", "", options);
    }
  } catch (const InputError&) {
    return false;
  }
  return true;
}

}  // namespace lanelight

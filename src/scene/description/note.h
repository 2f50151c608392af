// Notes of a scene reader for the user, besides errors.
#pragma once

#include <string>

#include "src/base/core/source_location.h"

namespace lanelight {

/// Something that was read and deliberately not used. `changes_image`: what is rendered
/// is visibly not what the file asks for. `warning`: the image is that of pbrt-v4, but
/// the file has a mistake.
struct Note {
  SourceLocation where;
  std::string message;
  bool changes_image = false;
  bool warning = false;
};

}  // namespace lanelight

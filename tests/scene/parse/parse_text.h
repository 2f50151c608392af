// Short-hands for tests that parse snippets.
#pragma once

#include <string>

#include "src/base/core/error.h"
#include "src/scene/parse/parse.h"
#include "tests/support/input_error.h"

namespace lanelight {

/// Parses a whole scene text without access to files.
inline SceneDescription ParseText(const std::string& text,
                                  bool skip_unsupported = false) {
  return ParseSceneText(text, "test.pbrt", ".", {skip_unsupported, false});
}

/// Parses what stands after WorldBegin.
inline SceneDescription ParseWorld(const std::string& text,
                                   bool skip_unsupported = false) {
  return ParseText("WorldBegin\n" + text, skip_unsupported);
}

/// The message of the InputError, or "".
inline std::string WorldError(const std::string& text) {
  return InputErrorOf([&] { ParseWorld(text); });
}

/// True if a note contains the words.
inline bool HasNote(const SceneDescription& scene, const std::string& words) {
  for (const Note& note : scene.notes) {
    if (note.message.find(words) != std::string::npos) return true;
  }
  return false;
}

/// True if a warning contains the words.
inline bool HasWarning(const SceneDescription& scene, const std::string& words) {
  for (const Note& note : scene.notes) {
    if (note.warning && note.message.find(words) != std::string::npos) return true;
  }
  return false;
}

}  // namespace lanelight

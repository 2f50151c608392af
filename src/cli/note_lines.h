// Notes on a scene as lines: those of one kind are one line.
#pragma once

#include <string>
#include <vector>

#include "src/scene/description/note.h"

namespace lanelight {

/// "scene.pbrt:3:1: note: ... (and 12 more like it)". Notes are of one kind if they say
/// the same but for numbers. At most eight kinds.
std::vector<std::string> NoteLines(const std::vector<Note>& notes);

}  // namespace lanelight

// Notes of the parser to the user, besides errors.
#pragma once

#include <algorithm>
#include <set>
#include <string>
#include <vector>

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

/// Notes after which the image is visibly not what the file asks for.
inline std::size_t CountImageChanges(const std::vector<Note>& notes) {
  return static_cast<std::size_t>(std::count_if(
      notes.begin(), notes.end(), [](const Note& note) { return note.changes_image; }));
}

/// "the image differs from the scene file: <message>, and 2 more"; "" if it is.
inline std::string ImageChangesText(const std::vector<Note>& notes) {
  std::set<std::string> different;  // the same of many objects counts once
  std::string first;
  for (const Note& note : notes) {
    if (!note.changes_image) continue;
    if (different.empty()) first = note.message;
    different.insert(note.message);
  }
  if (different.empty()) return "";
  std::string text = "the image differs from the scene file: " + first;
  const std::size_t more = different.size() - 1;
  return more == 0 ? text : text + ", and " + std::to_string(more) + " more";
}

}  // namespace lanelight

// Decides whether what is rendered is what the scene file asks for.
#pragma once

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "src/scene/description/description.h"

namespace lanelight {

/// Notes after which the image is visibly not what the file asks for.
inline std::size_t CountImageChanges(const std::vector<Note>& notes) {
  return static_cast<std::size_t>(std::count_if(
      notes.begin(), notes.end(), [](const Note& note) { return note.changes_image; }));
}

/// "the image is not what the scene file asks for: <message>, and 2 more"; "" if it is.
inline std::string ImageChangesText(const std::vector<Note>& notes) {
  std::set<std::string> different;  // the same of many objects counts once
  std::string first;
  for (const Note& note : notes) {
    if (!note.changes_image) continue;
    if (different.empty()) first = note.message;
    different.insert(note.message);
  }
  if (different.empty()) return "";
  std::string text = "the image is not what the scene file asks for: " + first;
  const std::size_t more = different.size() - 1;
  return more == 0 ? text : text + ", and " + std::to_string(more) + " more";
}

}  // namespace lanelight

#include "src/cli/note_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

namespace lanelight {
namespace {

constexpr std::size_t kMostKinds = 8;

// The message without what differs from one shape to the next: its numbers, also those in
// names ("mesh_0012").
std::string KindOf(const std::string& message) {
  std::string kind;
  for (const char c : message) {
    if (std::isdigit(static_cast<unsigned char>(c)) == 0) kind += c;
  }
  return kind;
}

struct NoteKind {
  const Note* first;
  std::size_t count = 1;
};

}  // namespace

std::vector<std::string> NoteLines(const std::vector<Note>& notes) {
  std::vector<NoteKind> kinds;  // in the order of their first notes
  std::map<std::string, std::size_t> places;
  for (const Note& note : notes) {
    const auto [place, is_new] = places.emplace(KindOf(note.message), kinds.size());
    if (is_new) {
      kinds.push_back({&note});
    } else {
      ++kinds[place->second].count;
    }
  }
  // Warnings first, so that no number of notes hides them.
  std::vector<NoteKind> ordered;
  for (const bool warning : {true, false}) {
    std::copy_if(kinds.begin(), kinds.end(), std::back_inserter(ordered),
                 [&](const NoteKind& kind) { return kind.first->warning == warning; });
  }
  std::vector<std::string> lines;
  std::size_t more = 0;
  for (const NoteKind& kind : ordered) {
    if (lines.size() == kMostKinds) {
      more += kind.count;
      continue;
    }
    std::string line =
        fmt::format("{}: {}: {}", kind.first->where.ToString(),
                    kind.first->warning ? "warning" : "note", kind.first->message);
    if (kind.count > 1) line += fmt::format(" (and {} more like it)", kind.count - 1);
    lines.push_back(line);
  }
  if (more > 0)
    lines.push_back(fmt::format("and {} more notes (all are in --json)", more));
  return lines;
}

}  // namespace lanelight

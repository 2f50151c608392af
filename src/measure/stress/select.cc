#include "src/measure/stress/select.h"

#include <fnmatch.h>

#include <algorithm>

#include "src/base/core/error.h"
#include "src/base/core/suggest.h"

namespace lanelight::stress {
namespace {

bool IsMatch(const std::string& word, const Case& about) {
  return fnmatch(word.c_str(), about.name.c_str(), 0) == 0 ||
         fnmatch(word.c_str(), about.group.c_str(), 0) == 0;
}

[[noreturn]] void ThrowNoMatch(const std::string& word, const std::vector<Case>& cases) {
  std::vector<std::string> known;
  for (const Case& about : cases) {
    known.push_back(about.name);
    if (std::find(known.begin(), known.end(), about.group) == known.end()) {
      known.push_back(about.group);
    }
  }
  const std::string nearest = NearestName(word, known);
  throw InputError("unknown case or group " + Quoted(word) +
                   (nearest.empty() ? "" : "; did you mean " + Quoted(nearest) + "?") +
                   "; `lanelight stress --list` shows all");
}

// Groups in the order of their first cases.
std::vector<Case> ByGroup(const std::vector<Case>& cases) {
  std::vector<std::string> groups;
  for (const Case& about : cases) {
    if (std::find(groups.begin(), groups.end(), about.group) == groups.end()) {
      groups.push_back(about.group);
    }
  }
  std::vector<Case> sorted;
  for (const std::string& group : groups) {
    for (const Case& about : cases) {
      if (about.group == group) sorted.push_back(about);
    }
  }
  return sorted;
}

}  // namespace

std::vector<Case> SelectCases(std::vector<Case> cases,
                              const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    const auto means = [&](const Case& about) { return IsMatch(word, about); };
    if (std::none_of(cases.begin(), cases.end(), means)) ThrowNoMatch(word, cases);
  }
  std::erase_if(cases, [&](const Case& about) {
    return !words.empty() &&
           std::none_of(words.begin(), words.end(),
                        [&](const std::string& word) { return IsMatch(word, about); });
  });
  return ByGroup(cases);
}

}  // namespace lanelight::stress

// Selects cases by the words of the command line.
#pragma once

#include <string>
#include <vector>

#include "src/measure/stress/stress_case.h"

namespace lanelight::stress {

/// Returns the cases that any of `words` names, group by group, else in their own order.
/// Returns all of them without words. A word is the name of a case or of a group, or a
/// pattern of the shell (* ? [...]) for either. Throws InputError for a word that names
/// nothing, with the nearest name.
std::vector<Case> SelectCases(std::vector<Case> cases,
                              const std::vector<std::string>& words);

}  // namespace lanelight::stress

#include "src/stress/cases/cases.h"

namespace lanelight::stress {

std::vector<Case> AllCases() {
  std::vector<Case> cases;
  AddUnitCases(cases);
  return cases;
}

}  // namespace lanelight::stress

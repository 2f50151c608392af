#include "src/stress/stress_case.h"

namespace lanelight::stress {

const char* Name(Truth truth) {
  switch (truth) {
    case Truth::kClosedForm:
      return "closed form";
    case Truth::kInvariance:
      return "invariance";
    case Truth::kTwin:
      return "twin";
    case Truth::kBound:
      return "bound";
    case Truth::kRate:
      return "rate";
  }
  return "?";
}

}  // namespace lanelight::stress

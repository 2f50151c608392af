#include "src/base/image/variance_unit.h"

#include <cmath>
#include <variant>

namespace lanelight {

int VarianceExponent(double largest) {
  if (!(largest > 0) || !std::isfinite(largest)) return 0;
  const int exponent = std::ilogb(largest);
  if (exponent >= -60 && exponent <= 125) return 0;
  return exponent - 125;
}

double VarianceUnit(const Image& image) {
  const auto found = image.attributes.find(kVarianceExponent);
  if (found == image.attributes.end()) return 1;
  const int* exponent = std::get_if<int>(&found->second);
  return exponent != nullptr ? std::ldexp(1.0, *exponent) : 1;
}

}  // namespace lanelight

#include "src/strategy/lattice.h"

#include <cmath>
#include <numeric>

#include "src/core/check.h"

namespace lanelight {

// The coprime number next to n over the golden ratio: for Fibonacci n the optimal lattice
// (Bahvalov 1959), near it for others.
std::uint32_t LatticeGenerator(std::uint32_t n) {
  LL_CHECK_GT(n, 0u);
  LL_CHECK_LE(n, kMostLattice);
  if (n < 3) return 1;
  const auto golden = static_cast<std::uint32_t>(std::lround(n * 0.6180339887498949));
  for (std::uint32_t step = 0;; ++step) {
    if (golden + step < n && std::gcd(golden + step, n) == 1) return golden + step;
    if (golden > step && std::gcd(golden - step, n) == 1) return golden - step;
  }
}

}  // namespace lanelight

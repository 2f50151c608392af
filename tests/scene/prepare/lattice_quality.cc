#include "tests/scene/prepare/lattice_quality.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "src/base/core/check.h"

namespace lanelight {
namespace {

// The coprime number next to n over the golden ratio: for Fibonacci n the optimal lattice
// (Bahvalov 1959), near it for others.
std::uint32_t GoldenGenerator(std::uint32_t n) {
  const auto golden = static_cast<std::uint32_t>(std::lround(n * 0.6180339887498949));
  for (std::uint32_t step = 0;; ++step) {
    if (golden + step < n && std::gcd(golden + step, n) == 1) return golden + step;
    if (golden > step && std::gcd(golden - step, n) == 1) return golden - step;
  }
}

}  // namespace

// A trigonometric term exp(2 pi i (h x + k y)) is integrated wrongly iff h + k z = 0
// modulo n. For given k the least such |h| is n times the distance of k z / n from the
// next whole number; it is small only for the denominators k of convergents of z / n.
// Euclid's algorithm on (n, z) goes through these: remainders are h, cofactors are k.
double LatticeError(std::uint32_t n, std::uint32_t z) {
  double sum = 0;
  std::uint64_t h = z, next = n, k = 1, before = 0;
  while (h > 0) {
    const double product = double(h) * double(k);
    sum += 1 / (product * product);
    const std::uint64_t quotient = next / h;
    next = std::exchange(h, next % h);
    before = std::exchange(k, quotient * k + before);
  }
  return sum;
}

std::uint32_t LatticeGenerator(std::uint32_t n) {
  LL_CHECK_GT(n, 0u);
  LL_CHECK_LT(n, 1u << 31);
  if (n < 3) return 1;
  constexpr std::uint32_t kReach = 2048;  // a millisecond at most
  const std::uint32_t golden = GoldenGenerator(n);
  const std::uint32_t last = std::min(n - 1, golden + kReach);
  std::uint32_t best = golden;
  double minimum = LatticeError(n, golden);
  for (std::uint32_t z = golden > kReach ? golden - kReach : 1; z <= last; ++z) {
    const double error = LatticeError(n, z);
    if (error < minimum && std::gcd(z, n) == 1) {
      minimum = error;
      best = z;
    }
  }
  return best;
}

}  // namespace lanelight

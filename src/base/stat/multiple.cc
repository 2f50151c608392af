#include "src/base/stat/multiple.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "src/base/core/check.h"

namespace lanelight::stat {

std::vector<std::size_t> HolmRejections(std::span<const double> p, double family) {
  LL_CHECK(family > 0 && family < 1);
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto value = [&](std::size_t i) { return std::isnan(p[i]) ? 2 : p[i]; };
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return value(a) < value(b); });
  std::size_t rejected = 0;
  while (rejected < p.size() &&
         value(order[rejected]) <= family / static_cast<double>(p.size() - rejected)) {
    ++rejected;
  }
  order.resize(rejected);
  std::sort(order.begin(), order.end());
  return order;
}

}  // namespace lanelight::stat

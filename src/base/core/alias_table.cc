#include "src/base/core/alias_table.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "src/base/core/check.h"

namespace lanelight {
namespace {

// Scales weights to mean 1; by their maximum first, so that the sum does not overflow.
std::vector<double> MeanOne(std::span<const double> weights) {
  double largest = 0;
  for (double w : weights) {
    LL_CHECK(std::isfinite(w) && w >= 0);
    largest = std::max(largest, w);
  }
  LL_CHECK_GT(largest, 0.0);
  double sum = 0;
  for (double w : weights) sum += w / largest;
  const double factor = static_cast<double>(weights.size()) / sum;
  std::vector<double> scaled(weights.size());
  std::transform(weights.begin(), weights.end(), scaled.begin(),
                 [&](double w) { return w / largest * factor; });
  return scaled;
}

// Probability with which the rounded table yields each entry.
AlignedVector<float> ImpliedProbability(const AliasTable& table) {
  std::vector<double> p(table.size(), 0.0);
  for (std::size_t i = 0; i < table.size(); ++i) {
    p[i] += table.q[i];
    p[table.alias[i]] += 1.0 - table.q[i];
  }
  AlignedVector<float> out(table.size());
  const double n = static_cast<double>(table.size());
  std::transform(p.begin(), p.end(), out.begin(),
                 [&](double x) { return static_cast<float>(x / n); });
  return out;
}

}  // namespace

AliasTable BuildAliasTable(std::span<const double> weights) {
  LL_CHECK_LT(weights.size(), std::size_t{1} << 32);
  std::vector<double> rest = MeanOne(weights);
  const auto n = static_cast<std::uint32_t>(weights.size());
  AliasTable table;
  table.q.assign(n, 1.0f);
  table.alias.resize(n);
  std::iota(table.alias.begin(), table.alias.end(), 0u);

  std::vector<std::uint32_t> small, large;
  for (std::uint32_t i = 0; i < n; ++i) (rest[i] < 1 ? small : large).push_back(i);
  const auto largest = static_cast<std::uint32_t>(
      std::max_element(weights.begin(), weights.end()) - weights.begin());
  while (!small.empty() && !large.empty()) {
    const std::uint32_t s = small.back(), l = large.back();
    small.pop_back();
    table.q[s] = static_cast<float>(rest[s]);
    table.alias[s] = l;
    rest[l] -= 1 - rest[s];
    if (rest[l] < 1) {
      large.pop_back();
      small.push_back(l);
    }
  }
  // Remaining entries differ from 1 by rounding alone, unless their weight is 0.
  for (std::uint32_t s : small) {
    if (weights[s] > 0) continue;
    table.q[s] = 0;
    table.alias[s] = largest;
  }
  table.probability = ImpliedProbability(table);
  return table;
}

}  // namespace lanelight

#include "tests/vocabulary/strategy/covering.h"

#include <random>
#include <set>
#include <tuple>

namespace lanelight::test {
namespace {

using Pair = std::tuple<std::size_t, std::size_t, std::size_t, std::size_t>;

std::set<Pair> AllPairs(const std::vector<Axis>& axes) {
  std::set<Pair> pairs;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    for (std::size_t j = i + 1; j < axes.size(); ++j) {
      for (std::size_t a = 0; a < axes[i].values.size(); ++a) {
        for (std::size_t b = 0; b < axes[j].values.size(); ++b)
          pairs.insert({i, a, j, b});
      }
    }
  }
  return pairs;
}

template <class Visit>
void ForEachPair(const Combination& c, Visit&& visit) {
  for (std::size_t i = 0; i < c.size(); ++i) {
    for (std::size_t j = i + 1; j < c.size(); ++j) visit(Pair{i, c[i], j, c[j]});
  }
}

Combination RandomCombination(const std::vector<Axis>& axes, std::mt19937& random) {
  Combination c;
  for (const Axis& axis : axes) c.push_back(random() % axis.values.size());
  return c;
}

}  // namespace

std::vector<Combination> CoverPairs(const std::vector<Axis>& axes,
                                    std::size_t min_covered) {
  constexpr int kCandidates = 60;
  std::mt19937 random(1);
  std::set<Pair> open = AllPairs(axes);
  std::set<Combination> used;
  std::vector<Combination> result;
  while (!open.empty() || result.size() < min_covered) {
    Combination best;
    std::size_t best_new = 0;
    for (int k = 0; k < kCandidates; ++k) {
      Combination c = RandomCombination(axes, random);
      if (!open.empty()) {  // start from a pair that is still missing
        const auto [i, a, j, b] = *open.begin();
        c[i] = a;
        c[j] = b;
      }
      if (used.count(c) != 0) continue;
      std::size_t fresh = 0;
      ForEachPair(c, [&](const Pair& p) { fresh += open.count(p); });
      if (best.empty() || fresh > best_new) {
        best = c;
        best_new = fresh;
      }
    }
    if (best.empty()) continue;
    ForEachPair(best, [&](const Pair& p) { open.erase(p); });
    used.insert(best);
    result.push_back(best);
  }
  return result;
}

std::size_t CountUncoveredPairs(const std::vector<Axis>& axes,
                                const std::vector<Combination>& combinations) {
  std::set<Pair> open = AllPairs(axes);
  for (const Combination& c : combinations) {
    ForEachPair(c, [&](const Pair& p) { open.erase(p); });
  }
  return open.size();
}

std::string StrategyOf(const std::vector<Axis>& axes, const Combination& combination) {
  std::string text;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const std::string& value = axes[i].values[combination[i]];
    if (!text.empty()) text += ',';
    text += axes[i].key + '=' + value;
  }
  return text;
}

}  // namespace lanelight::test

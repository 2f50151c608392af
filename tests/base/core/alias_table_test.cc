#include "src/base/core/alias_table.h"

#include <catch2/catch.hpp>

#include <random>
#include <vector>

#include "src/base/core/check.h"

namespace lanelight {
namespace {

// Probability of each entry under the table's rule: every i equally often, then q.
std::vector<double> Enumerate(const AliasTable& table) {
  std::vector<double> p(table.size(), 0.0);
  for (std::size_t i = 0; i < table.size(); ++i) {
    p[i] += table.q[i] / static_cast<double>(table.size());
    p[table.alias[i]] += (1.0 - table.q[i]) / static_cast<double>(table.size());
  }
  return p;
}

void CheckAgainst(const std::vector<double>& weights) {
  const AliasTable table = BuildAliasTable(weights);
  REQUIRE(table.size() == weights.size());
  double sum = 0, total = 0;
  for (double w : weights) sum += w;
  const std::vector<double> p = Enumerate(table);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    INFO(i << " of " << weights.size());
    // Rounding q to float moves at most 2^-24 of each entry that points here.
    CHECK(p[i] == Approx(weights[i] / sum).margin(1.2e-7).epsilon(2e-7));
    CHECK(table.probability[i] == static_cast<float>(p[i]));
    if (weights[i] == 0) CHECK(p[i] == 0);
    total += table.probability[i];
  }
  CHECK(total == Approx(1).epsilon(1e-6));
}

TEST_CASE("alias table: reproduces its weights exactly", "[core][alias]") {
  CheckAgainst({1});
  CheckAgainst({1, 3});
  CheckAgainst({0, 0, 5, 0});
  CheckAgainst({1e-30, 1, 1e30});
  CheckAgainst({3, 1, 4, 1, 5, 9, 2, 6, 5, 3, 5});
  CheckAgainst(std::vector<double>(1000, 0.1));
  std::mt19937 rng(1);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<double> weights(1 + rng() % 300);
    for (double& w : weights) w = rng() % 4 == 0 ? 0 : std::exp(rng() % 40 - 20.0);
    weights[rng() % weights.size()] = 1;
    CheckAgainst(weights);
  }
}

TEST_CASE("alias table: hand-computed", "[core][alias]") {
  const AliasTable table = BuildAliasTable(std::vector<double>{1, 3});
  CHECK(table.q[0] == 0.5f);
  CHECK(table.alias[0] == 1);
  CHECK(table.q[1] == 1.0f);
  CHECK(table.probability[0] == 0.25f);
  CHECK(table.probability[1] == 0.75f);
}

TEST_CASE("alias table: rejects weights that are not a distribution", "[core][alias]") {
  CHECK_THROWS_AS(BuildAliasTable(std::vector<double>{0, 0}), CheckFailure);
  CHECK_THROWS_AS(BuildAliasTable(std::vector<double>{1, -1}), CheckFailure);
  CHECK_THROWS_AS(BuildAliasTable(std::vector<double>{}), CheckFailure);
  CHECK_THROWS_AS(BuildAliasTable(std::vector<double>{1, 1.0 / 0.0}), CheckFailure);
}

}  // namespace
}  // namespace lanelight

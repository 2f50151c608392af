// The cases on materials, lights, transport, media, sampling, film and strategies, short,
// as far as they are promised. A mean may be off by its tolerance and five standard
// errors: with a thousand points the test fails once in 1500 seeds without a fault.
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "src/measure/stress/cases/cases.h"

namespace lanelight::stress {
namespace {

constexpr double kDeviations = 5;

bool HoldsClosely(const Case& c, const Point& p) {
  if (c.truth == Truth::kRate) {
    return p.trials > 0 && double(p.failures) <= p.expected * double(p.trials);
  }
  return std::abs(p.measured - p.expected) <=
         p.tolerance + kDeviations * p.standard_error;
}

std::vector<double> Values(const Case& c) {
  if (c.axis.quick.empty()) return {std::nan("")};
  return c.axis.quick;
}

// How many points were measured.
int CheckCase(const Case& c) {
  int measured = 0;
  for (double value : Values(c)) {
    if (!c.axis.Promised(value)) continue;
    for (const Point& p : c.measure(value, {})) {
      if (!p.not_measured.empty()) continue;
      ++measured;
      INFO(c.name << " at " << value << ", " << p.series << ": " << p.measured << " +- "
                  << p.standard_error << " for " << p.expected << ", " << p.failures
                  << " failures of " << p.trials);
      CHECK(HoldsClosely(c, p));
      CHECK(p.invalid == 0);
    }
  }
  return measured;
}

void CheckGroup(const std::string& group) {
  for (const Case& c : AllCases()) {
    if (c.group != group) continue;
    INFO(c.name);
    CHECK(CheckCase(c) > 0);
  }
}

}  // namespace

TEST_CASE("stress: materials", "[stress]") { CheckGroup("materials"); }
TEST_CASE("stress: lights", "[stress]") { CheckGroup("lights"); }
TEST_CASE("stress: transport", "[stress]") { CheckGroup("transport"); }
TEST_CASE("stress: media", "[stress]") { CheckGroup("media"); }
TEST_CASE("stress: sampling", "[stress]") { CheckGroup("sampling"); }
TEST_CASE("stress: film", "[stress]") { CheckGroup("film"); }
TEST_CASE("stress: strategies", "[stress]") { CheckGroup("strategies"); }

TEST_CASE("stress: names are unique", "[stress]") {
  std::set<std::string> names;
  for (const Case& c : AllCases()) CHECK(names.insert(c.name).second);
}

}  // namespace lanelight::stress

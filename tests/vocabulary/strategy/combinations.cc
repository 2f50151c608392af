#include "tests/vocabulary/strategy/combinations.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>

#include "src/base/core/error.h"
#include "src/base/core/source_location.h"
#include "src/render/plan/plan.h"
#include "src/scene/compiled/scene.h"
#include "src/vocabulary/strategy/strategy.h"

namespace lanelight::test {
namespace {

// Arguments with which a choice takes part; the others take part as they are.
const std::map<std::string, std::vector<std::string>>& Variants() {
  static const std::map<std::string, std::vector<std::string>> kVariants = {
      {"mis", {"mis:power", "mis:balance"}},
      {"regression", {"regression,c=1"}},
      {"block", {"block:8", "block:64:compact"}},
      {"splats", {"splats:2"}},
      {"constant", {"constant:0.2"}},
      {"throughput", {"throughput:0.1:1", "throughput:0:2:4"}}};
  return kVariants;
}

std::vector<Axis> MakeAxes() {
  std::vector<Axis> axes;
  for (const ChoiceInfo& choice : AllChoices()) {
    if (axes.empty() || axes.back().key != choice.axis) axes.push_back({choice.axis, {}});
    const auto variants = Variants().find(choice.name);
    auto& values = axes.back().values;
    if (variants == Variants().end()) {
      values.push_back(choice.name);
    } else {
      values.insert(values.end(), variants->second.begin(), variants->second.end());
    }
  }
  return axes;
}

}  // namespace

const std::vector<Axis>& Axes() {
  static const std::vector<Axis> kAxes = MakeAxes();
  return kAxes;
}

const std::vector<Combination>& Combinations() {
  static const std::vector<Combination> kCombinations = CoverPairs(Axes(), 60);
  return kCombinations;
}

std::size_t AxisOf(const std::string& key) {
  const auto at = std::find_if(Axes().begin(), Axes().end(),
                               [&](const Axis& axis) { return axis.key == key; });
  REQUIRE(at != Axes().end());
  return static_cast<std::size_t>(at - Axes().begin());
}

bool Accepts(const PreparedScene& scene, const std::string& text) {
  Strategy strategy = scene.strategy;
  ApplyStrategy(text, {}, strategy);
  PlanOptions options;
  options.max_depth = static_cast<std::uint32_t>(scene.compiled->integrator.max_depth);
  try {
    MakePlan(WithStrategy(scene, strategy), options);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

Combination FitTo(const PreparedScene& scene, const Combination& combination,
                  bool keep_reuse) {
  Combination fitted = combination;
  const auto fits = [&] { return Accepts(scene, StrategyOf(Axes(), fitted)); };
  if (fits()) return fitted;
  if (combination[AxisOf("light-paths")] != 0) {
    if (keep_reuse) {
      for (const char* key : {"reuse", "decide", "roulette"}) fitted[AxisOf(key)] = 0;
      if (fits()) return fitted;
      fitted = combination;  // it is the scene that refuses it
    }
    fitted[AxisOf("light-paths")] = 0;
    if (fits()) return fitted;
  }
  const Combination without = fitted;
  if (combination[AxisOf("reuse")] != 0) {
    if (keep_reuse) {
      for (const char* key : {"control", "roulette"}) {
        fitted[AxisOf(key)] = 0;
      }
      if (fits()) return fitted;
      fitted = without;  // it is the scene that refuses it
    }
    fitted[AxisOf("reuse")] = 0;
    if (fits()) return fitted;
  }
  CHECK(fitted[AxisOf("control")] != 0);
  fitted[AxisOf("control")] = 0;
  CHECK(fits());
  return fitted;
}

}  // namespace lanelight::test

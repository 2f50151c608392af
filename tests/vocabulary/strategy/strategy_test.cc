// The text form of strategies: every choice, presets, errors with a place and the nearest
// name.
#include "src/vocabulary/strategy/strategy.h"

#include <catch2/catch.hpp>
#include <set>

#include "src/scene/parse/parse.h"
#include "tests/support/input_error.h"

namespace lanelight {
namespace {

using Catch::Matchers::Contains;

const SourceLocation kWhere = {std::make_shared<const std::string>("--strategy"), 0, 0};

Strategy Parse(const std::string& text, Strategy strategy = {}) {
  ApplyStrategy(text, kWhere, strategy);
  return strategy;
}

std::string ErrorOf(const std::string& text) {
  return InputErrorOf([&] { Parse(text); });
}

}  // namespace

TEST_CASE("every listed choice can be set and round-trips", "[strategy]") {
  std::set<std::string> seen;
  for (const ChoiceInfo& c : AllChoices()) {
    const std::string text = std::string(c.axis) + "=" + c.name;
    INFO(text);
    CHECK(seen.insert(text).second);
    CHECK(std::string(c.meaning).size() > 10);
    CHECK(std::string(c.formula).size() > 0);
    const Strategy strategy = Parse(text);
    CHECK_THAT(ToText(strategy), Contains(text));
    CHECK(Parse(ToText(strategy), Parse("paper-uniform")) == strategy);
  }
  CHECK(seen.size() == 39);
}

TEST_CASE("arguments are parsed and kept in the text form", "[strategy]") {
  for (const char* text :
       {"directions=mis:balance", "c=0.5", "control=regression,c=-1",
        "roulette=constant:0.4:3", "roulette=throughput:0.1", "roulette=throughput:0:1",
        "roulette=throughput:0:2:4", "roulette=throughput:0:3:0.5"}) {
    INFO(text);
    Strategy expected = Parse(text);
    if (expected.control == Control::kNone) expected.coefficient.reset();
    CHECK(Parse(ToText(expected), Parse("paper-roulette")) == expected);
  }
  CHECK(Parse("roulette=constant:0.4:3").termination == 0.4);
  CHECK(Parse("roulette=constant:0.4:3").First() == 3);
  CHECK(Parse("roulette=constant").First() == 1);
  CHECK(Parse("roulette=throughput").First() == 2);
  CHECK(Parse("roulette=throughput").Floor() == 0);
  CHECK_FALSE(Parse("c=0.5,c=optimal").coefficient.has_value());
}

TEST_CASE("the renderer's strategy is a preset", "[strategy]") {
  CHECK(Parse("default", Parse("paper-uniform")) == Strategy{});
  CHECK(Parse("default,reuse=block", Parse("paper-uniform")) == Parse("reuse=block"));
}

TEST_CASE("each preset changes one thing of paper-plain, and can be refined",
          "[strategy]") {
  const Strategy plain = Parse("paper-plain");
  CHECK(plain.sampler == SampleSequence::kIndependent);
  CHECK(plain.roulette == Roulette::kNone);
  for (const PresetInfo& preset : AllPresets()) {
    const Strategy s = Parse(preset.name);
    const int changed = (s.directions != plain.directions) +
                        (s.sampler != plain.sampler) + (s.pairs != plain.pairs) +
                        (s.control != plain.control) + (s.roulette != plain.roulette) +
                        (s.light_selection != plain.light_selection);
    INFO(preset.name);
    CHECK(changed == (preset.name == std::string("paper-plain") ? 0 : 1));
    Strategy refined = s;
    refined.sampler = SampleSequence::kHalton;
    CHECK(Parse(std::string(preset.name) + ",points=halton") == refined);
  }
}

TEST_CASE("unknown words are reported with valid ones", "[strategy]") {
  const std::pair<const char*, const char*> cases[] = {
      {"points=sobl", "did you mean \"sobol\"?"},
      {"point=sobol", "unknown key \"point\"; did you mean \"points\"?"},
      {"paper-roulete", "did you mean \"paper-roulette\"?"},
      {"points=sobol,paper-plain", "must come first"},
      {"points=sobol,", "empty item"},
      {",points=sobol", "empty item"},
      {"directions=bsdf:power", "takes no argument"},
      {"directions=mis:cubic", "\"power\", \"balance\""},
      {"pairs=none:all", "takes no argument"},
      {"roulette=constant:1", "is not a number from 0.001 to 0.999"},
      {"roulette=constant:x", "is not a number"},
      {"roulette=constant:0.5:1.5", "must be whole"},
      {"roulette=constant:0.5:1:2", "at most 2 arguments"},
      {"roulette=adjoint:3", "takes no argument"},
      {"roulette=throughput:0:1:1:1", "at most 3 arguments"},
      {"points=sobol:3", "\"sobol\" of points takes no argument"},
      {"decide=pilot:", "\"pilot\" of decide takes no argument"},
      {"c=best", "is not a number"},
      {"c=nan", "is not a number"},
      {"points=", "unknown value of points=: \"\""},
  };
  for (const auto& [text, message] : cases) {
    INFO(text);
    CHECK_THAT(ErrorOf(text), Contains(message));
    CHECK_THAT(ErrorOf(text), Contains("--strategy"));
  }
}

TEST_CASE("changes of a strategy are applied as they were read", "[strategy]") {
  Strategy strategy = Parse("points=halton,roulette=throughput:0.2:3:2,reuse=block:8");
  const StrategyChanges changes =
      ParseStrategy("points=stratified,roulette=constant", {});
  Apply(changes, strategy);
  CHECK(strategy == Parse("points=stratified,roulette=constant,reuse=block:8"));
  const Strategy before = strategy;
  Apply({}, strategy);
  CHECK(strategy == before);
  CHECK_THROWS_AS(ParseStrategy("points=stratified,pairs=twins", {}), InputError);
  // Nothing of a text that is not understood is applied.
  CHECK_THROWS_AS(ApplyStrategy("points=sobol,pairs=twins", {}, strategy), InputError);
  CHECK(strategy == before);
  Apply(ParseStrategy("paper-plain,points=stratified", {}), strategy);
  CHECK(strategy == Parse("paper-plain,points=stratified"));
  // Each axis has choices that say which one it is, and is told once in a text.
  const std::string text = ToText(Strategy{});
  for (const ChoiceInfo& choice : AllChoices()) {
    const std::string key = std::string(choice.axis) + "=";
    INFO(key << choice.name);
    CHECK(text.find(key) != text.npos);
    CHECK(ToText(Parse(key + choice.name)).find(key + choice.name) != text.npos);
  }
}

TEST_CASE("a scene file can say its strategy", "[strategy]") {
  const auto parse = [](const std::string& options) {
    return ParseSceneText(options + "\nWorldBegin\n", "s.pbrt", ".");
  };
  const SceneDescription scene = parse(
      "Integrator \"path\" \"string strategy\" \"directions=light,roulette=none\"\n"
      "Sampler \"halton\"");
  CHECK(scene.strategy.directions == Directions::kLight);
  CHECK(scene.strategy.roulette == Roulette::kNone);
  CHECK(scene.strategy.sampler == SampleSequence::kHalton);  // whatever the order
  CHECK(parse("Integrator \"path\" \"string lightsampler\" \"bvh\"")
            .strategy.light_selection == LightSelection::kTree);
  CHECK_THROWS_WITH(parse("Integrator \"path\"\n \"string strategy\" \"points=sobl\""),
                    Contains("s.pbrt:1:") && Contains("did you mean"));
  CHECK_THROWS_WITH(parse("Integrator \"path\" \"string lightsampler\" \"tree\""),
                    Contains("light sampler"));
}

}  // namespace lanelight

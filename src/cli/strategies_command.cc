// `lanelight strategies`: every choice that --strategy has.
#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>

#include "src/base/core/json_text.h"
#include "src/base/core/source_location.h"
#include "src/base/core/text_layout.h"
#include "src/cli/commands.h"
#include "src/cli/console.h"
#include "src/cli/exit_codes.h"
#include "src/vocabulary/strategy/strategy.h"
#include "src/vocabulary/strategy/strategy_text.h"

namespace lanelight {
namespace {

// Returns an indented text below the name of a choice.
std::string MeaningRow(const std::string& text) { return FactRow("", text, 5); }

std::string ChoicesText() {
  std::string text, axis;
  for (const ChoiceInfo& c : AllChoices()) {
    if (axis != c.axis) {
      axis = c.axis;
      text += fmt::format("{}{}=\n", text.empty() ? "" : "\n", axis);
    }
    text += fmt::format("  {}{}\n", c.name, c.arguments) + MeaningRow(c.meaning) +
            MeaningRow(c.formula);
    if (*c.source != '\0') text += MeaningRow(fmt::format("[{}]", c.source));
  }
  return text + "\nc=\n  optimal|NUMBER\n" +
         MeaningRow(
             "coefficient of the control variate: estimated per pixel and channel "
             "(default), or given") +
         MeaningRow(
             "F = f - c (h - E[h]); the paper's equation 7 writes f + c (h - E[h]), so "
             "its c = 1 is c=-1 here");
}

std::string PresetsText() {
  std::string text = "\n" +
                     Wrapped(
                         "presets, each one change from paper-plain; refine them by "
                         "adding ,key=value",
                         ReadersColumns()) +
                     "\n";
  for (const PresetInfo& p : AllPresets()) {
    text += FactRow(
        fmt::format("  {}", p.name),
        fmt::format("{}{}{}", p.meaning, *p.changes == '\0' ? "" : ": ", p.changes), 20);
  }
  Strategy plain;
  ApplyStrategy("paper-plain", {}, plain);
  return text + "\n" + FactRow("paper-plain", ToText(plain), 12) +
         FactRow("default", ToText(Strategy{}), 12);
}

}  // namespace

void AddStrategiesCommand(CLI::App& root, Command& chosen) {
  CLI::App* command = root.add_subcommand(
      "strategies", "List the choices of --strategy: meaning, formula, source");
  auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "Print JSON");
  command->footer(
      "\nExamples:\n"
      "  lanelight render scene.pbrt -o out.exr --strategy "
      "points=halton,roulette=none\n"
      "  lanelight render scene.pbrt -o out.exr --strategy paper-roulette,points=sobol");
  command->callback([json, &chosen] {
    chosen = [json] {
      Print(*json ? DumpJson(StrategiesJson(), 2) + "\n" : ChoicesText() + PresetsText());
      return kExitGood;
    };
  });
}

}  // namespace lanelight

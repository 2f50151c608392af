// `lanelight strategies`: every choice that --strategy has.
#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>

#include "src/cli/commands.h"
#include "src/cli/console.h"
#include "src/cli/exit_codes.h"
#include "src/core/json_text.h"
#include "src/strategy/strategies_json.h"
#include "src/strategy/strategy.h"

namespace lanelight {
namespace {

std::string ChoicesText() {
  std::string text, axis;
  for (const ChoiceInfo& c : AllChoices()) {
    if (axis != c.axis) {
      axis = c.axis;
      text += fmt::format("{}{}=\n", text.empty() ? "" : "\n", axis);
    }
    text += fmt::format("  {}{}\n      {}\n      {}\n", c.name, c.arguments, c.meaning,
                        c.formula);
    if (*c.source != '\0') text += fmt::format("      [{}]\n", c.source);
  }
  return text +
         "\nc=\n  optimal|NUMBER\n      coefficient of the control variate: estimated "
         "per "
         "pixel and channel (default), or given\n      F = f - c (h - E[h]); the paper's "
         "equation 7 writes f + c (h - E[h]), so its c = 1 is c=-1 here\n";
}

std::string PresetsText() {
  std::string text =
      "\npresets, each one change from paper-plain; refine them by adding "
      ",key=value\n";
  for (const PresetInfo& p : AllPresets()) {
    text += fmt::format("  {:<18} {}{}{}\n", p.name, p.meaning,
                        *p.changes == '\0' ? "" : ": ", p.changes);
  }
  Strategy plain;
  ApplyStrategy("paper-plain", {}, plain);
  return text + fmt::format("\npaper-plain  {}\ndefault      {}\n", ToText(plain),
                            ToText(Strategy{}));
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
      "points=cmj,roulette=luminance\n"
      "  lanelight render scene.pbrt -o out.exr --strategy paper-roulette,points=sobol");
  command->callback([json, &chosen] {
    chosen = [json] {
      Print(*json ? DumpJson(StrategiesJson(), 2) + "\n" : ChoicesText() + PresetsText());
      return kExitGood;
    };
  });
}

}  // namespace lanelight

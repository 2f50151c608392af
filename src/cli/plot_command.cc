// `lanelight plot FILE --figure NAME -o OUT`: a plot for a paper, without a browser.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "src/cli/commands.h"
#include "src/cli/console.h"
#include "src/cli/exit_codes.h"
#include "src/cli/svg_to_png.h"
#include "src/core/input_file.h"
#include "src/core/json_text.h"
#include "src/image/atomic_file.h"
#include "src/render/saving.h"
#include "src/report/plot_figures.h"

namespace lanelight {
namespace {

struct PlotCommandOptions {
  std::string file, figure, out, scene;
  bool all = false, list = false;
};

std::string EndingOf(const std::string& path) {
  return std::filesystem::path(path).extension().string();
}

void CheckPlotFlags(const PlotCommandOptions& options) {
  if (options.list) return;
  if (options.figure.empty()) {
    throw CLI::ValidationError("--figure", "is required; --list names what FILE has");
  }
  if (options.out.empty()) throw CLI::ValidationError("--output", "is required");
  const std::string ending = EndingOf(options.out);
  if (ending != ".svg" && ending != ".png" && ending != ".csv") {
    throw CLI::ValidationError("--output", "ends in .svg, .png or .csv");
  }
}

int RunPlot(const PlotCommandOptions& options) {
  CheckPlotFlags(options);
  const nlohmann::json json =
      FromJsonOf(options.file, [&] { return ParseJson(ReadWholeFile(options.file)); });
  if (options.list) {
    const std::vector<PlotChoice> choices = PlotsOf(json, options.file);
    std::size_t widest = 0;
    for (const PlotChoice& choice : choices) {
      widest = std::max(widest, choice.name.size());
    }
    for (const PlotChoice& choice : choices) {
      Print(fmt::format("{:<{}}  {}\n", choice.name, widest, choice.shows));
    }
    return kExitGood;
  }
  CheckOutputPaths({{options.out}}, {options.file});
  const Plot plot =
      MakePlot(json, options.file, options.figure, options.scene, options.all);
  const std::string ending = EndingOf(options.out);
  WriteFileAtomically(options.out, ending == ".csv"   ? PlotCsv(plot)
                                   : ending == ".svg" ? PlotSvg(plot)
                                                      : SvgToPng(PlotSvg(plot)));
  return kExitGood;
}

}  // namespace

void AddPlotCommand(CLI::App& root, Command& chosen) {
  CLI::App* command = root.add_subcommand(
      "plot", "Draw the numbers of a study, a sweep or a bench, for a paper");
  auto options = std::make_shared<PlotCommandOptions>();
  command
      ->add_option("FILE", options->file,
                   "study.json of `lanelight study`, sweep.json of `lanelight sweep`, or "
                   "what `lanelight bench --json` has written")
      ->required()
      ->type_name("");
  command
      ->add_option("--figure", options->figure,
                   "Write this plot, of those that --list names")
      ->type_name("NAME");
  command
      ->add_option(
          "-o,--output", options->out,
          "Write the plot: .svg, .png (needs rsvg-convert), or its numbers: .csv")
      ->type_name("FILE");
  command
      ->add_option("--scene", options->scene,
                   "Of several, by name; default: the only one")
      ->type_name("NAME");
  command->add_flag("--all", options->all,
                    "Draw all strategies, not the paper's or the leading eight");
  command->add_flag("--list", options->list, "Print which plots FILE has, and stop");
  command->footer(
      "\nExamples:\n"
      "  lanelight plot out/study.json --list\n"
      "  lanelight plot out/study.json --figure 8 -o fig8.svg\n"
      "  lanelight plot today.json --figure rate -o rate.csv");
  command->callback(
      [options, &chosen] { chosen = [options] { return RunPlot(*options); }; });
}

}  // namespace lanelight

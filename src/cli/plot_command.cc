// `lanelight plot FILE --figure NAME -o OUT`: a plot for a paper, without a browser.
#include <fmt/format.h>

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <vector>

#include "src/base/core/error.h"
#include "src/base/core/input_file.h"
#include "src/cli/commands.h"
#include "src/cli/options.h"
#include "src/measure/report/page.h"
#include "src/render/job/saving.h"

namespace lanelight {
namespace {

struct PlotCommandOptions {
  std::string file, figure, out, scene;
  bool all = false, list = false;
};

void CheckPlotFlags(const PlotCommandOptions& options) {
  if (options.list) return;
  if (options.figure.empty()) {
    throw CLI::ValidationError("--figure",
                               "is required; --list prints the plots that FILE has");
  }
  if (options.out.empty()) throw CLI::ValidationError("--output", "is required");
  const std::string ending = std::filesystem::path(options.out).extension();
  if (ending != ".svg" && ending != ".png" && ending != ".csv") {
    throw CLI::ValidationError("--output", "must end in .svg, .png or .csv");
  }
}

// Replaces this process by Python, which draws or says what is wrong.
int RunPlot(const PlotCommandOptions& options) {
  CheckPlotFlags(options);
  OpenInputFile(options.file);
  if (!options.list) CheckOutputPaths({{options.out}}, {options.file});
  setenv("PYTHONSAFEPATH", "1", 1);  // no modules of the working directory
  std::vector<std::string> words = {"python3",
                                    "-c",
                                    PlotScript(),
                                    options.file,
                                    options.list ? "" : options.figure,
                                    options.out,
                                    options.scene,
                                    options.all ? "all" : ""};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  execvp(arguments[0], arguments.data());
  throw InputError(
      fmt::format("cannot start the program 'python3', which draws plots: {}; install "
                  "python3-matplotlib (Debian)",
                  std::strerror(errno)));
}

}  // namespace

void AddPlotCommand(CLI::App& root, Command& chosen) {
  CLI::App* command = root.add_subcommand(
      "plot", "Draw the numbers of a study, a sweep or a bench, for a paper");
  auto options = std::make_shared<PlotCommandOptions>();
  AddOption(*command, "FILE", options->file,
            "study.json of `lanelight study`, sweep.json of `lanelight sweep`, or the "
            "JSON of `lanelight bench --json`")
      ->required();
  AddOption(*command, "--figure NAME", options->figure,
            "Write this plot, of those that --list names");
  AddOption(*command, "-o,--output FILE", options->out,
            "Write the plot: .svg or .png (needs matplotlib), or its numbers: .csv");
  AddOption(*command, "--scene NAME", options->scene,
            "Scene by name; default: the only scene of FILE");
  command->add_flag("--all", options->all,
                    "Draw all strategies; default: the paper's or the leading eight");
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

// `lanelight`: reads the command line and does what it says.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string_view>

#include "kernels/simd/target.h"
#include "src/base/core/check.h"
#include "src/base/core/error.h"
#include "src/base/core/suggest.h"
#include "src/base/core/version.h"
#include "src/cli/commands.h"
#include "src/cli/console.h"
#include "src/cli/exit_codes.h"
#include "src/render/job/memory.h"
#include "src/render/mpi/join_ranks.h"

namespace lanelight {
namespace {

constexpr const char* kDescription =
    "Lanelight renders pbrt-v4 scenes with a SIMD wavefront path tracer and estimates "
    "the\nerror of the image.";
constexpr const char* kFooter =
    "\nExamples:\n"
    "  lanelight render scenes/cornell-box.pbrt -o box.exr --png --spp 256\n"
    "  lanelight plan scenes/glass.pbrt\n"
    "  lanelight live scenes/cornell-box.pbrt\n"
    "  lanelight profile scenes/glass.pbrt --trace trace.json\n"
    "  lanelight bench\n"
    "  lanelight strategies\n"
    "  lanelight compare box.exr reference.exr --max-relmse 0.01\n"
    "  lanelight study scenes/cornell-box.pbrt --out box-study\n"
    "  lanelight sweep scenes/sweep.toml --out sweep\n"
    "  lanelight stress --out stress\n"
    "\nExit codes:\n"
    "  0  success\n"
    "  1  bad input\n"
    "  2  wrong flags\n"
    "  3  the render produced invalid samples\n"
    "  4  compare: the error exceeds --max-relmse, or a value is invalid\n"
    "  5  render: the target error was not reached\n"
    "  6  interrupted; can be resumed\n"
    "  7  stress: a case failed\n"
    "  8  render: the image differs from the scene file\n"
    "  9  bench: slower than the earlier run\n"
    "  10 bench: not comparable with the earlier run";

// CLI11 treats an unknown first word as an unexpected argument; naming the commands
// helps.
bool ReportUnknownCommand(const CLI::App& root, int argc, const char* const* argv) {
  if (argc < 2 || argv[1][0] == '-' || argv[1][0] == '\0') return false;
  return !CheckCommand(root, argv[1]);
}

// "did you mean --resolution?" for the first flag that no command knows.
void SuggestFlag(const CLI::App& root, int argc, const char* const* argv) {
  const auto commands = root.get_subcommands();
  if (commands.empty()) return;
  std::vector<std::string> known;
  for (const CLI::Option* option : commands.front()->get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  }
  for (int i = 2; i < argc; ++i) {
    std::string word = argv[i];
    word.resize(std::min(word.size(), word.find('=')));
    if (word.rfind("--", 0) != 0 || word.size() < 4) continue;
    if (std::find(known.begin(), known.end(), word) != known.end()) continue;
    const std::string nearest = NearestName(word, known);
    if (!nearest.empty()) PrintError("Did you mean " + nearest + "?");
    return;
  }
}

// What a command line that was not understood, or asked for help, comes to.
int ReportParse(const CLI::App& root, const CLI::ParseError& error, int argc,
                const char* const* argv) {
  const bool is_help = error.get_exit_code() == 0;  // --help, --version
  std::ostringstream out, err;
  const auto commands = root.get_subcommands();
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr && !commands.empty()) {
    // CLI11 would write the last word first.
    std::vector<std::string> words = commands.front()->remaining();
    std::reverse(words.begin(), words.end());
    root.exit(CLI::ExtrasError(words), out, err);
  } else {
    root.exit(error, out, err);
  }
  Print(out.str());
  if (is_help) return kExitGood;
  if (std::string text = err.str(); !text.empty()) {
    if (text.back() == '\n') text.pop_back();
    PrintError(text);
  }
  SuggestFlag(root, argc, argv);
  return kExitUsage;
}

void AddCommands(CLI::App& root, RankGroup& group, Command& chosen) {
  root.formatter(FittedHelp());  // which commands take over
  root.footer(kFooter);
  root.set_version_flag("--version", FullVersion());
  root.require_subcommand(1);
  AddRenderCommand(root, group, chosen);
  AddPlanCommand(root, chosen);
  AddLiveCommand(root, chosen);
  AddProfileCommand(root, chosen);
  AddBenchCommand(root, chosen);
  AddInfoCommand(root, chosen);
  AddStrategiesCommand(root, chosen);
  AddMergeCommand(root, chosen);
  AddCompareCommand(root, chosen);
  AddStudyCommand(root, chosen);
  AddSweepCommand(root, chosen);
  AddPlotCommand(root, chosen);
  AddStressCommand(root, chosen);
  AddCompletionCommand(root, chosen);
  AddHelpCommand(root);
}

// Parse returns this if there is a command to run, else the program's exit code.
constexpr int kNoExitCode = -1;

int Parse(CLI::App& root, int argc, char** argv) {
  if (argc < 2) {
    PrintError(root.help());
    return kExitUsage;
  }
  if (std::string_view(argv[1]) == kCompleteWord) {
    Print(Completions(root, {argv + 2, argv + argc}));
    return kExitGood;
  }
  if (ReportUnknownCommand(root, argc, argv)) return kExitUsage;
  try {
    root.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return ReportParse(root, error, argc, argv);
  }
  return kNoExitCode;
}

// Why a command has failed, by what it has thrown.
std::string FailureText(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const InputError& error) {
    return error.what();
  } catch (const RankFailure& error) {
    return error.what();
  } catch (const CheckFailure& error) {
    return std::string("internal error, please report: ") + error.what();
  } catch (const std::bad_alloc&) {
    return "error: " + OutOfMemoryText();
  } catch (const std::filesystem::filesystem_error& error) {
    return fmt::format("error: '{}': {}", error.path1().string(), error.code().message());
  } catch (const std::exception& error) {
    return WithPrefix(error);
  }
}

// Several ranks render; everything else is for a process alone.
bool ForRanks(const CLI::App& root, const RankGroup& group) {
  if (group.ranks() == 1) return true;
  const std::string name = root.get_subcommands().front()->get_name();
  if (name == "render") return true;
  PrintError(
      fmt::format("error: only `render` supports several ranks ({} here); run `lanelight "
                  "{}` without mpirun",
                  group.ranks(), name));
  return false;
}

// On the leader: which rank's number is another than its own; empty if none is.
std::string RanksThatDiffer(RankGroup& group, int number) {
  const std::vector<int> numbers = group.AllGather(number);
  for (int r = 1; group.is_leader() && r < group.ranks(); ++r) {
    if (numbers[static_cast<std::size_t>(r)] != number) return group.Name(r);
  }
  return "";
}

int Run(CLI::App& root, const Command& chosen, RankGroup& group, int argc, char** argv) {
  int exit_code = Parse(root, argc, argv);
  if (const std::string who = RanksThatDiffer(group, exit_code); !who.empty()) {
    PrintError("error: " + who +
               " rejects the command line that rank 0 accepts: check its files and its "
               "version of the program");
    return group.Fail(kExitUsage, "");
  }
  if (exit_code != kNoExitCode) {
    return group.Leave(FlushOutput() ? exit_code : static_cast<int>(kExitBadInput));
  }
  if (!ForRanks(root, group)) return group.Leave(kExitUsage);
  try {
    RequireTarget();
    exit_code = chosen();
  } catch (const CLI::ParseError& error) {  // a flag that only the command understands
    exit_code = ReportParse(root, error, argc, argv);
  } catch (...) {
    const std::string message = FailureText(std::current_exception());
    PrintError(message);
    FlushOutput();
    return group.Fail(kExitBadInput, message);
  }
  if (!FlushOutput()) exit_code = kExitBadInput;
  return group.Leave(exit_code);
}

}  // namespace
}  // namespace lanelight

int main(int argc, char** argv) {
  using namespace lanelight;
  // A reader that goes away must not kill a render: writes fail with EPIPE instead.
  std::signal(SIGPIPE, SIG_IGN);
  // Nor must a limit on the size of files (`ulimit -f`): they fail with EFBIG.
  std::signal(SIGXFSZ, SIG_IGN);
  const std::unique_ptr<RankGroup> group = JoinRanks(&argc, &argv);
  if (!group->is_leader()) SilenceConsole();
  CLI::App root(kDescription, "lanelight");
  Command chosen;
  AddCommands(root, *group, chosen);
  return Run(root, chosen, *group, argc, argv);
}

// The subcommands, one file each. Every Add...Command declares the flags of its
// subcommand and a callback. The callback checks the flags and stores the work in
// `chosen`, which returns an exit code and throws InputError for bad input.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "src/base/core/rank_group.h"

namespace lanelight {

using Command = std::function<int()>;

/// `group`: the ranks that render; must outlive the command.
void AddRenderCommand(CLI::App& root, RankGroup& group, Command& chosen);
void AddPlanCommand(CLI::App& root, Command& chosen);
void AddLiveCommand(CLI::App& root, Command& chosen);
void AddProfileCommand(CLI::App& root, Command& chosen);
void AddBenchCommand(CLI::App& root, Command& chosen);
void AddInfoCommand(CLI::App& root, Command& chosen);
void AddStrategiesCommand(CLI::App& root, Command& chosen);
void AddMergeCommand(CLI::App& root, Command& chosen);
void AddCompareCommand(CLI::App& root, Command& chosen);
void AddStudyCommand(CLI::App& root, Command& chosen);
void AddSweepCommand(CLI::App& root, Command& chosen);
void AddPlotCommand(CLI::App& root, Command& chosen);
void AddStressCommand(CLI::App& root, Command& chosen);
void AddCompletionCommand(CLI::App& root, Command& chosen);
/// Added last, since it lists the other commands. Runs while the command line is parsed.
void AddHelpCommand(CLI::App& root);
/// Returns a formatter whose help fits the terminal.
std::shared_ptr<CLI::FormatterBase> FittedHelp();

/// Returns whether `word` is a command; if not, prints an error that lists all commands.
bool CheckCommand(const CLI::App& root, const std::string& word);

/// First word of a command line that shell completion sends.
inline constexpr const char* kCompleteWord = "__complete";

/// Returns a line for each word that the last of `words` may become: the word, a
/// tabulator, and its meaning. Or one of the lines ":files", ":files.pbrt" (files of this
/// kind, and folders) or ":folders", which shells complete themselves.
std::string Completions(const CLI::App& root, std::vector<std::string> words);

}  // namespace lanelight

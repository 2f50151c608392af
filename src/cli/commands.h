// The subcommands, one file each. Every Add...Command declares the flags of its
// subcommand and a callback that checks them and stores in `chosen` what is to be done,
// which returns an exit code and throws InputError for bad input.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "src/base/core/rank_group.h"

namespace lanelight {

using Command = std::function<int()>;

/// `group`: who renders; it must outlive the command.
void AddRenderCommand(CLI::App& root, RankGroup& group, Command& chosen);
void AddAdviseCommand(CLI::App& root, Command& chosen);
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
/// The last one: it knows those that are there before it. It is done when it is parsed.
void AddHelpCommand(CLI::App& root);
/// Texts of help that fit the terminal.
std::shared_ptr<CLI::FormatterBase> FittedHelp();

/// Returns whether it is the name of a command; if not, an error is printed that names
/// them all.
bool CheckCommand(const CLI::App& root, const std::string& word);

}  // namespace lanelight

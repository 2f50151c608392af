// The subcommands, one file each. Every Add...Command declares the flags of its
// subcommand and a callback that runs it; a callback stores its result in `exit_code` and
// throws InputError for bad input.
#pragma once

#include <CLI/CLI.hpp>

namespace lanelight {

void AddRenderCommand(CLI::App& root, int& exit_code);
void AddAdviseCommand(CLI::App& root, int& exit_code);
void AddPlanCommand(CLI::App& root, int& exit_code);
void AddProfileCommand(CLI::App& root, int& exit_code);
void AddInfoCommand(CLI::App& root, int& exit_code);
void AddStrategiesCommand(CLI::App& root, int& exit_code);
void AddCompareCommand(CLI::App& root, int& exit_code);
void AddStudyCommand(CLI::App& root, int& exit_code);
void AddCompletionCommand(CLI::App& root, int& exit_code);

}  // namespace lanelight

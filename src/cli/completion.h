// Shell completion. The shells' scripts ask the program itself, `lanelight __complete
// WORD...`, what may stand for the last of these words: nothing here knows a flag by
// name.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace lanelight {

/// The first word of a command line that asks.
inline constexpr const char* kCompleteWord = "__complete";

/// A line for each word that the last of `words`, typed so far, may become: the word, a
/// tabulator, and what it means. Or one of the lines ":files", ":files.pbrt" (those that
/// end so, and folders) or ":folders", which shells look for themselves.
std::string Completions(const CLI::App& root, std::vector<std::string> words);

/// The script for a shell: to be sourced, or to be installed where the shell looks.
std::string CompletionScript(const std::string& shell);

}  // namespace lanelight

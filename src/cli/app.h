// The command line as a whole: parsing, help, errors to exit codes.
#pragma once

#include <string>
#include <vector>

namespace lanelight {

/// Runs the program; returns its exit code and never throws.
int RunCommandLine(int argc, const char* const* argv);

/// The entry of `known` nearest to `word` (edit distance of at most a third of its length
/// plus one), or the empty string.
std::string NearestName(const std::string& word, const std::vector<std::string>& known);

}  // namespace lanelight

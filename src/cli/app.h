// The command line as a whole: parsing, help, errors to exit codes.
#pragma once

namespace lanelight {

/// Runs the program; returns its exit code and never throws.
int RunCommandLine(int argc, const char* const* argv);

}  // namespace lanelight

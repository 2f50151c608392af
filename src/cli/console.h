// Standard output and error. A reader that has gone away (`lanelight info | head -1`) is
// not an error; a full disk behind standard output is.
#pragma once

#include <string>

namespace lanelight {

/// From here on nothing is printed: another rank does.
void SilenceConsole();

/// Writes text to standard output.
void Print(const std::string& text);
/// Writes a line to standard error.
void PrintError(const std::string& line);
/// The same for an error that ends nothing: "warning: " instead of "error: ".
void PrintWarning(const std::string& error);

/// Flushes standard output. False, with a message, if something could not be written for
/// another reason than a closed pipe.
bool FlushOutput();

}  // namespace lanelight

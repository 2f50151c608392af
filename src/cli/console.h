// Standard output and error: messages, widths and colours. A reader that has gone away
// (`lanelight info | head -1`) is not an error; a full disk behind standard output is.
#pragma once

#include <cstddef>
#include <string>

namespace lanelight {

/// Prints nothing from here on: another rank does.
void SilenceConsole();

/// Writes text to standard output.
void Print(const std::string& text);
/// Writes a line to standard error.
void PrintError(const std::string& line);
/// Writes an error that does not end the program: "warning: " instead of "error: ".
void PrintWarning(const std::string& error);

/// Flushes standard output. Returns false, after a message, if writing failed for another
/// reason than a closed pipe.
bool FlushOutput();

enum class Stream { kOutput, kError };

/// Returns the columns of texts for people: those of COLUMNS, else of the terminal behind
/// the stream, else 80; at least 20.
std::size_t TerminalColumns(Stream stream);

/// Returns whether the stream is a terminal that can move its cursor (TERM is not
/// "dumb").
bool IsTerminal(Stream stream);

enum class TextStyle { kBold, kDim, kRed, kYellow };

/// Returns the text in that ink where the stream is such a terminal and NO_COLOR
/// (no-color.org) is not set.
std::string Painted(TextStyle ink, const std::string& text, Stream stream);

/// Returns a row of a summary for standard output: a painted label, and wrapped text.
std::string SummaryRow(const std::string& label, const std::string& text);

/// Returns the columns of texts that programs read too: no limit if standard output is
/// piped and COLUMNS is not set, else TerminalColumns.
std::size_t ReadersColumns();

/// Returns a row of facts about a file or a list, wrapped at ReadersColumns.
inline constexpr std::size_t kFactLabel = 14;
std::string FactRow(const std::string& label, const std::string& text,
                    std::size_t label_columns = kFactLabel);

}  // namespace lanelight

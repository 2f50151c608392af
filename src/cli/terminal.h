// What the terminal can do: how wide it is, and whether it shows colours.
#pragma once

#include <cstddef>
#include <string>

namespace lanelight {

enum class Stream { kOutput, kError };

/// Columns that texts for people fit: what the environment's COLUMNS says, else the
/// terminal behind the stream, else 80. At least 20.
std::size_t TerminalColumns(Stream stream);

/// The stream is a terminal that can move its cursor (TERM is not "dumb").
bool IsTerminal(Stream stream);

enum class Ink { kBold, kDim, kRed, kYellow };

/// The text in that ink where the stream is such a terminal and the environment does not
/// ask for none (NO_COLOR, no-color.org); else as it is.
std::string Painted(Ink ink, const std::string& text, Stream stream);

/// A message whose word of kind, "error:", "warning:" or "note:", at its beginning or
/// behind its place, is painted for standard error.
std::string PaintedMessage(const std::string& line);

/// A row of a summary for standard output: its label painted, its text wrapped.
std::string SummaryRow(const std::string& label, const std::string& text);

/// For what programs read, too: no limit where standard output is piped on and COLUMNS
/// says nothing, else as TerminalColumns.
std::size_t ReadersColumns();

/// A row of facts about a file, or of a list, as long as ReadersColumns.
inline constexpr std::size_t kFactLabel = 14;
std::string FactRow(const std::string& label, const std::string& text,
                    std::size_t label_columns = kFactLabel);

}  // namespace lanelight

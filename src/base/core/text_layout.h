// Text that fits a width: paragraphs, rows with a label, and tables.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lanelight {

/// Columns of a terminal that a text in UTF-8 takes, letters of one column each.
std::size_t TextWidth(std::string_view text);

/// Breaks lines between words, and after commas, so that they fit `width` where words do;
/// lines after the first begin with `indent` spaces. Ends without a line break.
std::string Wrapped(std::string_view text, std::size_t width, std::size_t indent = 0);

/// "label      text": what does not fit goes on below the text, whose column is behind
/// `label_columns` and a space. Ends the line.
inline constexpr std::size_t kRowLabel = 10;
std::string LabelledRow(const std::string& label, const std::string& text,
                        std::size_t width, std::size_t label_columns = kRowLabel);

/// Layout of a table.
struct TableLayout {
  std::size_t width = 80;
  /// Columns to the left that name a row: flush left, while numbers are flush right, and
  /// repeated where the others do not fit beside each other.
  std::size_t keys = 1;
  /// Columns at the end that are words again.
  std::size_t words = 0;
};

/// Lines of cells, the first of them the header; all have as many cells as that. Where
/// they do not fit the width, columns go on in another table below.
std::string TextTable(const std::vector<std::vector<std::string>>& lines,
                      const TableLayout& layout);

/// "a", "a and b", "a, b and 3 more" for at most two names.
std::string ListText(const std::vector<std::string>& names, std::size_t max_names);

/// "850 ms", "12.3 s", "4 min 05 s", "2 h 07 min".
std::string DurationText(double seconds);

}  // namespace lanelight

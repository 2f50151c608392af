// Files of numbers: spectra and lenses.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace lanelight {

/// Returns the numbers of a text as pbrt-v4 reads them: blanks and line ends part them,
/// and so does one other character right after a number, as the comma of "400, 0.5". `#`
/// starts a comment. Throws InputError with `file`, line and column for anything else, as
/// a line of column names.
std::vector<double> ReadNumbers(std::string_view text,
                                std::shared_ptr<const std::string> file);

}  // namespace lanelight

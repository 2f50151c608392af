// `lanelight sweep` as a process, and what it says and writes.
#pragma once

#include <string>
#include <vector>

#include "tests/cli/process.h"

namespace lanelight::sweep_process {

/// Runs `lanelight sweep FILE --out OUT`, with more arguments behind.
ProcessResult Sweep(const std::string& file, const std::string& out,
                    std::vector<std::string> more = {},
                    const ProcessOptions& options = {});

/// "22 of 22 cells are done, 5 of them by this process": 5. -1 if it says nothing.
int RenderedBy(const ProcessResult& r);

/// Returns the content of a file.
std::string Contents(const std::string& path);
/// Replaces the first `from` in a file.
void Replace(const std::string& path, const std::string& from, const std::string& to);

/// The fields of a table, the head first.
std::vector<std::vector<std::string>> CsvRows(const std::string& path);
/// A table as text, without what clocks say.
std::string TableWithoutTimes(const std::string& path);

}  // namespace lanelight::sweep_process

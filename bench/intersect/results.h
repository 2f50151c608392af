// The figures as a table, CSV and JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/intersect/build.h"
#include "bench/intersect/compare.h"
#include "bench/intersect/threads.h"

namespace lanelight::bench {

void PrintSetHeader();
void PrintSet(const SetResult& result);

/// One row per ray set and entry of the peer; ratio columns are empty for entries that
/// were too slow to go on with (see Compare).
void WriteSetsCsv(const std::string& path, const std::string& target,
                  const std::vector<SetResult>& results);

nlohmann::json SetsJson(const std::vector<SetResult>& results);

/// Appends to the lists "builds" and "threads" of `out`.
void AddBuilds(const std::vector<BuildResult>& builds,
               const std::vector<ThreadsResult>& threads, nlohmann::json& out);

}  // namespace lanelight::bench

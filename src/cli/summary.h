// What `lanelight render` prints at the end.
#pragma once

#include <string>
#include <vector>

#include "src/render/merge.h"
#include "src/render/report.h"

namespace lanelight {

/// The same of states that were put together.
std::string MergeSummaryText(const RenderReport& report, const MergedRender& merged);

/// Output paths, speed, estimated error, health, times, and the cost of each stage.
std::string SummaryText(const RenderReport& report, const Job& job);

/// That the image is not what the scene file asks for, and why; empty if it is.
std::string DiffersRow(const std::vector<Note>& notes);

/// One row per stage: calls, items, lane occupancy, thread seconds, share, ns per item.
std::string StageTable(const RunResult& result);

/// "RMSE 0.0123 [0.0120, 0.0126], relative MSE ..." or why there is no estimate.
std::string ErrorText(const ErrorEstimate& error);

}  // namespace lanelight

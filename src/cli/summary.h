// What `lanelight render` prints at the end.
#pragma once

#include <string>
#include <vector>

#include "src/render/job/merge.h"
#include "src/render/job/report.h"
#include "src/scene/description/note.h"

namespace lanelight {

/// What of a summary is wanted.
struct SummaryChoice {
  bool verbose = false;    // times, machine and the cost of each stage too
  std::string checkpoint;  // the state to go on from; empty: none
};

/// Image, error, time, speed, and what a smaller error takes.
std::string SummaryText(const RenderReport& report, const Job& job,
                        const SummaryChoice& choice);

/// The same of states that were put together.
std::string MergeSummaryText(const RenderReport& report, const MergedRender& merged,
                             bool verbose);

/// That the image is not what the scene file asks for, and why, in one line; empty if it
/// is.
std::string DiffersRow(const std::vector<Note>& notes);

/// What paths carry, and why, if the scene was to decide.
std::string TransportText(const Job& job);

/// One row per stage: calls, items, lane occupancy, thread seconds, share, ns per item.
std::string StageTable(const RunResult& result);

}  // namespace lanelight

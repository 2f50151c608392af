// A run's stage calls for chrome://tracing and ui.perfetto.dev (the "Trace Event Format",
// JSON array form).
#pragma once

#include <string>

#include "src/render/run/run.h"

namespace lanelight {

/// One complete event ("X") per stage call and part of a task, times in microseconds
/// since the start of the run; one track per thread, named. Where events have been
/// dropped, an instant event at the end of the track says how many. About 120 bytes an
/// event. `process`: name of the process in the viewer.
std::string TraceText(const RunResult& result, const std::string& process);

/// Events that found no room, of all threads.
std::uint64_t DroppedEvents(const RunTrace& trace);

}  // namespace lanelight

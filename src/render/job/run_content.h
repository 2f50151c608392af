// A run at rest as the content of a state file, and what such a file says of a run.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "src/base/state/state_file.h"
#include "src/render/wave/run_state.h"

namespace lanelight {

/// Of all but the tiles and their window. `about`: what the report says beside what the
/// run has done. Refers to the films and to the tables of `run`.
StateContent ContentOf(const nlohmann::json& identity, nlohmann::json about, Films& films,
                       const RunRecord& run);

/// The way back; `report` is the file's. Throws nlohmann::json::exception where it is not
/// what ContentOf has written.
RunRecord ReadRecord(const StateFile& file, const nlohmann::json& report);

}  // namespace lanelight

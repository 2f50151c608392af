// Puts the states of parts of a render together, or those of renders with different
// seeds.
//
// Parts: each pixel's sums come from one file, as they are, so the whole has the bits of
// a render that was never cut, whatever the order of the files. Seeds: sums are added in
// the order of the seeds, once, so again the order of the files does not matter.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "src/base/core/machine_info.h"
#include "src/base/state/state_file.h"
#include "src/render/films/accumulator.h"
#include "src/render/run/run.h"
#include "src/render/wave/films.h"
#include "src/render/wave/run_state.h"

namespace lanelight {

/// A render as states tell of it.
struct MergedRender {
  nlohmann::json identity, head;  // see src/render/job/identity.h, HeadJson
  PixelRect window;
  std::vector<PixelRect> tiles;  // that are there
  std::unique_ptr<FilmAccumulator> film;
  std::unique_ptr<Films> films;  // film, and what belongs to it
  RunRecord run;
  std::vector<MachineInfo> machines;  // where parts were rendered
  std::uint64_t missing = 0;          // pixels of the window that no file has
  std::uint64_t least = 0, most = 0;  // samples per pixel
  std::vector<std::uint64_t> seeds;   // more than one: of different renders
};

/// Reads states, one after the other, into one film. Throws InputError for files that are
/// damaged, of different renders (naming each difference), or hold the same pixels of the
/// same render.
MergedRender MergeStates(const std::vector<std::string>& paths);

/// What a run of all that would have come to; without stages, which each machine had of
/// its own.
RunResult ResultOf(const MergedRender& merged);

/// Writes it as a state, to be merged further or gone on with. Not for several seeds.
void WriteMergedState(MergedRender& merged, const std::string& path);

}  // namespace lanelight

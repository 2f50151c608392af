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

/// A render as stored in states.
struct MergedRender {
  nlohmann::json identity, head;  // see src/render/job/identity.h, HeadJson
  PixelRect window;
  std::vector<PixelRect> tiles;  // that are there
  std::unique_ptr<FilmAccumulator> film;
  std::unique_ptr<Films> films;  // film, and what belongs to it
  RunRecord run;
  std::vector<MachineInfo> machines;       // where parts were rendered
  std::uint64_t missing = 0;               // pixels of the window that no file has
  std::uint64_t minimum = 0, maximum = 0;  // samples per pixel
  std::vector<std::uint64_t> seeds;        // more than one: of different renders
};

/// Reads states, one after the other, into one film. Throws InputError for files that are
/// damaged, belong to different renders (naming each difference), or hold the same pixels
/// of the same render.
MergedRender MergeStates(const std::vector<std::string>& paths);

/// Returns the result of a run of all parts; without stages, which differ between
/// machines.
RunResult ResultOf(const MergedRender& merged);

/// Writes the merged state, which can be resumed or merged again. Not for several seeds.
void WriteMergedState(MergedRender& merged, const std::string& path);

/// Adds a render of a further seed, larger than those that are in `sum`. Throws
/// InputError unless both are whole, all their pixels have as many samples as any other
/// of the same render, and these are whole turns of the replicates.
void AddSeed(MergedRender& sum, MergedRender& more);

}  // namespace lanelight

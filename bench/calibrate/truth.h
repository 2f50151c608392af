// The references that renders are compared with.
#pragma once

#include <cstdint>
#include <string>

#include "src/base/core/source_location.h"
#include "src/measure/study/cell_store.h"
#include "src/measure/study/reference.h"
#include "src/render/job/job.h"

namespace lanelight::bench {

/// A strategy of --strategies, as a change of the default (kDefaultName: none). Throws
/// InputError.
Strategy ParseStrategy(const std::string& text);

/// The job with that strategy, which renders `spp` samples without a target or a time.
/// Throws InputError if the scene does not take the strategy.
Job JobWith(Job job, const std::string& strategy, std::uint64_t spp);

/// Renders a reference by Sobol' points with a seed of its own, with `spp` samples per
/// pixel, or, for 0, as many as fit into the seconds, at least kMinReferenceSpp.
Reference MakeReference(const Job& scene, std::uint64_t spp, double seconds);

/// Less the reference's own error.
Measurement TrueErrors(const FilmAccumulator& film, const Reference& reference);

}  // namespace lanelight::bench

// The film as an image file, with its variance and its history.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "src/base/image/exr.h"
#include "src/base/image/image.h"
#include "src/render/estimate/estimate.h"
#include "src/render/films/accumulator.h"
#include "src/render/job/job.h"

namespace lanelight {

/// Returns the exponent of the film's variances (src/base/image/image.h).
int VarianceExponent(const FilmAccumulator& film);
/// Adds the attribute with that exponent, unless it is 0.
void NoteVarianceUnit(const FilmAccumulator& film, ExrOptions& options);

/// Returns the channels of the output file: R, G, B; variance.R/G/B (of the pixel mean,
/// over 2 to the VarianceExponent; NaN below two observations); samples; with auxiliary
/// planes albedo.R/G/B, normal.X/Y/Z and depth.Z in units of the scene file (`scale`:
/// CompiledScene::scale); the buckets of a spectral film, by ChannelName().
std::vector<ExrPlane> FilmPlanes(const FilmAccumulator& film, double scale);

/// Counts of a run, changes of the strategy by its trial run (TrainingOutcome::changes),
/// and its error.
struct OutputRun {
  const RunCounts& counts;
  const std::string& changes;
  const ErrorEstimate& error;
};

/// Returns the data window and the attributes of docs/output.md for a render of this
/// identity (src/render/job/identity.h); `head` is of HeadJson.
ExrOptions OutputOptions(const nlohmann::json& identity, const nlohmann::json& head,
                         const OutputRun& run, const FilmAccumulator& film, bool half);

/// Returns R, G, B in linear sRGB for the PNG; `color_space` is that of the film
/// (src/base/image/color_spaces.h), whose white becomes white.
Image FilmImage(const FilmAccumulator& film, const std::string& color_space = "srgb");

}  // namespace lanelight

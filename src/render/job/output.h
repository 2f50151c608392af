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

/// Of the variances of the film (src/base/image/image.h).
int VarianceExponent(const FilmAccumulator& film);
/// Adds the attribute that tells of it, unless it is 0.
void NoteVarianceUnit(const FilmAccumulator& film, ExrOptions& options);

/// Channels of the output file: R, G, B; variance.R/G/B (of the pixel mean, over 2 to the
/// VarianceExponent; NaN where there are fewer than two observations); samples; with
/// auxiliary planes
/// albedo.R/G/B, normal.X/Y/Z and depth.Z in units of the scene file (`scale` is
/// CompiledScene::scale); of a film that keeps spectra its buckets, by ChannelName().
std::vector<ExrPlane> FilmPlanes(const FilmAccumulator& film, double scale);

/// What has been done: how much, what a pilot has changed of the strategy
/// (TrainingOutcome::changes), and the error that is left.
struct OutputRun {
  const RunCounts& counts;
  const std::string& changes;
  const ErrorEstimate& error;
};

/// Data window, and the attributes of docs/output.md of a render of this identity
/// (src/render/job/identity.h); `head` is of HeadJson.
ExrOptions OutputOptions(const nlohmann::json& identity, const nlohmann::json& head,
                         const OutputRun& run, const FilmAccumulator& film, bool half);

/// R, G, B of the film, which holds a color space (src/base/image/color_spaces.h), in
/// linear sRGB: for the PNG. The space's white is white there.
Image FilmImage(const FilmAccumulator& film, const std::string& color_space = "srgb");

}  // namespace lanelight

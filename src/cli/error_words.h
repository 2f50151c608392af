// Errors in words.
#pragma once

#include <string>

#include "src/render/estimate/estimate.h"

namespace lanelight {

/// The root of a relative MSE in percent, with three digits: "1.71 %".
std::string PercentOf(double relative_mse);

/// "1.71 % [1.69, 1.73]", or what it is at least and why no more is known; the error of
/// an image is the root of its relative MSE, in percent.
std::string PercentText(const ErrorEstimate& error);

/// The same without reasons, for a line that changes: "unknown", "at least 1.2 %".
std::string BriefPercentText(const ErrorEstimate& error);

/// "RMSE 0.0123 [0.0120, 0.0126], relative MSE ..." or why there is no estimate.
std::string ErrorText(const ErrorEstimate& error);

}  // namespace lanelight

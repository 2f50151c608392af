// Published coefficients of media, by the names that pbrt-v4 has for them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "src/base/core/error.h"
#include "src/base/core/vec.h"

namespace lanelight {

struct Coefficients {
  Rgb sigma_s, sigma_a;  // per millimetre; sigma_s is the reduced one
};

/// Null if `name` is none.
const Coefficients* FindCoefficients(const std::string& name);
std::vector<std::string> NamesOfCoefficients();

/// InputError at `where` with all names if `name` is none: unknown <kind> "<name>".
const Coefficients& CoefficientsOf(const std::string& name, const SourceLocation& where,
                                   std::string_view kind);

}  // namespace lanelight

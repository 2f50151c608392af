// What decides the pixels of a render, as JSON: two renders of the same identity have the
// same samples, however they are cut, stopped and resumed.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "src/render/job/job.h"

namespace lanelight {

/// Scene and its files, settings, strategy, seed, SIMD target and program. Not part of
/// it: how many samples, how long, and anything about threads, memory and trees over
/// shapes.
nlohmann::json IdentityOf(const Job& job);

/// Of a render whose film keeps spectra, from its identity.
SpectralBuckets BucketsOf(const nlohmann::json& identity);

/// One line for each thing that differs, "seed: the state has 1, this render 2"; empty if
/// nothing does. `had`, `has`: who the two are, e.g. "the state", "this render".
std::string IdentityDifferences(const nlohmann::json& a, const std::string& who_a,
                                const nlohmann::json& b, const std::string& who_b);

}  // namespace lanelight

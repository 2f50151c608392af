// Writes all inputs that determine the pixels of a render as JSON. Two renders of the
// same identity have the same samples for any split, stop and resume.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "src/render/job/job.h"

namespace lanelight {

/// Returns scene and its files, settings, strategy, seed, SIMD target and program; not
/// the number of samples, the time, threads, memory or BVH.
nlohmann::json IdentityOf(const Job& job);

/// Returns the buckets of a render whose film keeps spectra, from its identity.
SpectralBuckets BucketsOf(const nlohmann::json& identity);

/// Returns one line for each difference, "seed: the state has 1, this render 2"; empty if
/// there is none. `who_a`, `who_b`: names of the two, e.g. "the state", "this render".
std::string IdentityDifferences(const nlohmann::json& a, const std::string& who_a,
                                const nlohmann::json& b, const std::string& who_b);

}  // namespace lanelight

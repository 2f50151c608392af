// Sample points of each policy outside a render, for tests and benchmarks.
#pragma once

#include <cstdint>

#include "src/prepare/parameters.h"

namespace lanelight {

struct PointsQuery {
  Points points = Points::kSobol;
  std::uint32_t seed = 0, pixel = 0, group_size = 1, key = 0;
  std::uint32_t first_sample = 0, count = 0;
  std::uint32_t pixels = 1;  // from `pixel` on
};

/// Writes `count` points of each pixel: those of the first sample for all pixels, of the
/// second, and so on. u0 and u1 need room for a full vector more.
void ProbePoints(const PointsQuery& query, float* u0, float* u1);
/// The same with parameters made before: MakePointsParameters(query.points,
/// query.group_size).
void ProbePoints(const PointsQuery& query, const PointsParameters& parameters, float* u0,
                 float* u1);

/// The same for a scalar dimension.
void ProbeNumbers(const PointsQuery& query, float* u);

/// Group and index in it of samples [first, first + count), first + count <= 2^31. Both
/// need room for a full vector more.
void ProbeGroups(std::uint32_t group_size, std::uint32_t first, std::uint32_t count,
                 std::uint32_t* group, std::uint32_t* index);

/// Images of [0, count) in the permutation of `key`; out needs room for a full vector
/// more. `octaves`: that which keeps prefixes (PermuteOctaves).
void ProbePermutation(std::uint32_t count, std::uint32_t key, bool octaves,
                      std::uint32_t* out);

}  // namespace lanelight

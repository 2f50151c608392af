// Computes sample points of each policy outside a render, for tests.
#pragma once

#include <cstdint>

#include "kernels/simd/target.h"
#include "src/scene/prepare/parameters.h"

namespace lanelight {

struct SamplerQuery {
  SampleSequence sampler = SampleSequence::kSobol;
  std::uint32_t seed = 0, pixel = 0, key = 0;
  std::uint32_t first_sample = 0, count = 0;
  std::uint32_t pixels = 1;  // from `pixel` on
  std::uint32_t stride = 1;  // from one sample to the next; kReplicates: of one replicate
};

/// Writes `count` points of each pixel: those of the first sample for all pixels, of the
/// second, and so on. u0 and u1 need room for a full vector more.
void ProbeSampler(SimdTarget target, const SamplerQuery& query, float* u0, float* u1);

/// Writes the numbers of a scalar dimension.
void ProbeNumbers(SimdTarget target, const SamplerQuery& query, float* u);

/// Holds the results of ProbeGroups; all need room for a full vector more.
struct GroupColumns {
  std::uint32_t *group, *index, *unpaired;
};

/// Computes group and index in it of samples [first, first + count), first + count <=
/// 2^31, in groups of 2^group_shift. With antithetic sampling, also the samples whose
/// unpaired numbers they draw.
void ProbeGroups(SimdTarget target, std::uint32_t group_shift, std::uint32_t first,
                 std::uint32_t count, const GroupColumns& out);

/// Writes the images of [0, count), a power of two, in the permutation of `key`; out
/// needs room for a full vector more. `octaves` selects the permutation that keeps
/// prefixes (PermuteOctaves), for any count.
void ProbePermutation(SimdTarget target, std::uint32_t count, std::uint32_t key,
                      bool octaves, std::uint32_t* out);

}  // namespace lanelight

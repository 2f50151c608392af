// Loops that do nothing but reach the limits of the machine: what profiles are held
// against.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels/simd/target.h"

namespace lanelight {

/// Sum, modulo 2^32, of `count` words at `words`, read `passes` times in full vectors
/// with eight independent sums. `count` is a multiple of 1024, `words` aligned to 64
/// bytes.
std::uint32_t ReadSum(SimdTarget target, const std::uint32_t* words, std::size_t count,
                      std::size_t passes);

/// Operations of one iteration of MultiplyAdds: a multiply-add
/// of a lane counts as two.
int MultiplyAddsOperations(SimdTarget target);

/// Twelve independent vectors go `iterations` times through x <- x * factor + addend in
/// single precision, starting from 1 to 12; returns the sum of the lanes of all, divided
/// by their number. For |factor| < 1 that tends to addend / (1 - factor).
float MultiplyAdds(SimdTarget target, std::uint64_t iterations, float factor,
                   float addend);

}  // namespace lanelight

// Loops that reach the read bandwidth and the multiply-add peak of the machine, with
// which profiles are compared.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels/simd/target.h"

namespace lanelight {

/// Returns the sum, modulo 2^32, of `count` words at `words`, read `passes` times in full
/// vectors with eight independent sums. `count` is a multiple of 1024, `words` aligned to
/// 64 bytes.
std::uint32_t ReadSum(SimdTarget target, const std::uint32_t* words, std::size_t count,
                      std::size_t passes);

/// Returns the operations of one iteration of MultiplyAdds: two per lane and
/// multiply-add.
int MultiplyAddsOperations(SimdTarget target);

/// Twelve independent vectors go `iterations` times through x <- x * factor + addend in
/// single precision, starting from 1 to 12; returns the sum of the lanes of all, divided
/// by their number. For |factor| < 1 that tends to addend / (1 - factor).
float MultiplyAdds(SimdTarget target, std::uint64_t iterations, float factor,
                   float addend);

}  // namespace lanelight

// The stacks of the single rays of a stream (stream_rays-inl.h), as deep as the tree
// asks. On the stack of a thread they would need more than some systems give it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "src/accel/accel.h"
#include "src/core/untouched.h"

namespace lanelight {

/// Rays in flight: enough for independent work to the end of a stream; what is touched of
/// their columns and stacks stays in L2 (measured: 64 are 2 to 5 % slower, 512 equal).
inline constexpr std::uint32_t kStreamRays = 256;
/// Subtrees that a ray can put off in the packet phase.
inline constexpr std::uint32_t kDeferred = 32;

/// Words from the stack of one ray to that of the next; whole cache lines.
inline std::uint32_t RayStackStride(const Bvh& bvh) {
  // A vector may be stored past the top.
  const auto depth = static_cast<std::uint32_t>(bvh.depth) * (kBvhWidth - 1) + 2;
  return kDeferred + (depth + kLeafTriangles + 15) / 16 * 16;
}

/// This thread's memory for the stacks of kStreamRays rays through a tree: `words` per
/// ray, twice (references, then entry distances). It stays as it is until the thread asks
/// for more, which is the only time that memory is allocated.
inline std::uint32_t* ThreadRayStacks(std::uint32_t words) {
  thread_local UntouchedVector<std::uint32_t> stacks;
  const std::size_t needed = std::size_t{2} * kStreamRays * words;
  if (stacks.size() < needed) stacks.resize(needed);
  return stacks.data();
}

}  // namespace lanelight

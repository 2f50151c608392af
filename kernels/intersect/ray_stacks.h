// The memory of a stream of rays (stream-inl.h): its columns, and the stacks of its
// single rays, as deep as the tree asks. On the stack of a thread both would need more
// than some systems give it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "src/base/core/aligned.h"
#include "src/scene/geometry/accel.h"

namespace lanelight {

/// Rays in flight: enough for independent work to the end of a stream; what is touched of
/// their columns and stacks stays in L2 (measured: 64 are 2 to 5 % slower, 512 equal).
inline constexpr std::uint32_t kStreamRays = 256;
/// Subtrees that the rays of a packet can put off, and one.
inline constexpr std::uint32_t kDeferred = 64;

/// Words from the stack of one ray to that of the next, for trees of so many nodes on the
/// longest path; an odd number of cache lines, so that the stacks of a stream lie in all
/// sets of a cache.
inline std::uint32_t RayStackStride(int depth) {
  // The end below, the way back from an instance; a vector may be stored past the top.
  const auto words = static_cast<std::uint32_t>(depth) * (kBvhWidth - 1) + 3;
  const std::uint32_t lines = (kDeferred + words + kLeafTriangles + 15) / 16;
  return 16 * (lines | 1);
}

/// Returns the start of the second half of the stacks' memory. It is half a page off the
/// data that are read together with it: the processor first assumes that addresses with
/// equal last 12 bits alias.
inline std::size_t StackEntries(std::uint32_t words) {
  return std::size_t{kStreamRays} * words + 512;
}

/// This thread's memory for the stacks of kStreamRays rays through a tree: `words` per
/// ray (references), and from StackEntries(words) on as many (entry distances). It stays
/// as it is until the thread asks for more, which is the only time that memory is
/// allocated.
inline std::uint32_t* ThreadRayStacks(std::uint32_t words) {
  thread_local UntouchedVector<std::uint32_t> stacks;
  const std::size_t needed = StackEntries(words) + std::size_t{kStreamRays} * words;
  if (stacks.size() < needed) stacks.resize(needed);
  return stacks.data();
}

/// This thread's memory for a stream, of at least so many bytes, aligned to cache lines;
/// as ThreadRayStacks.
inline void* ThreadStream(std::size_t bytes) {
  thread_local UntouchedVector<std::byte> memory;
  if (memory.size() < bytes) memory.resize(bytes);
  return memory.data();
}

}  // namespace lanelight

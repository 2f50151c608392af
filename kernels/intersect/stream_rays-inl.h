// The rays of a stream (stream-inl.h) in columns; what single rays need at nodes and at
// leaves, by their place in the stream; and their stacks.
#ifndef LANELIGHT_INTERSECT_STREAM_RAYS_INL_H_
#define LANELIGHT_INTERSECT_STREAM_RAYS_INL_H_

#include <bit>
#include <cstddef>

#include "kernels/intersect/packet_leaf-inl.h"
#include "kernels/intersect/rays-inl.h"
#include "src/base/core/aligned.h"
#include "src/scene/geometry/accel.h"

LANELIGHT_BEGIN_KERNELS

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

/// The slab test of a single ray along one axis: as in SlabRay, but `lower` holds the
/// bits of the byte offset of the near planes in WideNode::bounds[axis].
struct AxisSlab {
  float rcp, near, far, lower;
};

/// Values for leaves: as in Shear, `from` as in Rays, rows as in LeafRay; the last two as
/// bits.
struct ShearedOrigin {
  float x, y, z, t_scale;
};
struct ShearedSlope {
  float x, y, z, from;
};
struct AxisRows {
  float row[3], unused;
};

/// Stores four numbers of each ray of a vector, ray by ray.
template <class Four>
LANELIGHT_INLINE void StoreFours(VF a, VF b, VF c, VF e, Four* to) {
  static_assert(sizeof(Four) == 4 * sizeof(float));
  hn::StoreInterleaved4(a, b, c, e, DF(), reinterpret_cast<float*>(to));
}

struct StreamRays {
  static constexpr uint32_t kLanes = hn::MaxLanes(DF());
  static constexpr uint32_t kRoom = kStreamRays + 2 * kLanes;

  uint32_t size = 0;
  HWY_ALIGN float o[3][kRoom], d[3][kRoom];
  // The hits so far; in a shadow query t is the end of the ray.
  float t[kRoom], b1[kRoom], b2[kRoom];
  int32_t prim[kRoom], found[kRoom];
  int32_t from[kRoom];  // as in Rays
  int32_t slot[kRoom];
  // The current space of a ray (kWorldInstance, kTopSpace, or an instance), and the
  // instance of its hit; used in scenes with instances only.
  uint32_t space[kRoom], inst[kRoom];
  // The position of single rays: the next node or leaf, and the stack [bottom, top] of
  // others, with kEmptyRef at the bottom. They are indices into `refs` and `entries`. The
  // packet phase defers subtrees downwards from StackEnd.
  int32_t next[kRoom];
  uint32_t top[kRoom], bottom[kRoom];
  // The data of steps of single rays, in fours, which are written and moved together.
  HWY_ALIGN AxisSlab slab[3][kRoom];
  uint32_t octant[kRoom];  // as in PacketSlabs
  ShearedOrigin shear_o[kRoom];
  ShearedSlope shear_s[kRoom];
  AxisRows axes[kRoom];
  const uint32_t stride;
  uint32_t* const refs;
  float* const entries;

  /// Makes a stream for BVHs of this depth.
  explicit StreamRays(int depth)
      : stride(RayStackStride(depth)),
        refs(ThreadRayStacks(stride)),
        entries(reinterpret_cast<float*>(refs + StackEntries(stride))) {}
  /// Returns the end of the part of a ray's stack that the packet phase fills.
  LANELIGHT_INLINE uint32_t StackEnd(uint32_t r) const { return r * stride + kDeferred; }
  LANELIGHT_INLINE bool HasRoom() const { return size + kLanes <= kStreamRays; }

  static LANELIGHT_INLINE V3 Load3(const float (&column)[3][kRoom], uint32_t at) {
    const DF df;
    return {hn::LoadU(df, column[0] + at), hn::LoadU(df, column[1] + at),
            hn::LoadU(df, column[2] + at)};
  }

  /// Returns a ray prepared for leaves.
  LANELIGHT_INLINE LeafRay AtLeaf(uint32_t r) const {
    const float* const row = axes[r].row;
    return {{shear_o[r].x, shear_o[r].y, shear_o[r].z},
            {shear_s[r].x, shear_s[r].y, shear_s[r].z},
            {Bits(row[0]), Bits(row[1]), Bits(row[2])},
            Bits(shear_s[r].from)};
  }

  /// Gives the hit of the ray at `from_ray` to that at `to`.
  LANELIGHT_INLINE void CopyHit(uint32_t from_ray, uint32_t to) {
    found[to] = 1;
    t[to] = t[from_ray];
    prim[to] = prim[from_ray];
    b1[to] = b1[from_ray];
    b2[to] = b2[from_ray];
  }

  /// Takes the first `count` rays of a vector; `prims` as in NoHits.
  LANELIGHT_INLINE void Add(const Rays& rays, VI slots, VI prims, uint32_t count) {
    const DI di;
    Store(rays, size);
    hn::StoreU(prims, di, prim + size);
    hn::StoreU(slots, di, slot + size);
    size += count;
  }

  LANELIGHT_INLINE void Store(const Rays& rays, uint32_t at) {
    const DF df;
    const VF v[6] = {rays.o.x, rays.o.y, rays.o.z, rays.d.x, rays.d.y, rays.d.z};
    for (int a = 0; a < 3; ++a) {
      hn::StoreU(v[a], df, o[a] + at);
      hn::StoreU(v[3 + a], df, d[a] + at);
    }
    hn::StoreU(rays.t_max, df, t + at);
    hn::StoreU(rays.from, DI(), from + at);
  }
  LANELIGHT_INLINE Rays Load(uint32_t at) const {
    return {Load3(o, at), Load3(d, at), hn::LoadU(DF(), t + at),
            hn::LoadU(DI(), from + at)};
  }

  /// Prepares a vector of rays at place `at` for the steps of single rays at nodes ...
  LANELIGHT_INLINE void SetSlabs(const PacketSlabs& slabs, uint32_t at) {
    for (int a = 0; a < 3; ++a) {
      constexpr int kUpper = kBvhWidth * sizeof(float);
      StoreFours(slabs.rcp[a], slabs.near[a], slabs.far[a],
                 BitsOf(slabs.OfNegative(a, kUpper)), slab[a] + at);
    }
    hn::StoreU(hn::BitCast(DU(), slabs.octant), DU(), octant + at);
  }

  /// ... and at leaves.
  LANELIGHT_INLINE void SetShear(const Shear<VF>& shear, const AxisOrder& order,
                                 VI starts, uint32_t at) {
    const auto row = [](int32_t axis)
                         HWY_ATTR { return BitsOf(hn::Set(DI(), axis * kLeafRow)); };
    const P3<VF> rows = order.Permute({row(0), row(1), row(2)});
    StoreFours(shear.o.x, shear.o.y, shear.o.z, shear.t_scale, shear_o + at);
    StoreFours(shear.s.x, shear.s.y, shear.s.z, BitsOf(starts), shear_s + at);
    StoreFours(rows.x, rows.y, rows.z, hn::Zero(DF()), axes + at);
  }

 private:
  static LANELIGHT_INLINE uint32_t Bits(float f) { return std::bit_cast<uint32_t>(f); }
  static LANELIGHT_INLINE VF BitsOf(VI v) { return hn::BitCast(DF(), v); }
};

LANELIGHT_END_KERNELS

#endif

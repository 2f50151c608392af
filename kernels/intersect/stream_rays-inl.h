// The rays of a stream (stream-inl.h) in columns: prepared for the slab test and for
// leaves once, then read by their place in the stream; and the stacks of single rays.
#if defined(LANELIGHT_INTERSECT_STREAM_RAYS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LANELIGHT_INTERSECT_STREAM_RAYS_INL_H_
#undef LANELIGHT_INTERSECT_STREAM_RAYS_INL_H_
#else
#define LANELIGHT_INTERSECT_STREAM_RAYS_INL_H_
#endif

#include "kernels/intersect/packet_leaf-inl.h"
#include "kernels/intersect/ray_stacks.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

struct StreamRays {
  static constexpr uint32_t kLanes = hn::MaxLanes(DF());
  static constexpr uint32_t kRoom = kStreamRays + 2 * kLanes;

  uint32_t size = 0;
  HWY_ALIGN float o[3][kRoom], d[3][kRoom];
  // As in SlabRay; `lower` are byte offsets of the near planes in WideNode::bounds[axis],
  // `octant` has bit a set if the direction is negative along axis a.
  float rcp[3][kRoom], near[3][kRoom], far[3][kRoom];
  uint32_t lower[3][kRoom], octant[kRoom];
  // As in Shear; `row` as in LeafRay.
  float shear_o[3][kRoom], shear_s[3][kRoom], abs_dz[kRoom], t_scale[kRoom];
  uint32_t row[3][kRoom];
  // The hits so far; in a shadow query t is the end of the ray.
  float t[kRoom], b1[kRoom], b2[kRoom];
  int32_t prim[kRoom], found[kRoom];
  uint32_t from[kRoom];  // as in Rays
  int32_t slot[kRoom];
  // With instances: where a ray is (kWorldInstance, kTopSpace, or the instance whose
  // space it is in), and where its hit is.
  uint32_t space[kRoom], inst[kRoom];
  // Where single rays are: the node or leaf, and the stack [bottom, top] of others, the
  // last one kEmptyRef at the bottom: places in `refs` and `entries`. The packet phase
  // puts subtrees off downwards from StackEnd.
  int32_t next[kRoom];
  uint32_t top[kRoom], bottom[kRoom];
  const uint32_t stride;
  uint32_t* const refs;
  float* const entries;

  /// For trees of so many nodes on the longest path.
  explicit StreamRays(int depth)
      : stride(RayStackStride(depth)),
        refs(ThreadRayStacks(stride)),
        entries(reinterpret_cast<float*>(refs + StackEntries(stride))) {}
  /// Where the part of a ray's stack ends that the packet phase fills.
  LANELIGHT_INLINE uint32_t StackEnd(uint32_t r) const { return r * stride + kDeferred; }
  LANELIGHT_INLINE bool HasRoom() const { return size + kLanes <= kStreamRays; }

  static LANELIGHT_INLINE V3 Load3(const float (&column)[3][kRoom], uint32_t at) {
    const DF df;
    return {hn::LoadU(df, column[0] + at), hn::LoadU(df, column[1] + at),
            hn::LoadU(df, column[2] + at)};
  }

  /// A ray as leaves see it.
  LANELIGHT_INLINE LeafRay AtLeaf(uint32_t r) const {
    return {{shear_o[0][r], shear_o[1][r], shear_o[2][r]},
            {shear_s[0][r], shear_s[1][r], shear_s[2][r]},
            {row[0][r], row[1][r], row[2][r]},
            from[r]};
  }

  /// Gives the hit of the ray at `from_ray` to that at `to`.
  LANELIGHT_INLINE void TakeHit(uint32_t from_ray, uint32_t to) {
    found[to] = 1;
    t[to] = t[from_ray];
    prim[to] = prim[from_ray];
    b1[to] = b1[from_ray];
    b2[to] = b2[from_ray];
  }

  /// Takes the first `count` rays of a vector; `prims` as in NoHits.
  LANELIGHT_INLINE void Add(const Bvh& bvh, const Rays& rays, VI slots, VI prims,
                            uint32_t count) {
    const DF df;
    const DI di;
    SetSlabs(rays.o, rays.d, Splat(bvh.slack), Splat(bvh.margin), size);
    SetShear(rays, Splat(bvh.reach), size);
    hn::StoreU(rays.t_max, df, t + size);
    hn::StoreU(hn::Zero(df), df, b1 + size);
    hn::StoreU(hn::Zero(df), df, b2 + size);
    hn::StoreU(prims, di, prim + size);
    hn::StoreU(slots, di, slot + size);
    StoreInt(rays.from, from + size);
    size += count;
  }

  /// Prepares a vector of rays at place `at` for the slab test of a tree, with the
  /// arithmetic of MakeSlabRay.
  LANELIGHT_INLINE void SetSlabs(V3 ray_o, V3 ray_d, VF slack, VF margin, uint32_t at) {
    const DF df;
    const DI di;
    const VF ro[3] = {ray_o.x, ray_o.y, ray_o.z};
    const VF rd[3] = {ray_d.x, ray_d.y, ray_d.z};
    const VF largest = hn::Max(hn::Abs(ro[0]), hn::Max(hn::Abs(ro[1]), hn::Abs(ro[2])));
    const VF delta = hn::MulAdd(slack, largest, margin);
    const VF least = Splat(0x1p-80f);
    VI negatives = hn::Zero(di);
    for (int a = 0; a < 3; ++a) {
      const MF tiny = hn::Lt(hn::Abs(rd[a]), least);
      const VF da = hn::IfThenElse(tiny, hn::CopySign(least, rd[a]), rd[a]);
      const VF r = hn::Div(Splat(1.0f), da);
      const VF c = hn::Neg(hn::Mul(ro[a], r)), grow = hn::Mul(delta, hn::Abs(r));
      hn::StoreU(ro[a], df, o[a] + at);
      hn::StoreU(rd[a], df, d[a] + at);
      hn::StoreU(r, df, rcp[a] + at);
      hn::StoreU(hn::Sub(c, grow), df, near[a] + at);
      hn::StoreU(hn::Add(c, grow), df, far[a] + at);
      const VI negative = hn::ShiftRight<31>(hn::BitCast(di, rd[a]));
      constexpr int32_t kUpper = kBvhWidth * sizeof(float);
      StoreInt(hn::And(negative, hn::Set(di, kUpper)), lower[a] + at);
      negatives = hn::Or(negatives, hn::And(negative, hn::Set(di, 1 << a)));
    }
    StoreInt(negatives, octant + at);
  }

  /// Prepares them for leaves whose vertices have coordinates up to `reach`.
  LANELIGHT_INLINE void SetShear(const Rays& rays, VF reach, uint32_t at) {
    const DF df;
    const DI di;
    const AxisOrder order(rays.d);
    const Shear<VF> shear = MakeShear(order, rays, reach);
    const VF so[3] = {shear.o.x, shear.o.y, shear.o.z};
    const VF ss[3] = {shear.s.x, shear.s.y, shear.s.z};
    for (int a = 0; a < 3; ++a) {
      hn::StoreU(so[a], df, shear_o[a] + at);
      hn::StoreU(ss[a], df, shear_s[a] + at);
    }
    hn::StoreU(shear.abs_dz, df, abs_dz + at);
    hn::StoreU(shear.t_scale, df, t_scale + at);
    const auto y = hn::RebindMask(di, order.y), z = hn::RebindMask(di, order.z);
    const VI offset[3] = {hn::Zero(di), hn::Set(di, kLeafRow), hn::Set(di, 2 * kLeafRow)};
    StoreInt(hn::IfThenElse(z, offset[0], hn::IfThenElse(y, offset[2], offset[1])),
             row[0] + at);
    StoreInt(hn::IfThenElse(z, offset[1], hn::IfThenElse(y, offset[0], offset[2])),
             row[1] + at);
    StoreInt(hn::IfThenElse(z, offset[2], hn::IfThenElse(y, offset[1], offset[0])),
             row[2] + at);
  }

 private:
  static LANELIGHT_INLINE void StoreInt(VI v, uint32_t* to) {
    hn::StoreU(v, DI(), reinterpret_cast<int32_t*>(to));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#endif

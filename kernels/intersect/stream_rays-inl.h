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
  // Where single rays are: the node or leaf, and the stack [bottom, top] of others, the
  // last one kEmptyRef at the bottom. Stacks are `stride` apart.
  int32_t next[kRoom];
  uint32_t top[kRoom], bottom[kRoom];
  const uint32_t stride;
  uint32_t* const refs;
  float* const entries;

  explicit StreamRays(const Bvh& bvh)
      : stride(RayStackStride(bvh)),
        refs(ThreadRayStacks(stride)),
        entries(reinterpret_cast<float*>(refs + std::size_t{kStreamRays} * stride)) {}
  LANELIGHT_INLINE uint32_t* Refs(uint32_t r) { return refs + std::size_t{r} * stride; }
  LANELIGHT_INLINE float* Entries(uint32_t r) {
    return entries + std::size_t{r} * stride;
  }
  LANELIGHT_INLINE bool HasRoom() const { return size + kLanes <= kStreamRays; }

  /// Takes the first `count` rays of a vector; `prims` as in NoHits.
  LANELIGHT_INLINE void Add(const Bvh& bvh, const Rays& rays, VI slots, VI prims,
                            uint32_t count) {
    const DF df;
    const DI di;
    AddSlabs(bvh, rays);
    AddShear(bvh, rays);
    hn::StoreU(rays.t_max, df, t + size);
    hn::StoreU(hn::Zero(df), df, b1 + size);
    hn::StoreU(hn::Zero(df), df, b2 + size);
    hn::StoreU(prims, di, prim + size);
    hn::StoreU(slots, di, slot + size);
    StoreInt(rays.from, from + size);
    size += count;
  }

 private:
  static LANELIGHT_INLINE void StoreInt(VI v, uint32_t* to) {
    hn::StoreU(v, DI(), reinterpret_cast<int32_t*>(to));
  }

  // The arithmetic of MakeSlabRay.
  LANELIGHT_INLINE void AddSlabs(const Bvh& bvh, const Rays& rays) {
    const DF df;
    const DI di;
    const VF ro[3] = {rays.o.x, rays.o.y, rays.o.z};
    const VF rd[3] = {rays.d.x, rays.d.y, rays.d.z};
    const VF largest = hn::Max(hn::Abs(ro[0]), hn::Max(hn::Abs(ro[1]), hn::Abs(ro[2])));
    const VF delta = hn::MulAdd(Splat(bvh.slack), largest, Splat(bvh.margin));
    const VF least = Splat(0x1p-80f);
    VI negatives = hn::Zero(di);
    for (int a = 0; a < 3; ++a) {
      const MF tiny = hn::Lt(hn::Abs(rd[a]), least);
      const VF da = hn::IfThenElse(tiny, hn::CopySign(least, rd[a]), rd[a]);
      const VF r = hn::Div(Splat(1.0f), da);
      const VF c = hn::Neg(hn::Mul(ro[a], r)), grow = hn::Mul(delta, hn::Abs(r));
      hn::StoreU(ro[a], df, o[a] + size);
      hn::StoreU(rd[a], df, d[a] + size);
      hn::StoreU(r, df, rcp[a] + size);
      hn::StoreU(hn::Sub(c, grow), df, near[a] + size);
      hn::StoreU(hn::Add(c, grow), df, far[a] + size);
      const VI negative = hn::ShiftRight<31>(hn::BitCast(di, rd[a]));
      constexpr int32_t kUpper = kBvhWidth * sizeof(float);
      StoreInt(hn::And(negative, hn::Set(di, kUpper)), lower[a] + size);
      negatives = hn::Or(negatives, hn::And(negative, hn::Set(di, 1 << a)));
    }
    StoreInt(negatives, octant + size);
  }

  LANELIGHT_INLINE void AddShear(const Bvh& bvh, const Rays& rays) {
    const DF df;
    const DI di;
    const AxisOrder order(rays.d);
    const Shear<VF> shear = MakeShear(order, rays, bvh.reach);
    const VF so[3] = {shear.o.x, shear.o.y, shear.o.z};
    const VF ss[3] = {shear.s.x, shear.s.y, shear.s.z};
    for (int a = 0; a < 3; ++a) {
      hn::StoreU(so[a], df, shear_o[a] + size);
      hn::StoreU(ss[a], df, shear_s[a] + size);
    }
    hn::StoreU(shear.abs_dz, df, abs_dz + size);
    hn::StoreU(shear.t_scale, df, t_scale + size);
    const auto y = hn::RebindMask(di, order.y), z = hn::RebindMask(di, order.z);
    const VI at[3] = {hn::Zero(di), hn::Set(di, kLeafRow), hn::Set(di, 2 * kLeafRow)};
    StoreInt(hn::IfThenElse(z, at[0], hn::IfThenElse(y, at[2], at[1])), row[0] + size);
    StoreInt(hn::IfThenElse(z, at[1], hn::IfThenElse(y, at[0], at[2])), row[1] + size);
    StoreInt(hn::IfThenElse(z, at[2], hn::IfThenElse(y, at[1], at[0])), row[2] + size);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#endif

// One ray against the triangles of a leaf: the lanes are triangles.
#if defined(LANELIGHT_INTERSECT_LEAF_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LANELIGHT_INTERSECT_LEAF_INL_H_
#undef LANELIGHT_INTERSECT_LEAF_INL_H_
#else
#define LANELIGHT_INTERSECT_LEAF_INL_H_
#endif

#include <algorithm>
#include <bit>
#include <cfloat>

#include "hwy/highway.h"
#include "kernels/intersect/triangle-inl.h"
#include "src/accel/accel.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Lanes of a leaf test: all 16 triangles at once, or a part on narrower targets.
using DL = hn::CappedTag<float, kLeafTriangles>;
using VL = hn::Vec<DL>;
using ML = hn::Mask<DL>;
HWY_INLINE constexpr int LeafLanes() { return static_cast<int>(hn::MaxLanes(DL())); }

/// The vertices of a leaf along one permuted axis, sheared, looked up by corner.
class LeafAxis {
 public:
  HWY_INLINE void Set(int part, VL v) { part_[part] = v; }
#if HWY_MAX_BYTES >= 64
  HWY_INLINE VL At(hn::Vec<hn::RebindToUnsigned<DL>> index) const {
    return hn::TableLookupLanes(part_[0], hn::IndicesFromVec(DL(), index));
  }
#elif HWY_MAX_BYTES >= 32
  HWY_INLINE VL At(hn::Vec<hn::RebindToUnsigned<DL>> index) const {
    const DL d;
    const hn::RebindToUnsigned<DL> du;
    const auto seven = hn::Set(du, 7);
    const auto lanes = hn::IndicesFromVec(d, hn::And(index, seven));
    const auto upper = hn::RebindMask(d, hn::Gt(index, seven));
    return hn::IfThenElse(upper, hn::TableLookupLanes(part_[1], lanes),
                          hn::TableLookupLanes(part_[0], lanes));
  }
#else
  HWY_INLINE VL At(hn::Vec<hn::RebindToUnsigned<DL>> index) const {
    return hn::GatherIndex(DL(), reinterpret_cast<const float*>(part_),
                           hn::BitCast(hn::RebindToSigned<DL>(), index));
  }
#endif

 private:
  VL part_[kLeafVertices / hn::MaxLanes(DL())];
};

/// Whether the plane of a triangle lies ahead of a ray, exactly. For rays that start on
/// or near a leaf.
inline HWY_NOINLINE bool LaneIsAhead(const TriangleLeaf& leaf, int lane, const float o[3],
                                     const float d[3]) {
  float p[3][3];
  for (int k = 0; k < 3; ++k) {
    const int corner = leaf.corner[k][lane];
    for (int a = 0; a < 3; ++a) p[k][a] = leaf.vertex[a][corner];
  }
  double n[3];
  ExactNormal(p[0], p[1], p[2], n);
  return PlaneIsAhead(o, d, n, p[0]);
}

/// Weights of a leaf's triangles seen from a ray, and its vertices' distances: what is
/// needed to finish the few lanes that the ray passes through.
struct LeafWeights {
  HWY_ALIGN float u[kLeafTriangles], v[kLeafTriangles], w[kLeafTriangles];
  HWY_ALIGN float z[kLeafVertices];
};

/// A ray as leaves see it: its shear, the byte offsets of the rows of
/// TriangleLeaf::vertex in its permuted order of axes, and Rays::from.
struct LeafRay {
  P3<float> o, s;
  uint32_t axis[3];
  uint32_t from;
};

HWY_INLINE const float* LeafRow(const TriangleLeaf& leaf, uint32_t offset) {
  return reinterpret_cast<const float*>(reinterpret_cast<const char*>(leaf.vertex) +
                                        offset);
}

/// Tests kRays rays, each against a leaf of its own, without a branch: bits[j] are the
/// triangles that the line of ray j passes through, but for the one that it starts on.
/// The rays take each step together, so that the processor's window always holds as many
/// independent chains.
template <int kRays>
HWY_INLINE void TestLeaves(const LeafRay (&ray)[kRays], const TriangleLeaf* const* leaf,
                           LeafWeights* const* to, uint32_t (&bits)[kRays]) {
  const DL d;
  const hn::RebindToUnsigned<DL> du;
  const hn::Rebind<uint8_t, DL> d8;
  const VL zero = hn::Zero(d);
  LeafAxis x[kRays], y[kRays];
  for (int i = 0; i < kLeafVertices; i += LeafLanes()) {
    VL z[kRays];
    for (int j = 0; j < kRays; ++j) {
      z[j] = hn::Sub(hn::Load(d, LeafRow(*leaf[j], ray[j].axis[2]) + i),
                     hn::Set(d, ray[j].o.z));
      hn::Store(hn::Mul(hn::Set(d, ray[j].s.z), z[j]), d, to[j]->z + i);
    }
    for (int j = 0; j < kRays; ++j) {
      const VL dx = hn::Sub(hn::Load(d, LeafRow(*leaf[j], ray[j].axis[0]) + i),
                            hn::Set(d, ray[j].o.x));
      const VL dy = hn::Sub(hn::Load(d, LeafRow(*leaf[j], ray[j].axis[1]) + i),
                            hn::Set(d, ray[j].o.y));
      x[j].Set(i / LeafLanes(), hn::NegMulAdd(hn::Set(d, ray[j].s.x), z[j], dx));
      y[j].Set(i / LeafLanes(), hn::NegMulAdd(hn::Set(d, ray[j].s.y), z[j], dy));
    }
  }
  for (int j = 0; j < kRays; ++j) bits[j] = 0;
  for (int i = 0; i < kLeafTriangles; i += LeafLanes()) {
    VL ax[kRays], ay[kRays], bx[kRays], by[kRays], cx[kRays], cy[kRays];
    for (int j = 0; j < kRays; ++j) {
      const auto a = hn::PromoteTo(du, hn::LoadU(d8, leaf[j]->corner[0] + i));
      const auto b = hn::PromoteTo(du, hn::LoadU(d8, leaf[j]->corner[1] + i));
      const auto c = hn::PromoteTo(du, hn::LoadU(d8, leaf[j]->corner[2] + i));
      ax[j] = x[j].At(a), ay[j] = y[j].At(a);
      bx[j] = x[j].At(b), by[j] = y[j].At(b);
      cx[j] = x[j].At(c), cy[j] = y[j].At(c);
    }
    VL u[kRays], v[kRays], w[kRays];
    for (int j = 0; j < kRays; ++j) {
      u[j] = EdgeFunction(d, cx[j], by[j], cy[j], bx[j]);
      v[j] = EdgeFunction(d, ax[j], cy[j], ay[j], cx[j]);
      w[j] = EdgeFunction(d, bx[j], ay[j], by[j], ax[j]);
    }
    for (int j = 0; j < kRays; ++j) {
      hn::Store(u[j], d, to[j]->u + i);
      hn::Store(v[j], d, to[j]->v + i);
      hn::Store(w[j], d, to[j]->w + i);
      const ML pass = hn::Or(hn::Ge(Min3(u[j], v[j], w[j]), zero),
                             hn::Le(Max3(u[j], v[j], w[j]), zero));
      const auto other =
          hn::Ne(hn::LoadU(du, leaf[j]->prim + i), hn::Set(du, ray[j].from));
      bits[j] |= MaskBits(d, hn::And(pass, hn::RebindMask(d, other))) << i;
    }
  }
  for (int j = 0; j < kRays; ++j) bits[j] &= leaf[j]->used;
}

/// Finishes one lane of a leaf for which TestLeaves set the bit. `t` is valid if the
/// result is true: the triangle lies ahead. The arithmetic is that of FinishHits.
template <class CopyRay>
HWY_INLINE bool FinishLane(const TriangleLeaf& leaf, const LeafWeights& weights, int lane,
                           CopyRay&& copy_ray, float& t, float& det) {
  const hn::CappedTag<float, 1> d1;
  const float u = weights.u[lane], v = weights.v[lane], w = weights.w[lane];
  const float az = weights.z[leaf.corner[0][lane]], bz = weights.z[leaf.corner[1][lane]],
              cz = weights.z[leaf.corner[2][lane]];
  det = u + (v + w);
  if (det == 0) return false;
  const float t_det =
      hn::GetLane(hn::MulAdd(hn::Set(d1, u), hn::Set(d1, az),
                             hn::MulAdd(hn::Set(d1, v), hn::Set(d1, bz),
                                        hn::Mul(hn::Set(d1, w), hn::Set(d1, cz)))));
  t = t_det / det;
  const bool straddles = std::min({az, bz, cz}) <= 0 && std::max({az, bz, cz}) >= 0;
  if (!straddles) return t > 0;
  t = std::max(t, FLT_MIN);
  float o[3], dir[3];
  copy_ray(o, dir);
  return LaneIsAhead(leaf, lane, o, dir);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#endif

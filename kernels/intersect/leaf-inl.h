// One ray against the triangles of a leaf: the lanes are triangles.
#ifndef LANELIGHT_INTERSECT_LEAF_INL_H_
#define LANELIGHT_INTERSECT_LEAF_INL_H_

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>
#include <type_traits>

#include "kernels/intersect/triangle-inl.h"
#include "src/scene/geometry/accel.h"

LANELIGHT_BEGIN_KERNELS

/// Lanes of a leaf test: all triangles at once, or a part on narrower targets.
template <class Leaf>
using LeafTag = hn::CappedTag<float, Leaf::kLanes>;
template <class Leaf>
using LeafVec = hn::Vec<LeafTag<Leaf>>;
template <class Leaf>
LANELIGHT_INLINE constexpr int LeafLanes() {
  return static_cast<int>(hn::MaxLanes(LeafTag<Leaf>()));
}

/// A number for each vertex of a leaf, set in parts, and looked up for the corners of
/// triangles [i, i + LeafLanes).
template <class Leaf>
class LeafColumn;

template <>
class LeafColumn<SeparateLeaf> {
 public:
  using V = LeafVec<SeparateLeaf>;
  LANELIGHT_INLINE void Set(int part, V v) { part_[part] = v; }
  LANELIGHT_INLINE V Corner(const SeparateLeaf&, int k, int i) const {
    return part_[(SeparateLeaf::kLanes * k + i) / LeafLanes<SeparateLeaf>()];
  }

 private:
  V part_[SeparateLeaf::kVertexLanes / hn::MaxLanes(LeafTag<SeparateLeaf>())];
};

template <int n>
class LeafColumn<SharedLeaf<n>> {
 public:
  using D = LeafTag<SharedLeaf<n>>;
  using V = hn::Vec<D>;
  LANELIGHT_INLINE void Set(int part, V v) { part_[part] = v; }
  LANELIGHT_INLINE V Corner(const SharedLeaf<n>& leaf, int k, int i) const {
    const hn::RebindToUnsigned<D> du;
    const hn::Rebind<uint8_t, D> d8;
    return At(hn::PromoteTo(du, hn::LoadU(d8, leaf.corner[k] + i)));
  }

 private:
  using Index = hn::Vec<hn::RebindToUnsigned<D>>;
  static constexpr int kParts = n / hn::MaxLanes(D());

  LANELIGHT_INLINE V At(Index index) const {
    const D d;
    const hn::RebindToUnsigned<D> du;
    if constexpr (kParts == 1) {
      return hn::TableLookupLanes(part_[0], hn::IndicesFromVec(d, index));
    } else if constexpr (hn::MaxLanes(D()) >= 8) {
      const auto seven = hn::Set(du, 7);
      const auto lanes = hn::IndicesFromVec(d, hn::And(index, seven));
      const auto upper = hn::RebindMask(d, hn::Gt(index, seven));
      return hn::IfThenElse(upper, hn::TableLookupLanes(part_[1], lanes),
                            hn::TableLookupLanes(part_[0], lanes));
    } else {
      return hn::GatherIndex(d, reinterpret_cast<const float*>(part_),
                             hn::BitCast(hn::RebindToSigned<D>(), index));
    }
  }

  V part_[kParts];
};

/// Lanes that hold a triangle, as bits.
template <int n>
LANELIGHT_INLINE uint32_t UsedLanes(const SharedLeaf<n>& leaf) {
  return leaf.used;
}
LANELIGHT_INLINE uint32_t UsedLanes(const SeparateLeaf& leaf) {
  const hn::RebindToUnsigned<LeafTag<SeparateLeaf>> du;
  uint32_t bits = 0;
  for (int i = 0; i < SeparateLeaf::kLanes; i += LeafLanes<SeparateLeaf>()) {
    const auto used = hn::Ne(hn::LoadU(du, leaf.prim + i), hn::Set(du, kEmptyRef));
    bits |= MaskBits(du, used) << i;
  }
  return bits;
}

/// Returns whether the plane of a triangle lies ahead of a ray, exactly. For rays that
/// start on or near a leaf.
template <class Leaf>
HWY_NOINLINE bool LaneIsAhead(const Leaf& leaf, uint32_t lane, const float o[3],
                              const float d[3]) {
  float p[3][3];
  for (int k = 0; k < 3; ++k) {
    const uint32_t corner = leaf.VertexOf(k, lane);
    for (int a = 0; a < 3; ++a) p[k][a] = leaf.vertex[a][corner];
  }
  double n[3];
  ExactNormal(p[0], p[1], p[2], n);
  return PlaneIsAhead(o, d, n, p[0]);
}

/// Edge functions of a leaf's triangles, from which the few lanes that a ray passes
/// through are finished.
struct KeptEdges {
  HWY_ALIGN float u[kLeafTriangles], v[kLeafTriangles], w[kLeafTriangles];

  template <class D, class V = hn::Vec<D>>
  LANELIGHT_INLINE void KeepEdges(D d, std::size_t i, V of_u, V of_v, V of_w) {
    hn::Store(of_u, d, u + i);
    hn::Store(of_v, d, v + i);
    hn::Store(of_w, d, w + i);
  }
  template <class D, class V = hn::Vec<D>>
  LANELIGHT_INLINE void KeepVertices(D, std::size_t, V, V) {}

  /// Returns the edge functions of a triangle with the corners a, b and c.
  LANELIGHT_INLINE P3<float> Of(uint32_t lane, uint32_t, uint32_t, uint32_t) const {
    return {u[lane], v[lane], w[lane]};
  }
};

/// Positions of the vertices across the ray, for targets on which edge functions are
/// expensive.
struct KeptVertices {
  HWY_ALIGN float x[SeparateLeaf::kVertexLanes], y[SeparateLeaf::kVertexLanes];

  template <class D, class V = hn::Vec<D>>
  LANELIGHT_INLINE void KeepEdges(D, std::size_t, V, V, V) {}
  template <class D, class V = hn::Vec<D>>
  LANELIGHT_INLINE void KeepVertices(D d, std::size_t i, V of_x, V of_y) {
    hn::Store(of_x, d, x + i);
    hn::Store(of_y, d, y + i);
  }

  LANELIGHT_INLINE P3<float> Of(uint32_t, uint32_t a, uint32_t b, uint32_t c) const {
    const auto edge = [&](uint32_t i, uint32_t j) HWY_ATTR {
      return static_cast<float>(double{x[i]} * y[j] - double{y[i]} * x[j]);
    };
    return {edge(c, b), edge(a, c), edge(b, a)};
  }
};

/// The one of the two that suits the target, and the vertices' distances.
struct LeafWeights : std::conditional_t<kCheapEdges, KeptEdges, KeptVertices> {
  HWY_ALIGN float z[SeparateLeaf::kVertexLanes];
};

/// A ray as leaves see it: its shear, its permuted order of axes as byte offsets of
/// TriangleLeaf::vertex[axis], and Rays::from.
struct LeafRay {
  P3<float> o, s;
  uint32_t row[3];
  uint32_t from;
};
inline constexpr uint32_t kLeafRow = sizeof(TriangleLeaf::vertex[0]);

/// The coordinates along an axis, as in LeafRay::row, of a leaf's vertices.
template <class Leaf>
LANELIGHT_INLINE const float* LeafRow(const Leaf& leaf, uint32_t row) {
  if constexpr (std::is_same_v<Leaf, SeparateLeaf>) {
    static_assert(2 * sizeof(SeparateLeaf::vertex[0]) == 3 * kLeafRow);
    row += row / 2;
  } else {
    row /= kLeafRow / sizeof(leaf.vertex[0]);
  }
  return reinterpret_cast<const float*>(reinterpret_cast<const char*>(leaf.vertex) + row);
}

/// Tests kRays rays, each against a leaf of its own, without a branch: bits[j] are the
/// triangles that the line of ray j passes through, but for the one that it starts on.
/// The rays take each step together, so that the processor's window always holds as many
/// independent chains.
template <int kRays, class Leaf>
LANELIGHT_INLINE void TestLeaves(const LeafRay (&ray)[kRays],
                                 const Leaf* const (&leaf)[kRays],
                                 LeafWeights* const (&to)[kRays],
                                 uint32_t (&bits)[kRays]) {
  using V = LeafVec<Leaf>;
  const LeafTag<Leaf> d;
  const hn::RebindToUnsigned<LeafTag<Leaf>> du;
  constexpr int kStep = LeafLanes<Leaf>();
  const V zero = hn::Zero(d);
  LeafColumn<Leaf> x[kRays], y[kRays];
  for (int i = 0; i < Leaf::kVertexLanes; i += kStep) {
    V z[kRays];
    for (int j = 0; j < kRays; ++j) {
      z[j] = hn::Sub(hn::Load(d, LeafRow(*leaf[j], ray[j].row[2]) + i),
                     hn::Set(d, ray[j].o.z));
      hn::Store(hn::Mul(hn::Set(d, ray[j].s.z), z[j]), d, to[j]->z + i);
    }
    for (int j = 0; j < kRays; ++j) {
      const V dx = hn::Sub(hn::Load(d, LeafRow(*leaf[j], ray[j].row[0]) + i),
                           hn::Set(d, ray[j].o.x));
      const V dy = hn::Sub(hn::Load(d, LeafRow(*leaf[j], ray[j].row[1]) + i),
                           hn::Set(d, ray[j].o.y));
      const V across[2] = {hn::NegMulAdd(hn::Set(d, ray[j].s.x), z[j], dx),
                           hn::NegMulAdd(hn::Set(d, ray[j].s.y), z[j], dy)};
      x[j].Set(i / kStep, across[0]);
      y[j].Set(i / kStep, across[1]);
      to[j]->KeepVertices(d, i, across[0], across[1]);
    }
  }
  for (int j = 0; j < kRays; ++j) bits[j] = 0;
  for (int i = 0; i < Leaf::kLanes; i += kStep) {
    V ax[kRays], ay[kRays], bx[kRays], by[kRays], cx[kRays], cy[kRays];
    for (int j = 0; j < kRays; ++j) {
      ax[j] = x[j].Corner(*leaf[j], 0, i), ay[j] = y[j].Corner(*leaf[j], 0, i);
      bx[j] = x[j].Corner(*leaf[j], 1, i), by[j] = y[j].Corner(*leaf[j], 1, i);
      cx[j] = x[j].Corner(*leaf[j], 2, i), cy[j] = y[j].Corner(*leaf[j], 2, i);
    }
    V u[kRays], v[kRays], w[kRays];
    hn::Mask<LeafTag<Leaf>> pass[kRays];
    if constexpr (kCheapEdges) {
      for (int j = 0; j < kRays; ++j) {
        u[j] = EdgeFunction(d, cx[j], by[j], cy[j], bx[j]);
        v[j] = EdgeFunction(d, ax[j], cy[j], ay[j], cx[j]);
        w[j] = EdgeFunction(d, bx[j], ay[j], by[j], ax[j]);
      }
    }
    for (int j = 0; j < kRays; ++j) {
      if constexpr (kCheapEdges) {
        to[j]->KeepEdges(d, i, u[j], v[j], w[j]);
        pass[j] = hn::Or(hn::Ge(Min3(u[j], v[j], w[j]), zero),
                         hn::Le(Max3(u[j], v[j], w[j]), zero));
      } else {
        pass[j] = MayPassEdges(d, P3<V>{ax[j], ay[j], zero}, P3<V>{bx[j], by[j], zero},
                               P3<V>{cx[j], cy[j], zero});
      }
      const auto other =
          hn::Ne(hn::LoadU(du, leaf[j]->prim + i), hn::Set(du, ray[j].from));
      bits[j] |= MaskBits(d, hn::And(pass[j], hn::RebindMask(d, other))) << i;
    }
  }
  if constexpr (!std::is_same_v<Leaf, SeparateLeaf>) {
    for (int j = 0; j < kRays; ++j) bits[j] &= leaf[j]->used;
  }
}

/// The addresses of a scene's leaves.
class LeafPlaces {
 public:
  explicit LeafPlaces(const Accel& accel)
      : base_(reinterpret_cast<const char*>(accel.triangle_blocks.data())),
        unit_(LeafUnit(accel.leaf_triangles)) {}

  LANELIGHT_INLINE const char* At(uint32_t ref) const {
    return base_ + (ref & kRefIndex) * unit_;
  }
  template <class Leaf>
  LANELIGHT_INLINE const Leaf& Of(uint32_t ref) const {
    // Leaves that share vertices are as far apart as they are large: a constant.
    constexpr bool kShared = !std::is_same_v<Leaf, SeparateLeaf>;
    const std::size_t unit = kShared ? sizeof(Leaf) : unit_;
    return *reinterpret_cast<const Leaf*>(base_ + (ref & kRefIndex) * unit);
  }
  /// Returns whether leaves that share vertices are SmallLeaf.
  LANELIGHT_INLINE bool small() const { return unit_ == sizeof(SmallLeaf); }

 private:
  const char* base_;
  std::size_t unit_;
};

/// A hit of a lane: distance, and the weights of the second and third corner times `det`:
/// most hits are not the nearest, and need no quotients.
struct LaneHit {
  float t, v, w, det;
};

/// Finishes one lane of a leaf for which TestLeaves set the bit; true if the triangle
/// lies ahead. The arithmetic is that of FinishHits. `t_scale` as in Shear.
template <class Leaf, class CopyRay>
LANELIGHT_INLINE bool FinishLane(const Leaf& leaf, const LeafWeights& weights,
                                 uint32_t lane, float t_scale, CopyRay&& copy_ray,
                                 LaneHit& hit) {
  const hn::CappedTag<float, 1> d1;
  const uint32_t a = leaf.VertexOf(0, lane), b = leaf.VertexOf(1, lane),
                 c = leaf.VertexOf(2, lane);
  const auto [u, v, w] = weights.Of(lane, a, b, c);
  if constexpr (!kCheapEdges) {
    if (std::min({u, v, w}) < 0 && std::max({u, v, w}) > 0) return false;
  }
  const float az = weights.z[a], bz = weights.z[b], cz = weights.z[c];
  const float det = u + (v + w);
  if (HWY_UNLIKELY(det == 0)) return false;
  const float t_det =
      hn::GetLane(hn::MulAdd(hn::Set(d1, u), hn::Set(d1, az),
                             hn::MulAdd(hn::Set(d1, v), hn::Set(d1, bz),
                                        hn::Mul(hn::Set(d1, w), hn::Set(d1, cz)))));
  hit = {t_det / det, v, w, det};
  // Large triangles often straddle and small ones often have a small t det: few do both.
  // No logical and: its branches could not be predicted.
  const bool behind = std::min({az, bz, cz}) <= 0, before = std::max({az, bz, cz}) >= 0,
             small = std::abs(t_det) <= t_scale;
  if (HWY_LIKELY(!(behind & before & small))) return hit.t > 0;
  hit.t = std::max(hit.t, FLT_MIN);
  float o[3], dir[3];
  copy_ray(o, dir);
  return LaneIsAhead(leaf, lane, o, dir);
}

LANELIGHT_END_KERNELS

#endif

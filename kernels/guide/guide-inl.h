// A guide (src/prepare/guide.h) as lanes read it: the cell of a point, the density of a
// direction in a cell, a direction of that density.
//   cell        one step of the tree per level of the deepest lane: permutations in the
//               upper levels, then two gathers each
//   density     the square of the direction (a root), then a gather
//   direction   four gathers of the bounds of rows, four of those of a row's squares: two
//               cache lines
#ifndef LANELIGHT_GUIDE_GUIDE_INL_H_
#define LANELIGHT_GUIDE_GUIDE_INL_H_

#include <algorithm>

#include "kernels/guide/square-inl.h"
#include "kernels/simd/records-inl.h"
#include "src/prepare/guide.h"

LANELIGHT_BEGIN_KERNELS

/// Component `axis` of (p, n); any for other axes.
LANELIGHT_INLINE VF GuideCoordinate(VI axis, V3 p, V3 n) {
  const auto is = [&](int32_t a) HWY_ATTR {
    return hn::RebindMask(DF(), hn::Eq(axis, hn::Set(DI(), a)));
  };
  const VF position = hn::IfThenElse(is(0), p.x, hn::IfThenElse(is(1), p.y, p.z));
  const VF normal = hn::IfThenElse(is(3), n.x, hn::IfThenElse(is(4), n.y, n.z));
  return hn::IfThenElse(hn::RebindMask(DF(), hn::Gt(axis, hn::Set(DI(), 2))), normal,
                        position);
}

/// The first nodes of a tree, in registers: permutations cost a quarter of gathers, and
/// training numbers nodes by levels.
struct GuideTop {
  static constexpr std::size_t kNodes = hn::MaxLanes(DF());
  HWY_ALIGN float at[kNodes] = {};
  HWY_ALIGN int32_t link[kNodes] = {};

  explicit GuideTop(const Guide& guide) {
    for (std::size_t i = 0; i < std::min(kNodes, guide.nodes.size()); ++i) {
      at[i] = guide.nodes[i].at;
      link[i] = static_cast<int32_t>(guide.nodes[i].next);
    }
  }
  LANELIGHT_INLINE bool Has(VI node) const {
    return hn::AllTrue(DI(), hn::Lt(node, hn::Set(DI(), int32_t{kNodes})));
  }
  LANELIGHT_INLINE VF At(VI node) const {
    const DF df;
    return hn::TableLookupLanes(hn::Load(df, at), hn::IndicesFromVec(df, node));
  }
  LANELIGHT_INLINE VI Link(VI node) const {
    const DI di;
    return hn::TableLookupLanes(hn::Load(di, link), hn::IndicesFromVec(di, node));
  }
};

/// A step of the descent from nodes that hold `at` and `link`.
struct GuideStep {
  VI target;  // first child, or cell
  VI next;    // node; the same at a leaf
  MF inner;   // not at a leaf yet

  LANELIGHT_INLINE GuideStep(VI node, VF at, VI link, V3 p, V3 n) {
    const DI di;
    const VI leaf = hn::Set(di, static_cast<int32_t>(Guide::Node::kLeaf));
    const VI axis = hn::And(link, leaf);
    target = hn::BitCast(di, hn::ShiftRight<3>(hn::BitCast(DU(), link)));
    const auto goes_on = hn::Ne(axis, leaf);
    inner = hn::RebindMask(DF(), goes_on);
    // Of a NaN, false: the second child.
    const MF first = hn::Lt(GuideCoordinate(axis, p, n), at);
    const VI second = hn::IfThenZeroElse(hn::RebindMask(di, first), hn::Set(di, 1));
    next = hn::IfThenElse(goes_on, hn::Add(target, second), node);
  }
};

/// Cell of surface points p with normal n on the side that the paths see.
LANELIGHT_INLINE VI GuideCell(const Guide& guide, const GuideTop& top, V3 p, V3 n) {
  VI node = hn::Zero(DI());
  while (top.Has(node)) {
    const GuideStep step(node, top.At(node), top.Link(node), p, n);
    if (hn::AllFalse(DF(), step.inner)) return step.target;
    node = step.next;
  }
  for (;;) {
    const RecordWords record(guide.nodes.data(), node);
    const VF at = record.F(offsetof(Guide::Node, at));
    const GuideStep step(node, at, record.I(offsetof(Guide::Node, next)), p, n);
    if (hn::AllFalse(DF(), step.inner)) return step.target;
    node = step.next;
  }
}

/// pdf_sa of a direction in the frame of the path's surface (GuideFrame), unit; 0 below
/// the surface, and of what is no direction that of some other.
LANELIGHT_INLINE VF GuidePdf(const Guide& guide, VI cell, V3 local) {
  const DI di;
  const GuideSquarePoint at = ToGuideSquare(local);
  const VF half = Splat(kGuideGrid / 2.0f);
  const VI zero = hn::Zero(di), last = hn::Set(di, kGuideGrid - 1);
  const auto square = [&](VF x) HWY_ATTR {
    const VI i = hn::ConvertTo(di, hn::MulAdd(x, half, half));
    return hn::Min(hn::Max(i, zero), last);
  };
  static_assert(kGuideGrid == 16);
  const VI row = hn::Add(hn::ShiftLeft<4>(cell), square(at.b));
  const VI index = hn::Add(hn::ShiftLeft<4>(row), square(at.a));
  return hn::Mul(Gather(guide.density.data(), index), at.to_solid_angle);
}

/// One of the kGuideGrid bounds from `first` on that u in [0, 1) is below, with how far u
/// is from the one before.
struct GuideBound {
  VI index;   // 0 to kGuideGrid - 1
  VF inside;  // in [0, 1]
  VF mass;    // between the two

  LANELIGHT_INLINE GuideBound(const float* cumulative, VI first, VF u) {
    const DI di;
    index = hn::Zero(di);
    VF low = hn::Zero(DF()), high = Splat(1.0f);
    for (int32_t step = kGuideGrid / 2; step > 0; step /= 2) {
      const VF bound = Gather(cumulative + step - 1, hn::Add(first, index));
      const MF beyond = hn::Le(bound, u);
      low = hn::IfThenElse(beyond, bound, low);
      high = hn::IfThenElse(beyond, high, bound);
      const VI more = hn::IfThenElseZero(hn::RebindMask(di, beyond), hn::Set(di, step));
      index = hn::Add(index, more);
    }
    mass = hn::Sub(high, low);
    inside = hn::Min(hn::Div(hn::Sub(u, low), mass), Splat(1.0f));
  }
};

struct GuideSample {
  V3 direction;  // unit, in the frame
  VF pdf_sa;
};

/// A direction with the density of the cell, u0 and u1 in [0, 1). What is left of them
/// once they have chosen row and square is the point in the square.
LANELIGHT_INLINE GuideSample SampleGuide(const Guide& guide, VI cell, VF u0, VF u1) {
  static_assert(kGuideBounds == 16 * 17);
  const VI rows = hn::Add(hn::ShiftLeft<8>(cell), hn::ShiftLeft<4>(cell));
  const float* cumulative = guide.cumulative.data();
  const GuideBound row(cumulative, rows, u0);
  const VI squares = hn::Add(rows, hn::ShiftLeft<4>(row.index));
  const GuideBound column(cumulative + kGuideGrid, squares, u1);
  const VF size = Splat(2.0f / kGuideGrid), one = Splat(1.0f);
  const auto coordinate = [&](const GuideBound& bound) HWY_ATTR {
    const VF at = hn::Add(hn::ConvertTo(DF(), bound.index), bound.inside);
    return hn::MulSub(at, size, one);
  };
  GuideSample sample;
  VF to_solid_angle;
  sample.direction =
      FromGuideSquare(coordinate(column), coordinate(row), &to_solid_angle);
  const VF density = hn::Mul(hn::Mul(row.mass, column.mass), Splat(kGuideSquares / 4.0f));
  sample.pdf_sa = hn::Mul(density, to_solid_angle);
  return sample;
}

LANELIGHT_END_KERNELS

#endif

// A guide (src/prepare/guide.h) as lanes read it: the cell of a point, the density of a
// direction in a cell, a direction of that density.
//   cell        one step of the tree per level of the deepest lane: permutations in the
//               upper levels, then two gathers each
//   density     the square of the direction (a root, an arc tangent), then two gathers
//   direction   six gathers of bounds, two of the leaf found
#if defined(LANELIGHT_GUIDE_GUIDE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LANELIGHT_GUIDE_GUIDE_INL_H_
#undef LANELIGHT_GUIDE_GUIDE_INL_H_
#else
#define LANELIGHT_GUIDE_GUIDE_INL_H_
#endif

#include <algorithm>

#include "kernels/warp/octahedral-inl.h"
#include "src/prepare/guide.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

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
  static_assert(sizeof(Guide::Node) == 2 * sizeof(float));
  const auto* words = reinterpret_cast<const float*>(guide.nodes.data());
  const auto* links = reinterpret_cast<const int32_t*>(words) + 1;
  VI node = hn::Zero(DI());
  while (top.Has(node)) {
    const GuideStep step(node, top.At(node), top.Link(node), p, n);
    if (hn::AllFalse(DF(), step.inner)) return step.target;
    node = step.next;
  }
  for (;;) {
    const VI at = hn::Add(node, node);
    const GuideStep step(node, Gather(words, at), Gather(links, at), p, n);
    if (hn::AllFalse(DF(), step.inner)) return step.target;
    node = step.next;
  }
}

/// pdf_sa of direction d, unit, scene; of what is no direction, that of some other.
LANELIGHT_INLINE VF GuidePdf(const Guide& guide, VI cell, V3 d) {
  const DI di;
  VF s, t;
  OctahedralSquare(d, &s, &t);
  const VF squares = Splat(static_cast<float>(kGuideGrid));
  const VI zero = hn::Zero(di), last = hn::Set(di, kGuideGrid - 1);
  const auto square = [&](VF x) HWY_ATTR {
    return hn::Min(hn::Max(hn::ConvertTo(di, hn::Mul(x, squares)), zero), last);
  };
  static_assert(kGuideGrid == 32 && kGuideLeaves == 64);
  const VI row = hn::Add(hn::ShiftLeft<5>(cell), square(t));
  const VI at = hn::Add(hn::ShiftLeft<5>(row), square(s));
  // A byte, from the word that holds it.
  const VI four =
      Gather(reinterpret_cast<const int32_t*>(guide.leaf.data()), hn::ShiftRight<2>(at));
  const VI shift = hn::ShiftLeft<3>(hn::And(at, hn::Set(di, 3)));
  const VI leaf = hn::And(hn::Shr(four, shift), hn::Set(di, 255));
  return Gather(guide.pdf_sa.data(), hn::Add(hn::ShiftLeft<6>(cell), leaf));
}

struct GuideSample {
  V3 direction;  // unit, scene
  VF pdf_sa;
};

/// A direction with the density of the cell, u0 and u1 in [0, 1). What is left of u0
/// once it has chosen a leaf is the first coordinate in its square.
LANELIGHT_INLINE GuideSample SampleGuide(const Guide& guide, VI cell, VF u0, VF u1) {
  const DI di;
  const VF one = Splat(1.0f);
  const VI base = hn::ShiftLeft<6>(cell);
  VI leaf = base;
  VF low = hn::Zero(DF()), high = one;
  for (int32_t step = kGuideLeaves / 2; step > 0; step /= 2) {
    const VF bound = Gather(guide.cumulative.data() + step - 1, leaf);
    const MF beyond = hn::Le(bound, u0);
    low = hn::IfThenElse(beyond, bound, low);
    high = hn::IfThenElse(beyond, high, bound);
    leaf =
        hn::Add(leaf, hn::IfThenElseZero(hn::RebindMask(di, beyond), hn::Set(di, step)));
  }
  const VI square = Gather(guide.square.data(), leaf);
  const auto part = [&](VI v) HWY_ATTR {
    return hn::ConvertTo(DF(), hn::And(v, hn::Set(di, 255)));
  };
  const VF side = part(hn::ShiftRight<16>(square));
  const VF inside = hn::Min(hn::Div(hn::Sub(u0, low), hn::Sub(high, low)), one);
  const VF size = Splat(1.0f / kGuideGrid);
  const VF s = hn::Mul(hn::MulAdd(inside, side, part(square)), size);
  const VF t = hn::Mul(hn::MulAdd(u1, side, part(hn::ShiftRight<8>(square))), size);
  return {OctahedralDirection(s, t), Gather(guide.pdf_sa.data(), leaf)};
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#endif

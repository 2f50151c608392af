// light-selection=tree: importance of a node of the tree of lights for a point.
#ifndef LANELIGHT_LIGHTS_TREE_INL_H_
#define LANELIGHT_LIGHTS_TREE_INL_H_

#include "kernels/simd/math-inl.h"
#include "kernels/simd/records-inl.h"
#include "src/scene/compiled/lights.h"

LANELIGHT_BEGIN_KERNELS

/// The nodes of a vector of lanes.
struct LightNodes : RecordWords<LightNode> {
  LANELIGHT_INLINE LightNodes(const LightTree& tree, VI node)
      : RecordWords(tree.nodes.data(), node) {}
};

/// cos(max(0, a - b)) of angles in [0, pi], from their cosines and sines.
LANELIGHT_INLINE VF CosDifference(VF cos_a, VF sin_a, VF cos_b, VF sin_b) {
  const VF difference = hn::MulAdd(cos_a, cos_b, hn::Mul(sin_a, sin_b));
  return hn::IfThenElse(hn::Gt(cos_a, cos_b), Splat(1.0f), difference);
}
LANELIGHT_INLINE VF SineOf(VF cosine) {
  return hn::Sqrt(hn::Max(hn::NegMulAdd(cosine, cosine, Splat(1.0f)), Splat(0)));
}

/// Importance is power cos(theta') / d^2. theta' is the least angle between the cone of
/// normals and a direction from the node's bounding sphere to p. d is the distance to its
/// centre, at least its radius. The cosine is at least 1/50, so no light that may
/// contribute has probability 0.
LANELIGHT_INLINE VF LightImportance(const LightNodes& node, V3 p) {
  const V3 low = node.F3(offsetof(LightNode, low)),
           high = node.F3(offsetof(LightNode, high));
  const V3 center = Mul(low + high, Splat(0.5f)), half = Mul(high - low, Splat(0.5f));
  const V3 to_p = p - center;
  const VF radius2 = Dot(half, half), tiny = Splat(1e-30f);
  const VF d2 = hn::Max(Dot(to_p, to_p), tiny);
  const VF inverse = hn::Div(Splat(1.0f), hn::Sqrt(d2));
  const VF cos_axis = hn::Mul(Dot(node.F3(offsetof(LightNode, axis)), to_p), inverse);
  const VF sin2_u = hn::Min(hn::Div(radius2, d2), Splat(1.0f));
  const VF cos_u = hn::IfThenElse(
      hn::Lt(radius2, d2), hn::Sqrt(hn::Max(hn::Sub(Splat(1.0f), sin2_u), Splat(0))),
      Splat(-1.0f));
  const VF sin_u = hn::IfThenElseZero(hn::Lt(radius2, d2), hn::Sqrt(sin2_u));
  const VF cos_seen = CosDifference(cos_axis, SineOf(cos_axis), cos_u, sin_u);
  const VF cone = node.F(offsetof(LightNode, cos_axis));
  const VF cos_left = CosDifference(cos_seen, SineOf(cos_seen), cone, SineOf(cone));
  const VF distance2 = hn::Max(d2, hn::Max(radius2, tiny));
  return hn::Div(
      hn::Mul(node.F(offsetof(LightNode, power)), hn::Max(cos_left, Splat(0.02f))),
      distance2);
}

/// Probabilities of going from a node to its first and second child.
struct ChildProbabilities {
  VF first, second;
};
LANELIGHT_INLINE ChildProbabilities ProbabilitiesOf(const LightTree& tree, VI first_child,
                                                    V3 p) {
  const VI second = hn::Add(first_child, hn::Set(DI(), 1));
  const VF a = LightImportance(LightNodes(tree, first_child), p);
  const VF b = LightImportance(LightNodes(tree, second), p);
  const VF scale = hn::Div(Splat(1.0f), hn::Add(a, b));
  return {hn::Mul(a, scale), hn::Mul(b, scale)};
}

LANELIGHT_END_KERNELS

#endif

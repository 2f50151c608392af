// light-selection=tree: descends a binary tree of lights from the root, to each child
// with probability in proportion to its importance for the point that is lit.
//   estimator   f(light) / pmf, pmf = (share of the tree) x product of the probabilities
//   unbiased    importances are positive, so every light has pmf > 0; lights
//               without a place (environments, distant) are chosen uniformly beside it
//   variance    follows 1/d^2 and orientation, which a table cannot: more efficient
//               from tens of lights on; ignores occlusion and the lit surface's normal
//   cost        two importances per level, about log2(lights) levels; the same for light
//               that is hit, to know its pmf
//   source      Conty Estevez and Kulla 2018, "Importance Sampling of Many Lights with
//               Adaptive Tree Splitting" (without the splitting)
#include "kernels/simd/each_target-inl.h"

#include "kernels/lights/light-inl.h"
#include "kernels/simd/math-inl.h"

LANELIGHT_BEGIN_KERNELS

// The nodes of a vector of lanes.
struct LightNodes : RecordWords<LightNode> {
  LANELIGHT_INLINE LightNodes(const LightTree& tree, VI node)
      : RecordWords(tree.nodes.data(), node) {}
};

// cos(max(0, a - b)) of angles in [0, pi], from their cosines and sines.
LANELIGHT_INLINE VF CosDifference(VF cos_a, VF sin_a, VF cos_b, VF sin_b) {
  const VF difference = hn::MulAdd(cos_a, cos_b, hn::Mul(sin_a, sin_b));
  return hn::IfThenElse(hn::Gt(cos_a, cos_b), Splat(1.0f), difference);
}
LANELIGHT_INLINE VF SineOf(VF cosine) {
  return hn::Sqrt(hn::Max(hn::NegMulAdd(cosine, cosine, Splat(1.0f)), Splat(0)));
}

// Importance is power cos(theta') / d^2. theta' is the least angle between the cone of
// normals and a direction from the node's bounding sphere to p. d is the distance to its
// centre, at least its radius. The cosine is at least 1/50, so no light that may
// contribute has probability 0.
HWY_INLINE VF LightImportance(const LightNodes& node, V3 p) {
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

// Probabilities of going from a node to its first and second child.
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

// One descent per lane: u is stretched back to [0, 1) after each choice.
HWY_INLINE VI Descend(const LightTree& tree, V3 p, VF u, VF* pmf) {
  const DI di;
  VI node = hn::Zero(di);
  for (;;) {
    const VI child = LightNodes(tree, node).I(offsetof(LightNode, child));
    const auto leaf = hn::Lt(child, hn::Zero(di));
    if (hn::AllTrue(di, leaf)) return hn::Not(child);
    const MF inner = hn::Not(hn::RebindMask(DF(), leaf));
    const VI safe = hn::IfThenZeroElse(leaf, child);
    const ChildProbabilities go = ProbabilitiesOf(tree, safe, p);
    const MF left = hn::Lt(u, go.first);
    const VF chosen = hn::IfThenElse(left, go.first, go.second);
    const VF stretched = hn::Div(hn::IfThenElse(left, u, hn::Sub(u, go.first)), chosen);
    *pmf = hn::IfThenElse(inner, hn::Mul(*pmf, chosen), *pmf);
    u = hn::IfThenElse(inner, hn::Clamp(stretched, Splat(0), Splat(0x1.fffffep-1f)), u);
    const VI next =
        hn::IfThenElse(hn::RebindMask(di, left), safe, hn::Add(safe, hn::Set(di, 1)));
    node = hn::IfThenElse(leaf, node, next);
  }
}

void SelectLightTree(Wave& wave) {
  const PathColumns& p = wave.path;
  const DI di;
  const LightTree& tree = wave.chances->tree;
  const int num_far = static_cast<int>(tree.far.size());
  const float share_far = tree.pmf_far * static_cast<float>(num_far);
  ForEachBatch(wave, wave.queue(QueueId::kLit), [&](const Slots& slots, MF) HWY_ATTR {
    const VF u = Gather(p.u_select, slots);
    VI light = hn::Zero(di);
    VF pmf = Splat(tree.pmf_far);
    if (num_far > 0) {
      const VI index = hn::ConvertTo(di, hn::Mul(u, Splat(1.0f / tree.pmf_far)));
      light = Gather(tree.far.data(), hn::Min(index, hn::Set(di, num_far - 1)));
    }
    if (!tree.nodes.empty()) {
      const MF far = hn::Lt(u, Splat(share_far));
      const VF rest = hn::Div(hn::Sub(u, Splat(share_far)), Splat(1.0f - share_far));
      VF pmf_tree = Splat(1.0f - share_far);
      const VI near =
          Descend(tree, Gather3(p.p_x, p.p_y, p.p_z, slots),
                  hn::Clamp(rest, Splat(0), Splat(0x1.fffffep-1f)), &pmf_tree);
      light = hn::IfThenElse(hn::RebindMask(di, far), light, near);
      pmf = hn::IfThenElse(far, pmf, pmf_tree);
    }
    Scatter(light, p.ls_light, slots);
    Scatter(pmf, p.light_pmf, slots);
  });
}

Stage SelectLightTreeStage() {
  return {.name = "light_select_tree",
          .meaning = "chooses a light by descending the tree",
          .input = QueueId::kLit,
          .role = StageRole::kLight,
          .needs = {Feature::kManyLights, Feature::kLightTree, Feature::kScatters},
          .reads = fields::kPoint | FieldSet{Field::u_select},
          .writes = {Field::ls_light, Field::light_pmf},
          .resolve = Always<SelectLightTree>};
}

// For MIS: the probability with which the tree would have selected the light that a ray
// has hit, by walking up from its leaf.
HWY_INLINE VF ClimbingProbability(const LightTree& tree, VI node, V3 p) {
  VF pmf = Splat(1.0f - tree.pmf_far * static_cast<float>(tree.far.size()));
  for (;;) {
    const auto inner = hn::Gt(node, hn::Zero(DI()));  // the root is 0
    if (hn::AllFalse(DI(), inner)) return pmf;
    // The root has none: lanes that are there read the root again.
    const VI parent =
        hn::IfThenElseZero(inner, LightNodes(tree, node).I(offsetof(LightNode, parent)));
    const VI first =
        hn::IfThenElseZero(inner, LightNodes(tree, parent).I(offsetof(LightNode, child)));
    const ChildProbabilities go = ProbabilitiesOf(tree, first, p);
    const MF is_first = hn::RebindMask(DF(), hn::Eq(node, first));
    const VF chosen = hn::IfThenElse(is_first, go.first, go.second);
    pmf = hn::IfThenElse(hn::RebindMask(DF(), inner), hn::Mul(pmf, chosen), pmf);
    node = hn::IfThenElse(inner, parent, node);
  }
}

void HitLightTree(Wave& wave) {
  const PathColumns& p = wave.path;
  const LightTree& tree = wave.chances->tree;
  const int32_t* nodes = tree.primitive_leaf.data();
  const Queue& mine =
      FilterQueue(wave, wave.queue(QueueId::kHit), [&](const Slots& slots) HWY_ATTR {
        const VI leaf = Gather(nodes, Gather(p.prim, slots));
        return hn::RebindMask(DF(), hn::Gt(leaf, hn::Set(DI(), -1)));
      });
  ForEachBatch(wave, mine, [&](const Slots& slots, MF) HWY_ATTR {
    // The origin of the ray is the point that was lit, but for rounding.
    const V3 from = ScatteredFrom(p, slots);
    Scatter(ClimbingProbability(tree, Gather(nodes, Gather(p.prim, slots)), from),
            p.light_pmf, slots);
  });
}

Stage HitLightTreeStage() {
  return {.name = "light_hit_tree",
          .meaning = "computes the probability of selecting the light that was hit",
          .input = QueueId::kHit,
          .role = StageRole::kEmission,
          .needs = {Feature::kAreaLights, Feature::kLightTree, Feature::kMis},
          .reads = fields::kRay | FieldSet{Field::prim},
          .writes = {Field::light_pmf},
          .resolve = Always<HitLightTree>};
}

LANELIGHT_END_KERNELS

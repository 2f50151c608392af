// For MIS with light-selection=tree: computes the probability with which the tree would
// have selected the light that a ray has hit, by walking up from its leaf.
#include "kernels/simd/each_target-inl.h"

#include "kernels/lights/light-inl.h"
#include "kernels/lights/tree-inl.h"
#include "kernels/queue/batch-inl.h"
#include "src/scene/compiled/lights.h"

LANELIGHT_BEGIN_KERNELS

HWY_INLINE VF ClimbingProbability(const LightTree& tree, VI node, V3 p) {
  const DI di;
  const DF df;
  VF pmf = Splat(1.0f - tree.pmf_far * static_cast<float>(tree.far.size()));
  for (;;) {
    const auto inner = hn::Gt(node, hn::Zero(di));  // the root is 0
    if (hn::AllFalse(di, inner)) return pmf;
    // The root has none: lanes that are there read the root again.
    const VI parent =
        hn::IfThenElseZero(inner, LightNodes(tree, node).I(offsetof(LightNode, parent)));
    const VI first =
        hn::IfThenElseZero(inner, LightNodes(tree, parent).I(offsetof(LightNode, child)));
    const ChildProbabilities go = ProbabilitiesOf(tree, first, p);
    const MF is_first = hn::RebindMask(df, hn::Eq(node, first));
    const VF chosen = hn::IfThenElse(is_first, go.first, go.second);
    pmf = hn::IfThenElse(hn::RebindMask(df, inner), hn::Mul(pmf, chosen), pmf);
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
          .meaning = "probability of having selected the light that was hit",
          .input = QueueId::kHit,
          .role = StageRole::kEmission,
          .needs = {Feature::kAreaLights, Feature::kLightTree, Feature::kMis},
          .reads = fields::kRay | FieldSet{Field::prim},
          .writes = {Field::light_pmf},
          .resolve = Always<HitLightTree>};
}

LANELIGHT_END_KERNELS

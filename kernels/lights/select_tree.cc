// light-selection=tree: descends a binary tree of lights from the root, to each child
// with probability in proportion to its importance for the point that is lit.
//   estimator   f(light) / pmf, pmf = (share of the tree) x product of the probabilities
//   unbiased    importances are positive (tree-inl.h), so every light has pmf > 0; lights
//               without a place (environments, distant) are chosen uniformly beside it
//   variance    follows 1/d^2 and orientation, which a table cannot: pays from tens of
//               lights on; knows nothing of occlusion and of the lit surface's normal
//   cost        two importances per level, about log2(lights) levels; the same for light
//               that is hit, to know its pmf
//   source      Conty Estevez and Kulla 2018, "Importance Sampling of Many Lights with
//               Adaptive Tree Splitting" (without the splitting)
#include "kernels/simd/each_target-inl.h"

#include "kernels/lights/tree-inl.h"
#include "kernels/queue/batch-inl.h"
#include "src/scene/compiled/lights.h"

LANELIGHT_BEGIN_KERNELS

// One descent per lane: u is stretched back to [0, 1) after each choice.
HWY_INLINE VI Descend(const LightTree& tree, V3 p, VF u, VF* pmf) {
  const DI di;
  const DF df;
  VI node = hn::Zero(di);
  for (;;) {
    const VI child = LightNodes(tree, node).I(offsetof(LightNode, child));
    const auto leaf = hn::Lt(child, hn::Zero(di));
    if (hn::AllTrue(di, leaf)) return hn::Not(child);
    const MF inner = hn::Not(hn::RebindMask(df, leaf));
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

LANELIGHT_END_KERNELS

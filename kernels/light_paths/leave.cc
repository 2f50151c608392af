// light-paths=splats: continues the ratio of densities in the direction in which a path
// has been scattered (kernels/light_paths/chain-inl.h). Corrects the throughput of light
// subpaths, which carry importance (Veach 1997, section 5.3).
#include "kernels/simd/each_target-inl.h"

#include "kernels/light_paths/chain-inl.h"

LANELIGHT_BEGIN_KERNELS

// Returns the product without what depends on the next vertex. Light samples find the
// light of a light subpath at its first vertex as well. A connection has no density at
// the first vertex of a camera path.
template <bool kLight>
HWY_INLINE VF ChainThrough(VF chain, VF back, MF specular, VI number) {
  const VF one = Splat(1.0f);
  const VF through = hn::Mul(chain, hn::IfThenElse(specular, one, back));
  const MF first = IsNumber(number, 1);
  if constexpr (kLight) {
    return hn::IfThenElse(hn::AndNot(specular, first), hn::Add(through, one), through);
  }
  return hn::IfThenElse(first, one, through);
}

// Returns the light subpaths that end here: E never finds their light, so that the
// product is 0 (emit.cc), and N does not find it by way of a mirror.
HWY_INLINE MF BeginsDeltaCaustic(const Wave& wave, VI number, MF specular, VF chain) {
  const VF zero = hn::Zero(DF());
  if (wave.chances->emission.delta_caustics) return hn::Lt(zero, zero);
  return hn::And(hn::And(specular, IsNumber(number, 1)), hn::Eq(chain, zero));
}

// Returns the correction of importance for the shading normal; 1 in a medium.
template <class Bsdf>
HWY_INLINE VF ShadingCorrection(const ChainVertex<Bsdf>& vertex, V3 in, V3 d, V3 wi) {
  if constexpr (Bsdf::kPhase) return Splat(1.0f);
  const VF shading = hn::Mul(hn::Abs(vertex.wo.z), vertex.Cosine(d));
  return hn::Div(shading, hn::Mul(vertex.Cosine(in), hn::Abs(wi.z)));
}

template <class Bsdf, bool kLight>
HWY_NOINLINE void LeaveKind(Wave& wave, const Queue& queue) {
  const PathColumns& p = wave.path;
  const SurfaceReader<Bsdf> reader(wave);
  ForEachBatch(wave, queue, [&](const StoreSlots& slots, MF) HWY_ATTR {
    const VF zero = hn::Zero(DF());
    const VF pdf = Gather(p.bsdf_pdf, slots);
    const MF specular = hn::Not(hn::Gt(pdf, zero));
    const ChainVertex<Bsdf> vertex(reader, slots);
    const V3 d = Gather3(p.d_x, p.d_y, p.d_z, slots);
    const V3 wi = vertex.frame.ToLocal(d);
    VF back = zero;
    if constexpr (!Bsdf::kSpecular) back = Bsdf::Eval(vertex.material, wi, vertex.wo).pdf;
    const VI number = Gather(p.lp_vertex, slots);
    const VF chain = Gather(p.lp_chain, slots);
    const VF through = ChainThrough<kLight>(chain, back, specular, number);
    const VF next =
        hn::Mul(hn::Mul(through, Gather(p.lp_inverse, slots)), vertex.Cosine(d));
    if constexpr (kLight) {
      Scatter(next, p.lp_chain, slots);
      const V3 in = Gather3(p.lp_in_x, p.lp_in_y, p.lp_in_z, slots);
      const VF factor =
          hn::Mul(ShadingCorrection(vertex, in, d, wi), Gather(p.eta_scale, slots));
      const V3 beta = Gather3(p.beta_r, p.beta_g, p.beta_b, slots);
      const MF kept = hn::Not(BeginsDeltaCaustic(wave, number, specular, chain));
      Scatter3(IfThenElseZero(kept, Mul(beta, factor)), p.beta_r, p.beta_g, p.beta_b,
               slots);
      Scatter(Splat(1.0f), p.eta_scale, slots);
    } else {
      Scatter(next, p.lp_chain, slots);
      // A connection to the camera does not find the lobe of a mirror.
      const MF lost = hn::And(specular, IsNumber(number, 1));
      const VI none = hn::Set(DI(), static_cast<int32_t>(kNotFromLight));
      Scatter(hn::IfThenElse(hn::RebindMask(DI(), lost), none, number), p.lp_vertex,
              slots);
    }
    Scatter(hn::IfThenElse(specular, Splat(1.0f), pdf), p.lp_pdf, slots);
  });
}

// Ends the light subpaths that carry nothing any more.
HWY_INLINE void EndDark(Wave& wave) {
  const PathColumns& p = wave.path;
  const Queue all = wave.queue(QueueId::kScattered);
  Queue& left = wave.queue(QueueId::kScattered);
  left.size = 0;
  ForEachBatch(wave, all, [&](const Slots& slots, MF valid) HWY_ATTR {
    const V3 beta = Gather3(p.beta_r, p.beta_g, p.beta_b, slots);
    const MF carries = hn::Gt(MaxComponent(beta), hn::Zero(DF()));
    Push(left, slots, hn::And(valid, carries));
    Push(wave.queue(QueueId::kDone), slots, hn::AndNot(carries, valid));
  });
}

template <bool kLight>
void Leave(Wave& wave) {
  ForEachShaded(wave, [&]<class Bsdf>(Queue& queue)
                          HWY_ATTR { LeaveKind<Bsdf, kLight>(wave, queue); });
  if (kLight && !wave.chances->emission.delta_caustics) EndDark(wave);
}

Stage LightPathLeaveStage() {
  using namespace fields;
  return {.name = "light_path_leave",
          .meaning = "continues the ratio of densities along the scattered ray",
          .input = QueueId::kVertex,
          .role = StageRole::kRecord,
          .needs = {Feature::kLightPaths, Feature::kScatters},
          .reads = FirstVertexFields(true, true) |
                   FieldSet{Field::lp_chain, Field::lp_inverse, Field::lp_in_x,
                            Field::lp_in_y, Field::lp_in_z, Field::lp_vertex,
                            Field::bsdf_pdf, Field::eta_scale},
          .writes = kThroughput | FieldSet{Field::lp_chain, Field::lp_pdf,
                                           Field::lp_vertex, Field::eta_scale},
          .resolve = ByFeature<Feature::kLightSubpath, Leave<true>, Leave<false>>};
}

LANELIGHT_END_KERNELS

// Ratios of densities along a path, for the MIS weights of light-paths=splats.
//
// A path x_0 (camera), x_1, ..., x_k, y (on a light) is found by three techniques: by
// hitting the light (E), by a light sample at x_k (N), and by a light subpath whose last
// vertex x_1 connects to the camera (T). With p_j the area density with which a camera
// path finds x_j, and r_j that of a light subpath,
//
//   T / E = product over j = 1, ..., k of r_j / p_j, times r_y / p_y.
//
// E cannot find lights without extent. Both T and N choose such a light with the same
// probability, so that T / N is the product over j alone.
//
// Both sides keep the product so far in `lp_chain`, which lacks what depends on the next
// direction: at arrival at a vertex 1 / p of the vertex before it, times the cosine there
// over the squared distance. `lp_inverse` is 1 / p of the vertex itself. So at a
// direction with the reverse density `pdf_back` (solid angle) the product continues with
//
//   lp_chain * pdf_back * lp_inverse * cosine.
//
// For specular vertices both densities are 1. Densities of points in a medium are by
// volume and have no cosine. Transmittances and the density of scattering are left out of
// all three techniques: weights may be any function of the path.
//
// The weights are those of the balance heuristic between T and (E + N), of which the
// latter share theirs as without T. There N is taken as if it chose lights and points as
// T does (starts-inl.h), whatever it does: the weights of a path sum to 1 for any such
// choice.
#ifndef LANELIGHT_LIGHT_PATHS_CHAIN_INL_H_
#define LANELIGHT_LIGHT_PATHS_CHAIN_INL_H_

#include "kernels/bsdf/kinds-inl.h"
#include "kernels/lights/light-inl.h"
#include "kernels/shade/shade-inl.h"
#include "src/vocabulary/path/light_splats.h"

LANELIGHT_BEGIN_KERNELS

HWY_INLINE MF IsNumber(VI vertex, uint32_t number) {
  return hn::RebindMask(DF(),
                        hn::Eq(vertex, hn::Set(DI(), static_cast<int32_t>(number))));
}
HWY_INLINE MF IsAtLeast(VI vertex, uint32_t number) {
  return hn::RebindMask(DF(),
                        hn::Gt(vertex, hn::Set(DI(), static_cast<int32_t>(number) - 1)));
}
HWY_INLINE MF IsAtMost(VI vertex, uint32_t number) {
  return hn::RebindMask(DF(),
                        hn::Lt(vertex, hn::Set(DI(), static_cast<int32_t>(number) + 1)));
}

/// Returns whether the material of a vertex is of one of these kinds.
HWY_INLINE MF IsOfKind(const Wave& wave, const Slots& slots, uint32_t kinds) {
  const DU du;
  const VI kind = Lookup(wave.materials->kind, Gather(wave.path.material, slots));
  const VU bit = hn::Shl(hn::Set(du, 1u), hn::BitCast(du, kind));
  return hn::RebindMask(DF(), hn::Ne(hn::And(bit, hn::Set(du, kinds)), hn::Zero(du)));
}

/// Returns the weight of E or N: `ratio` is T / E times the density of E's last
/// direction, `found` that density and N's together.
HWY_INLINE VF CameraWeight(const Wave& wave, VF ratio, VF found) {
  const VF t = hn::Mul(ratio, Splat(wave.light_splats->paths_per_sample));
  return hn::Div(found, hn::Add(found, t));
}

/// Returns the entry of a light vertex in LightSplats.
HWY_INLINE VI EntryOf(const PathColumns& p, const Slots& slots) {
  const VI first = hn::Mul(Gather(p.output, slots),
                           hn::Set(DI(), static_cast<int32_t>(kMaxLightVertices)));
  return hn::Add(first, hn::Sub(Gather(p.lp_vertex, slots), hn::Set(DI(), 1)));
}

/// Densities of a material in both directions.
template <class Bsdf>
struct BothDensities {
  VF forward, back;

  HWY_INLINE BothDensities(const typename Bsdf::Params& material, V3 wo, V3 wi)
      : forward(Bsdf::Eval(material, wo, wi).pdf),
        back(Bsdf::Eval(material, wi, wo).pdf) {}
};

/// A vertex that a path has found, in the frame of its shading normal.
template <class Bsdf>
struct ChainVertex {
  ShadingFrame frame;
  V3 ng, wo;
  typename Bsdf::Params material;

  HWY_INLINE ChainVertex(const SurfaceReader<Bsdf>& reader, const Slots& slots)
      : frame(reader.ReadFrame(Normal(reader, slots), slots)),
        ng(Normal(reader, slots)),
        wo(frame.ToLocal(-Gather3(reader.wave.path.lp_in_x, reader.wave.path.lp_in_y,
                                  reader.wave.path.lp_in_z, slots))),
        material(Bsdf::Load(reader.Inputs(slots))) {}
  HWY_INLINE static V3 Normal(const SurfaceReader<Bsdf>& reader, const Slots& slots) {
    const PathColumns& p = reader.wave.path;
    return Gather3(p.ng_x, p.ng_y, p.ng_z, slots);
  }
  /// Returns the cosine of the density by area in direction d; 1 for points in a medium,
  /// whose density is by volume.
  HWY_INLINE VF Cosine(V3 d) const {
    if constexpr (Bsdf::kPhase) return Splat(1.0f);
    return hn::Abs(Dot(ng, d));
  }
};

/// Calls body.operator()<Bsdf>(queue) for each kind of material that has paths.
template <class Body>
HWY_INLINE void ForEachShaded(Wave& wave, Body&& body){
#define X(name, traits, meaning)                                     \
  if constexpr (((traits) & kWalks) == 0) {                          \
    Queue& queue = wave.queue(ShadeQueue(ShadeKind::k##name));       \
    if (queue.size > 0) body.template operator()<name##Bsdf>(queue); \
  }
    LANELIGHT_SHADE_KINDS(X)
#undef X
}

LANELIGHT_END_KERNELS

#endif

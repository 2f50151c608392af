// light-paths=splats: continues the ratio of densities with the vertex that a path has
// found (kernels/light_paths/chain-inl.h).
#include "kernels/simd/each_target-inl.h"

#include "kernels/light_paths/camera_view-inl.h"
#include "kernels/light_paths/chain-inl.h"

LANELIGHT_BEGIN_KERNELS

constexpr float kMinDistance = 1e-6f;  // of points in media, in scene units

// Returns the distance from the vertex before. That of points in media, whose column t is
// negative, is that to the point.
HWY_INLINE VF DistanceTo(const PathColumns& p, const Slots& slots, V3 d) {
  const VF t = HitDistance(p, slots);
  if (p.medium == nullptr) return t;
  const MF in_medium = hn::Lt(Gather(p.t, slots), hn::Zero(DF()));
  const V3 at = Gather3(p.p_x, p.p_y, p.p_z, slots);
  // The difference of rounded points may be 0, by which densities are divided.
  const VF apart = Dot(at - ScatteredFrom(p, slots), d);
  return hn::IfThenElse(in_medium, hn::Max(apart, Splat(kMinDistance)), t);
}

// Continues the chain with the distance to this vertex. `from_far`: subpaths may come
// from lights at infinity, with parallel rays. The normal of points in media looks back
// along the ray.
HWY_INLINE void UpdateChain(const PathColumns& p, const StoreSlots& slots,
                            bool from_far) {
  const V3 d = Gather3(p.d_x, p.d_y, p.d_z, slots);
  const V3 ng = Gather3(p.ng_x, p.ng_y, p.ng_z, slots);
  const VF t = DistanceTo(p, slots, d);
  VF pdf = Gather(p.lp_pdf, slots), t2 = hn::Mul(t, t);
  if (from_far) {
    t2 = hn::IfThenElse(hn::Lt(pdf, hn::Zero(DF())), Splat(1.0f), t2);
    pdf = hn::Abs(pdf);
  }
  const VF density = hn::Mul(pdf, hn::Abs(Dot(ng, d)));
  Scatter(hn::Div(t2, density), p.lp_inverse, slots);
  Scatter(hn::Div(Gather(p.lp_chain, slots), t2), p.lp_chain, slots);
  Scatter3(d, p.lp_in_x, p.lp_in_y, p.lp_in_z, slots);
}

void ArriveCamera(Wave& wave) {
  const PathColumns& p = wave.path;
  const DI di;
  ForEachBatch(
      wave, wave.queue(QueueId::kVertex), [&](const StoreSlots& slots, MF) HWY_ATTR {
        const VI before = Gather(p.lp_vertex, slots);
        const MF first = IsNumber(before, 0);
        if (!hn::AllFalse(DF(), first)) {
          // The camera's density, where nothing has been scattered.
          const V3 d = Gather3(p.d_x, p.d_y, p.d_z, slots);
          const VF pdf = Gather(p.lp_pdf, slots);
          Scatter(hn::IfThenElse(first, CameraView(*wave.camera).Density(d), pdf),
                  p.lp_pdf, slots);
        }
        UpdateChain(p, slots, false);
        const MF lost = hn::Or(IsNumber(before, kNotFromLight),
                               hn::AndNot(IsOfKind(wave, slots, kSplattingKinds), first));
        Scatter(hn::IfThenElse(hn::RebindMask(di, lost),
                               hn::Set(di, static_cast<int32_t>(kNotFromLight)),
                               hn::Add(before, hn::Set(di, 1))),
                p.lp_vertex, slots);
        Scatter(Splat(1.0f), p.hit_weight, slots);
      });
}

void ArriveLight(Wave& wave) {
  const PathColumns& p = wave.path;
  const bool from_far = wave.chances->emission.HasAny(kFarLight);
  ForEachBatch(wave, wave.queue(QueueId::kVertex),
               [&](const StoreSlots& slots, MF) HWY_ATTR {
                 UpdateChain(p, slots, from_far);
                 const VI before = Gather(p.lp_vertex, slots);
                 Scatter(hn::Add(before, hn::Set(DI(), 1)), p.lp_vertex, slots);
               });
}

Stage LightPathArriveStage() {
  using namespace fields;
  const FieldSet chain = {Field::lp_chain, Field::lp_inverse, Field::lp_in_x,
                          Field::lp_in_y,  Field::lp_in_z,    Field::lp_vertex,
                          Field::lp_pdf,   Field::hit_weight};
  return {.name = "light_path_arrive",
          .meaning = "continues the ratio of densities to the vertex",
          .input = QueueId::kVertex,
          .role = StageRole::kRecord,
          .needs = {Feature::kLightPaths, Feature::kScatters},
          .reads = kRay | kNormal | kPoint |
                   FieldSet{Field::t, Field::material, Field::lp_pdf, Field::lp_chain,
                            Field::lp_vertex, Field::passed},
          .writes = chain,
          .resolve = ByFeature<Feature::kLightSubpath, ArriveLight, ArriveCamera>};
}

LANELIGHT_END_KERNELS

// Transmittance of media along shadow rays. If all surfaces are opaque, a shadow ray lies
// in the medium that it starts in.
#include "kernels/simd/each_target-inl.h"

#include <span>
#include <utility>

#include "kernels/media/shadow-inl.h"
#include "src/scene/geometry/geometry.h"

LANELIGHT_BEGIN_KERNELS

template <bool kChanges>
void ShadowMediaOf(Wave& wave) {
  const PathColumns& p = wave.path;
  ForEachBatch(wave, wave.queue(QueueId::kShadow),
               [&](const StoreSlots& slots, MF) HWY_ATTR {
                 const VI medium = ShadowStartMedium<kChanges>(wave, slots);
                 const V3 o = Gather3(p.p_x, p.p_y, p.p_z, slots);
                 DimShadow(wave, slots, {medium, o, Gather(p.ls_distance, slots), 0});
               });
}

StageFn ResolveShadowMedia(const FeatureSet& features) {
  return features.Has(Feature::kMediumChanges) ? ShadowMediaOf<true>
                                               : ShadowMediaOf<false>;
}

Stage ShadowMediaStage() {
  const FieldSet light = {Field::ls_x, Field::ls_y, Field::ls_z, Field::ls_distance};
  return {.name = "media_dim",
          .meaning = "applies the transmittance of media to shadow rays",
          .input = QueueId::kShadow,
          .role = StageRole::kMedia,
          .needs = {Feature::kMedia, Feature::kOpaqueShadows, Feature::kLights,
                    Feature::kScatters},
          .reads = light | fields::kShadow | fields::kNormal | fields::kPoint |
                   FieldSet{Field::pixel, Field::sample, Field::depth, Field::branch,
                            Field::crossings} |
                   FieldSet{Field::medium, Field::prim, Field::wavelength},
          .writes = fields::kShadow,
          .resolve = ResolveShadowMedia};
}

// If some surfaces only bound a medium, a shadow ray goes from surface to surface until
// it meets one that stops light, or the light. Each leg runs the stages that find the
// nearest surface of a path's ray, on columns of the shadow ray.
//   orientation  the shading normal orients interfaces, hence both normals are found
//   cost         a traversal for each interface in between

// Returns the columns with the shadow ray as the ray of intersection and surface stages.
HWY_INLINE PathColumns RestAsRay(const Wave& wave) {
  const PathColumns& p = wave.path;
  PathColumns ray = p;
  ray.o_x = p.sh_o_x, ray.o_y = p.sh_o_y, ray.o_z = p.sh_o_z;
  ray.d_x = p.ls_x, ray.d_y = p.ls_y, ray.d_z = p.ls_z;
  ray.t = p.sh_t, ray.prim = p.sh_prim, ray.material = p.sh_material;
  ray.p_x = p.sh_p_x, ray.p_y = p.sh_p_y, ray.p_z = p.sh_p_z;
  ray.p_error = p.sh_p_error;
  ray.ng_x = p.sh_n_x, ray.ng_y = p.sh_n_y, ray.ng_z = p.sh_n_z;
  ray.ns_x = p.sh_ns_x, ray.ns_y = p.sh_ns_y, ray.ns_z = p.sh_ns_z;
  // The other columns of the surface belong to the path.
  ray.tg_x = ray.tv_x = ray.uv_u = nullptr;
  if (wave.geometry->normals.empty()) ray.ns_x = nullptr;
  return ray;
}

HWY_INLINE void BeginRemainder(Wave& wave) {
  const PathColumns& p = wave.path;
  ForEachBatch(wave, wave.queue(QueueId::kShadow),
               [&](const StoreSlots& slots, MF) HWY_ATTR {
                 const V3 at = Gather3(p.p_x, p.p_y, p.p_z, slots);
                 const V3 ng = Gather3(p.ng_x, p.ng_y, p.ng_z, slots);
                 const V3 ls = Gather3(p.ls_x, p.ls_y, p.ls_z, slots);
                 const V3 o = OffsetOrigin(at, ng, Gather(p.p_error, slots), ls);
                 Scatter3(o, p.sh_o_x, p.sh_o_y, p.sh_o_z, slots);
                 Scatter(Gather(p.ls_distance, slots), p.sh_left, slots);
                 Scatter(Splat(std::numeric_limits<float>::infinity()), p.sh_t, slots);
                 Scatter(Gather(p.prim, slots), p.sh_prim, slots);
                 Scatter(ShadowStartMedium<true>(wave, slots), p.sh_medium, slots);
               });
}

// Runs kernels of other stages on the rays of `queue`.
HWY_INLINE void RunOn(Wave& wave, const PathColumns& columns, QueueId place,
                      const Queue& queue, std::span<const StageFn> kernels) {
  const PathColumns path = std::exchange(wave.path, columns);
  wave.queue(place) = queue;
  for (const StageFn kernel : kernels) kernel(wave);
  wave.path = path;
}

// Sorts rays whose nearest surface is known: those that reach the light go to kShadow,
// those that meet an interface stay in kActive, with the transmittance so far.
HWY_INLINE void SortLegs(Wave& wave, uint32_t leg) {
  const PathColumns& p = wave.path;
  Queue& legs = wave.queue(QueueId::kActive);
  Queue rest = {legs.items, 0};  // compacts in place: writes never pass reads
  ForEachBatch(wave, legs, [&](const StoreSlots& slots, MF valid) HWY_ATTR {
    const VF left = Gather(p.sh_left, slots), t = Gather(p.sh_t, slots);
    const MF arrives = hn::Ge(t, left);
    const MF passes =
        hn::AndNot(arrives, Sides(*wave.media, Gather(p.sh_prim, slots)).Passes());
    const V3 o = Gather3(p.sh_o_x, p.sh_o_y, p.sh_o_z, slots);
    DimShadow(wave, slots, {Gather(p.sh_medium, slots), o, hn::Min(t, left), leg});
    Push(wave.queue(QueueId::kShadow), slots, hn::And(valid, arrives));
    Push(rest, slots, hn::And(valid, passes));
  });
  legs.size = rest.size;
}

// Sends the rays of kActive on behind the interfaces that they have met.
HWY_INLINE void NextLegs(Wave& wave) {
  const PathColumns& p = wave.path;
  ForEachBatch(
      wave, wave.queue(QueueId::kActive), [&](const StoreSlots& slots, MF) HWY_ATTR {
        const V3 d = Gather3(p.ls_x, p.ls_y, p.ls_z, slots);
        const V3 n = Gather3(p.sh_n_x, p.sh_n_y, p.sh_n_z, slots);
        const V3 at = Gather3(p.sh_p_x, p.sh_p_y, p.sh_p_z, slots);
        const V3 o = OffsetOrigin(at, n, Gather(p.sh_p_error, slots), d);
        const Sides sides(*wave.media, Gather(p.sh_prim, slots));
        Scatter3(o, p.sh_o_x, p.sh_o_y, p.sh_o_z, slots);
        Scatter(sides.Toward(d, n, Gather(p.sh_medium, slots)), p.sh_medium, slots);
        Scatter(hn::Sub(Gather(p.sh_left, slots), Gather(p.sh_t, slots)), p.sh_left,
                slots);
        Scatter(Splat(std::numeric_limits<float>::infinity()), p.sh_t, slots);
      });
}

void ShadowThrough(Wave& wave) {
  const PathColumns ray = RestAsRay(wave);
  const RayKernels& kernels = wave.kernels;
  BeginRemainder(wave);
  // Both queues have been consumed (stages `split` and `route`).
  Queue& legs = wave.queue(QueueId::kActive);
  const Queue surfaces = wave.queue(QueueId::kSurface);
  std::swap(wave.queue(QueueId::kShadow), legs);
  wave.queue(QueueId::kShadow).size = 0;
  for (uint32_t leg = 0; legs.size > 0 && leg < kMaxInterfaceCrossings; ++leg) {
    RunOn(wave, ray, QueueId::kActive, legs, {kernels.closest, kernels.num_closest});
    SortLegs(wave, leg);
    RunOn(wave, ray, QueueId::kSurface, legs, {kernels.surface, kernels.num_surface});
    NextLegs(wave);
  }
  legs.size = 0;
  wave.queue(QueueId::kSurface) = surfaces;
}

Stage ShadowThroughStage() {
  const FieldSet light = {Field::ls_x, Field::ls_y, Field::ls_z, Field::ls_distance};
  return {.name = "media_shadow",
          .meaning = "traces shadow rays through interfaces of media",
          .input = QueueId::kShadow,
          .role = StageRole::kShadow,
          .needs = {Feature::kInterfaces, Feature::kLights, Feature::kScatters},
          .reads = light |
                   FieldSet{Field::pixel, Field::sample, Field::depth, Field::branch,
                            Field::crossings} |
                   fields::kShadow | fields::kPoint | fields::kNormal |
                   FieldSet{Field::medium, Field::prim, Field::wavelength},
          .writes = fields::kShadow | fields::kShadowRest |
                    FieldSet{Field::b1, Field::b2, Field::inst},
          .resolve = Always<ShadowThrough>};
}

LANELIGHT_END_KERNELS

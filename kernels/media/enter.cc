// Which medium a scattered ray goes into: what lies on its side of the surface. A ray
// that scattered in a medium, or on a surface with nothing beside it, stays where it is.
#include "kernels/simd/each_target-inl.h"

#include "kernels/media/medium-inl.h"

LANELIGHT_BEGIN_KERNELS

template <bool kInterfaces>
void Enter(Wave& wave) {
  const PathColumns& p = wave.path;
  const MediumTable& media = wave.scene->media;
  ForEachBatch(wave, wave.queue(QueueId::kScattered),
               [&](const StoreSlots& slots, MF) HWY_ATTR {
                 const V3 d = Gather3(p.d_x, p.d_y, p.d_z, slots);
                 const V3 ng = Gather3(p.ng_x, p.ng_y, p.ng_z, slots);
                 const Sides sides(media, Gather(p.prim, slots));
                 Scatter(sides.Toward(d, ng, Gather(p.medium, slots)), p.medium, slots);
                 if constexpr (kInterfaces) {
                   Scatter(hn::Zero(DF()), p.passed, slots);
                   Scatter(hn::Zero(DI()), p.crossings, slots);
                 }
               });
}

Stage EnterMediaStage() {
  const FieldSet ray = {Field::medium, Field::passed, Field::crossings};
  return {.name = "enter_media",
          .meaning = "which medium scattered rays go into",
          .input = QueueId::kScattered,
          .needs = {Feature::kMediumChanges, Feature::kScatters},
          .reads = FieldSet{Field::d_x, Field::d_y, Field::d_z, Field::prim} |
                   fields::kNormal | ray,
          .writes = ray,
          .resolve = ByFeature<Feature::kInterfaces, Enter<true>, Enter<false>>};
}

LANELIGHT_END_KERNELS

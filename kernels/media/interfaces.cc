// Surfaces that only bound a medium (material "interface"): paths continue straight,
// without scattering or roulette. One stage takes these paths out of the surfaces that
// scatter, and ends other paths at the max depth (which stage `limit` left to it). The
// other sends them on.
#include "kernels/simd/each_target-inl.h"

#include "kernels/media/medium-inl.h"
#include "kernels/queue/depth-inl.h"

LANELIGHT_BEGIN_KERNELS

void Interfaces(Wave& wave) {
  const PathColumns& p = wave.path;
  const VI most = hn::Set(DI(), static_cast<int32_t>(kMostCrossings));
  Queue& surfaces = wave.queue(QueueId::kSurface);
  Queue rest = {surfaces.items, 0};  // compacts in place: writes never pass reads
  ForEachBatch(wave, surfaces, [&](const Slots& slots, MF valid) HWY_ATTR {
    const MF passes = hn::And(valid, Sides(*wave.media, Gather(p.prim, slots)).Passes());
    const MF stays = hn::AndNot(passes, valid);
    const MF below = MayScatter(wave, slots);
    const MF few = hn::RebindMask(DF(), hn::Lt(Gather(p.crossings, slots), most));
    const MF goes_on = hn::Or(hn::And(passes, few), hn::And(stays, below));
    Push(rest, slots, hn::And(stays, below));
    Push(wave.queue(QueueId::kDone), slots, hn::AndNot(goes_on, valid));
    Push(wave.queue(QueueId::kPassed), slots, hn::And(passes, few));
  });
  surfaces.size = rest.size;
}

void PassInterfaces(Wave& wave) {
  const PathColumns& p = wave.path;
  const MediumTable& media = *wave.media;
  ForEachBatch(wave, wave.queue(QueueId::kPassed),
               [&](const StoreSlots& slots, MF valid) HWY_ATTR {
                 const V3 d = Gather3(p.d_x, p.d_y, p.d_z, slots);
                 const V3 ng = Gather3(p.ng_x, p.ng_y, p.ng_z, slots);
                 const V3 at = Gather3(p.p_x, p.p_y, p.p_z, slots);
                 const V3 o = OffsetOrigin(at, ng, Gather(p.p_error, slots), d);
                 const Sides sides(media, Gather(p.prim, slots));
                 Scatter3(o, p.o_x, p.o_y, p.o_z, slots);
                 Scatter(sides.Toward(d, ng, Gather(p.medium, slots)), p.medium, slots);
                 const VF length = hn::Add(Gather(p.passed, slots), Gather(p.t, slots));
                 Scatter(length, p.passed, slots);
                 const VI one = hn::Set(DI(), 1);
                 Scatter(hn::Add(Gather(p.crossings, slots), one), p.crossings, slots);
                 Scatter(Splat(std::numeric_limits<float>::infinity()), p.t, slots);
                 Push(wave.queue(QueueId::kScattered), slots, valid);
               });
}

Stage InterfacesStage() {
  return {.name = "interfaces",
          .meaning = "takes out the paths that go through interfaces of media",
          .input = QueueId::kSurface,
          .role = StageRole::kMedia,
          .needs = {Feature::kInterfaces, Feature::kScatters},
          .reads = {Field::prim, Field::depth, Field::crossings, Field::medium,
                    Field::walked},
          .resolve = Always<Interfaces>};
}

Stage PassInterfacesStage() {
  const FieldSet ray = {Field::medium, Field::passed, Field::crossings, Field::t};
  return {.name = "pass_interfaces",
          .meaning = "sends paths on behind interfaces of media",
          .input = QueueId::kPassed,
          .role = StageRole::kMedia,
          .needs = {Feature::kInterfaces, Feature::kScatters},
          .reads = fields::kRay | fields::kPoint | fields::kNormal | ray |
                   FieldSet{Field::prim},
          .writes = fields::kRay | ray,
          .resolve = Always<PassInterfaces>};
}

LANELIGHT_END_KERNELS

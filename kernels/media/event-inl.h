// Stores events of paths in media, and moves these paths out of the queue of rays.
#ifndef LANELIGHT_MEDIA_EVENT_INL_H_
#define LANELIGHT_MEDIA_EVENT_INL_H_

#include "kernels/media/medium-inl.h"
#include "kernels/queue/depth-inl.h"

LANELIGHT_BEGIN_KERNELS

/// The throughput and the odds of the channels of a path.
struct SpectralThroughput {
  V3 beta, odds;

  LANELIGHT_INLINE SpectralThroughput(const PathColumns& p, const Slots& slots)
      : beta(Gather3(p.beta_r, p.beta_g, p.beta_b, slots)),
        odds(Gather3(p.odds_r, p.odds_g, p.odds_b, slots)) {}

  /// Applies an event of contribution f and densities pdf, both over any common factor.
  LANELIGHT_INLINE void ApplyEvent(V3 f, V3 pdf) {
    const V3 each = Mul(odds, pdf);
    const VF scale = hn::Div(Splat(1.0f), MeanChannel(each));
    beta = Mul(beta, Mul(f, scale));
    odds = Mul(each, scale);
  }
  LANELIGHT_INLINE void Store(const PathColumns& p, const StoreSlots& slots) const {
    Scatter3(beta, p.beta_r, p.beta_g, p.beta_b, slots);
    Scatter3(odds, p.odds_r, p.odds_g, p.odds_b, slots);
  }
};

/// Stores the point of the ray at `distance`, with a normal that looks back along it.
/// t = -1 marks the lanes of `event`; the surface stages overwrite the others later.
LANELIGHT_INLINE void StoreEvent(const PathColumns& p, const StoreSlots& slots, MF event,
                                 VF distance, VI material) {
  const V3 d = Gather3(p.d_x, p.d_y, p.d_z, slots), back = -d;
  const V3 at = MulAdd(d, distance, Gather3(p.o_x, p.o_y, p.o_z, slots));
  Scatter3(at, p.p_x, p.p_y, p.p_z, slots);
  Scatter(hn::Zero(DF()), p.p_error, slots);
  Scatter3(back, p.ng_x, p.ng_y, p.ng_z, slots);
  if (p.ns_x != nullptr) Scatter3(back, p.ns_x, p.ns_y, p.ns_z, slots);
  Scatter(material, p.material, slots);
  const VI none = hn::Set(DI(), static_cast<int32_t>(kNoPrimitive));
  const VI prim = Gather(p.prim, slots);
  Scatter(hn::IfThenElse(hn::RebindMask(DI(), event), none, prim), p.prim, slots);
  Scatter(hn::IfThenElse(event, Splat(-1.0f), Gather(p.t, slots)), p.t, slots);
}

/// Moves the paths with an event from kActive to kVertex, or to kDone if they may not
/// scatter any more.
LANELIGHT_INLINE void QueueEvents(Wave& wave) {
  const PathColumns& p = wave.path;
  Queue& active = wave.queue(QueueId::kActive);
  const uint32_t before = active.size;
  Queue rest = {active.items, 0};  // compacts in place: writes never pass reads
  const uint32_t lanes = static_cast<uint32_t>(hn::Lanes(DF()));
  PadTail(active);
  for (uint32_t i = 0; i < before; i += lanes) {
    const Slots slots(
        hn::LoadU(DI(), reinterpret_cast<const int32_t*>(active.items) + i));
    const MF valid = hn::FirstN(DF(), before - i);
    const MF event = hn::And(valid, hn::Lt(Gather(p.t, slots), hn::Zero(DF())));
    const MF below = MayScatter(wave, slots);
    Push(rest, slots, hn::AndNot(event, valid));
    Push(wave.queue(QueueId::kVertex), slots, hn::And(event, below));
    Push(wave.queue(QueueId::kDone), slots, hn::AndNot(below, event));
  }
  active.size = rest.size;
  wave.rays_closest += before - rest.size;  // the others are counted by the stage `split`
}

/// A stage that samples the events of rays in media of a kind.
inline Stage MediumEventStage(const char* name, const char* meaning, Feature kind,
                              StageFn (*resolve)(const FeatureSet&)) {
  const FieldSet ray = {Field::medium,  Field::u_medium_0, Field::u_medium_1,
                        Field::passed,  Field::crossings,  Field::odds_r,
                        Field::odds_g,  Field::odds_b,     Field::depth,
                        Field::walked,  Field::inside_r,   Field::inside_g,
                        Field::inside_b};
  const FieldSet odds = {Field::u_medium_0, Field::u_medium_1, Field::odds_r,
                         Field::odds_g, Field::odds_b};
  return {.name = name,
          .meaning = meaning,
          .input = QueueId::kActive,
          .role = StageRole::kMedia,
          .needs = {Feature::kMedia, kind},
          .reads = fields::kRay | fields::kThroughput | fields::kRadiance | ray |
                   FieldSet{Field::wavelength} |
                   FieldSet{Field::t, Field::prim, Field::pixel, Field::sample,
                            Field::depth, Field::branch},
          .writes = fields::kThroughput | fields::kRadiance | odds | fields::kPoint |
                    fields::kNormal | FieldSet{Field::t, Field::prim, Field::material},
          .resolve = resolve};
}

LANELIGHT_END_KERNELS

#endif

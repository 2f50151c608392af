// reuse=block: splits the light that glossy second vertices have gathered into the path's
// own part and the part that serves the block.
//
// A path shares the light that wide lobes scatter from a direction w: f_s(o, w) of f(o,
// w), o being the direction to its first vertex. Narrow lobes, such as the reflection of
// a coat, and mirrors are of no use to other paths. The shared part is divided by f(o,
// w), so that the f of any first vertex can replace it (kernels/reuse/glossy.cc). Both
// parts keep the densities and the weights with which the path has found them.
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/reuse/glossy-inl.h"

LANELIGHT_BEGIN_KERNELS

HWY_INLINE V3 Map(V3 v, VF (*of)(VF)) { return {of(v.x), of(v.y), of(v.z)}; }

// The light of a second vertex for its own path.
struct Gathered {
  V3 lit, hit, far, mirrored;

  HWY_INLINE Gathered(const Wave& wave, const Slots& records, VI at) {
    const GlossyColumns& c = wave.block->glossy;
    const VI state = hn::BitCast(DI(), Gather(wave.block->second.state, records));
    const auto is = [&](ReuseState s) HWY_ATTR {
      return hn::RebindMask(DF(), hn::Eq(state, StateLanes(s)));
    };
    const float* color = wave.buffer.samples + wave.block->sample;
    const std::size_t stride = wave.buffer.stride;
    const V3 all = Gather3(color, color + stride, color + 2 * stride, at);
    lit = Gather3(c.lit_r, c.lit_g, c.lit_b, records);
    const V3 near = Gather3(c.hit_r, c.hit_g, c.hit_b, records);
    const V3 onward = Above(IfThenElse(is(ReuseState::kFar), near, all), lit);
    hit = IfThenElse(is(ReuseState::kMirrored), Splat3(0, 0, 0), onward);
    mirrored = IfThenElseZero(is(ReuseState::kMirrored), Above(all, lit));
    far = IfThenElseZero(is(ReuseState::kFar), Above(all, near));
  }

 private:
  HWY_INLINE static V3 Above(V3 a, V3 b) {
    const VF zero = hn::Zero(DF());
    const V3 d = a - b;
    return {hn::Max(d.x, zero), hn::Max(d.y, zero), hn::Max(d.z, zero)};
  }
};

// Values of a direction for the path itself.
struct OwnValue {
  V3 inverse, fraction;  // 1 / f, and f_s / f
  VF shared_pdf;

  template <class Bsdf>
  HWY_INLINE OwnValue(const GlossyVertices<Bsdf>& y, V3 wo, V3 wi) {
    const BsdfValue all = Bsdf::Eval(y.material, wo, wi);
    const BsdfValue shared = EvalShared<Bsdf>(y.material, wo, wi);
    inverse = Map(all.f_cos, Inverse);
    const V3 ratio = Mul(shared.f_cos, inverse);
    fraction = Map(ratio, AtMostOne);
    shared_pdf = shared.pdf;
  }

 private:
  HWY_INLINE static VF Inverse(VF v) {
    return hn::IfThenElseZero(hn::Gt(v, Splat(std::numeric_limits<float>::min())),
                              hn::Div(Splat(1.0f), v));
  }
  HWY_INLINE static VF AtMostOne(VF v) { return hn::Min(v, Splat(1.0f)); }
};

HWY_INLINE V3 Rest(V3 fraction) { return Splat3(1, 1, 1) - fraction; }

HWY_INLINE void StoreShared(const Block& block, const Gathered& light,
                            const OwnValue& lit, const OwnValue& next,
                            const Slots& records) {
  const GlossyColumns& c = block.glossy;
  Scatter3(Mul(light.lit, lit.inverse), c.lit_r, c.lit_g, c.lit_b, records);
  Scatter3(Mul(light.hit, next.inverse), c.hit_r, c.hit_g, c.hit_b, records);
  const V3 far = Mul(Mul(light.far, next.inverse), next.shared_pdf);
  Scatter3(far, c.far_r, c.far_g, c.far_b, records);
  const V3 sent =
      Mul(light.lit, lit.fraction) + Mul(light.hit + light.far, next.fraction);
  Scatter(hn::Max(sent.x, hn::Max(sent.y, sent.z)), c.sent, records);
}

template <class Bsdf>
HWY_NOINLINE void SplitVector(Wave& wave, const Slots& records, VI at) {
  const Block& block = *wave.block;
  const GlossyColumns& c = block.glossy;
  const ReuseColumns& second = block.second;
  const GlossyVertices<Bsdf> y(block, records);
  const V3 wo = y.ToFirst(records);
  const OwnValue lit(y, wo, y.ToLight(records)), next(y, wo, y.ToNext(records));
  const Gathered light(wave, records, at);
  StoreShared(block, light, lit, next, records);
  const V3 own = Mul(light.lit, Rest(lit.fraction)) +
                 Mul(light.hit + light.far, Rest(next.fraction)) + light.mirrored;
  const V3 before = Gather3(second.before_r, second.before_g, second.before_b, records);
  const V3 color = before + Mul(Gather3(c.beta_r, c.beta_g, c.beta_b, records), own);
  float* red = wave.buffer.samples + block.sample;
  const std::size_t stride = wave.buffer.stride;
  Scatter3(color, red, red + stride, red + 2 * stride, at);
}

// Splits records of the tile of one kind, a vector at a time.
HWY_INLINE void SplitKind(Wave& wave, uint32_t kind) {
  const DI di;
  const Block& block = *wave.block;
  const auto lanes = static_cast<uint32_t>(hn::Lanes(di));
  const VI first = hn::Set(di, static_cast<int32_t>(block.sample * wave.work.num_pixels));
  const VI samples = hn::Set(di, static_cast<int32_t>(wave.work.samples));
  HWY_ALIGN uint32_t list[hn::MaxLanes(DI())];
  uint32_t n = 0;
  const auto flush = [&]() HWY_ATTR {
    if (n == 0) return;
    for (uint32_t i = n; i < lanes; ++i) list[i] = list[n - 1];
    const VI records = hn::Load(di, reinterpret_cast<const int32_t*>(list));
    const VI at = hn::Mul(hn::Sub(records, first), samples);
    OfGlossyKind(kind, [&]<class Bsdf>()
                           HWY_ATTR { SplitVector<Bsdf>(wave, Slots(records), at); });
    wave.lanes.items += n, wave.lanes.vectors += 1, n = 0;
  };
  for (uint32_t i = 0; i < block.size; ++i) {
    const uint32_t r = block.records[i];
    if (!IsReusableGlossy(block.second.state[r]) || GlossyKindOf(wave, r) != kind)
      continue;
    list[n++] = r;
    if (n == lanes) flush();
  }
  flush();
}

void SplitGlossy(Wave& wave) {
  for (uint32_t k = 0; k < kNumShadeKinds; ++k) {
    const bool there = wave.run->features.Has(ShadeFeature(static_cast<ShadeKind>(k)));
    if ((kGlossyKinds >> k & 1) != 0 && there) SplitKind(wave, k);
  }
}

Stage ReuseOwnLightStage() {
  return {.name = "reuse_own_light",
          .meaning = "splits gathered light into own and shared parts",
          .input = QueueId::kScratch,
          .role = StageRole::kBlock,
          .needs = {Feature::kReuseGlossy, Feature::kScatters},
          .scope = StageScope::kTile,
          .resolve = Always<SplitGlossy>};
}

// Keeps, for glossy second vertices whose light sample has been connected, its direction
// and light, and the direction in which the path continues.

HWY_INLINE void StoreOwnLight(const Wave& wave, const Slots& slots, VI record) {
  const PathColumns& p = wave.path;
  const GlossyColumns& glossy = wave.block->glossy;
  if (p.ls_x != nullptr) {
    Scatter3(Gather3(p.ls_x, p.ls_y, p.ls_z, slots), glossy.light_x, glossy.light_y,
             glossy.light_z, record);
  }
  Scatter3(Gather3(p.d_x, p.d_y, p.d_z, slots), glossy.next_x, glossy.next_y,
           glossy.next_z, record);
  Scatter3(Gather3(p.l_r, p.l_g, p.l_b, slots), glossy.lit_r, glossy.lit_g, glossy.lit_b,
           record);
}

void SecondVerticesLight(Wave& wave) {
  const PathColumns& p = wave.path;
  const Queue& shaded =
      FilterQueue(wave, wave.queue(QueueId::kVertex), [&](const Slots& slots) HWY_ATTR {
        const VI state = Gather(p.reuse, slots);
        return hn::RebindMask(DF(), hn::Eq(state, StateLanes(ReuseState::kGlossy)));
      });
  ForEachBatch(wave, shaded, [&](const Slots& slots, MF) HWY_ATTR {
    const VI record = RecordOf(wave.work, Gather(p.output, slots));
    StoreOwnLight(wave, slots, record);
    const MF mirrored = hn::Le(Gather(p.bsdf_pdf, slots), hn::Zero(DF()));
    const VI state =
        hn::IfThenElse(hn::RebindMask(DI(), mirrored), StateLanes(ReuseState::kMirrored),
                       StateLanes(ReuseState::kOnward));
    Scatter(state, p.reuse, slots);
    Scatter(state, wave.block->second.state, record);
  });
}

Stage SecondVerticesLightStage() {
  using namespace fields;
  return {.name = "reuse_light",
          .meaning = "keeps the light of glossy second vertices",
          .input = QueueId::kVertex,
          .role = StageRole::kRecord,
          .needs = {Feature::kReuseGlossy, Feature::kScatters},
          .reads = kRadiance | kLightSample |
                   FieldSet{Field::output, Field::bsdf_pdf, Field::reuse, Field::d_x,
                            Field::d_y, Field::d_z},
          .writes = {Field::reuse},
          .resolve = Always<SecondVerticesLight>};
}

LANELIGHT_END_KERNELS

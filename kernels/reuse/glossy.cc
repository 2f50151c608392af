// reuse=block: light that glossy second vertices send to each first one.
//
// Path j has found y from x_j, taken a light sample from direction w_l there, and
// continued in direction w_b. It gathered f(o_j, w), o_j being the direction to x_j,
// times a factor that is independent of o_j: another first vertex x_i gets that factor
// times f(o_i, w), of the shared lobes (kernels/reuse/own_light.cc). Three parts:
//
//   lit    by the light sample, from w_l
//   hit    of a lamp, or the environment, that the path meets next, from w_b
//   far    gathered after that, from w_b
//
//   weights    lit and hit: those of the pair (kernels/reuse/pairs.cc), and their own MIS
//              weights, whose sum is 1 for each j.
//              far: p_k(y) V_k g_k(w_b) / sum of the same. g_k is the density with which
//              the lobes at y scatter light from x_k to w_b
//   unbiased   both sets of weights sum to 1 over the k that may have found y (and w_b)
//   source     as kernels/reuse/pairs.cc; Veach and Guibas 1995
//
// Lanes are first vertices; the material of y is the same in all of them. The f of pairs
// then contains the light. Near parts (lit and hit) and a far part need a row of pairs
// each.
#include "kernels/simd/each_target-inl.h"

#include "kernels/reuse/glossy-inl.h"

LANELIGHT_BEGIN_KERNELS

// The light of a second vertex, the same in all lanes.
struct SentColors {
  V3 lit, hit, far;
  bool any_lit, any_hit, any_far;

  HWY_INLINE SentColors(const GlossyColumns& c, uint32_t r) {
    lit = Splat3(c.lit_r[r], c.lit_g[r], c.lit_b[r]);
    hit = Splat3(c.hit_r[r], c.hit_g[r], c.hit_b[r]);
    far = Splat3(c.far_r[r], c.far_g[r], c.far_b[r]);
    any_lit = IsAny(lit), any_hit = IsAny(hit), any_far = IsAny(far);
  }

 private:
  HWY_INLINE static bool IsAny(V3 c) {
    return hn::GetLane(hn::Max(c.x, hn::Max(c.y, c.z))) > 0;
  }
};

HWY_INLINE V3 LoadF(const PairColumns& pairs, uint32_t at) {
  const DF df;
  return {hn::LoadU(df, pairs.f_r + at), hn::LoadU(df, pairs.f_g + at),
          hn::LoadU(df, pairs.f_b + at)};
}

HWY_INLINE void StoreF(V3 f, const PairColumns& pairs, uint32_t at) {
  const auto finite = [](VF v)
                          HWY_ATTR { return hn::IfThenElseZero(IsPositiveFinite(v), v); };
  StoreAt({finite(f.x), finite(f.y), finite(f.z)}, pairs.f_r, pairs.f_g, pairs.f_b, at);
}

// The begin of the pairs of a second vertex, by part; one row serves a single part.
struct PartRows {
  uint32_t near, far;
};

HWY_INLINE PartRows MakeRows(Block& block, uint32_t s, const SentColors& light) {
  const uint32_t begin = s * block.num_receivers;
  SuffixRow& row = block.rows[s];
  const bool any_near = light.any_lit || light.any_hit;
  row.part = any_near ? SuffixPart::kNear : SuffixPart::kFar;
  if (!any_near || !light.any_far) return {begin, begin};
  const uint32_t added = block.num_rows++;
  block.rows[added] = row;
  block.rows[added].part = SuffixPart::kFar;
  return {begin, added * block.num_receivers};
}

template <class Bsdf>
HWY_NOINLINE void LightRow(Wave& wave, uint32_t s) {
  const DF df;
  Block& block = *wave.block;
  const PairColumns& pairs = block.pairs;
  const uint32_t r = block.rows[s].record;
  const Slots same(hn::Set(DI(), static_cast<int32_t>(r)));
  const GlossyVertices<Bsdf> y(block, same);
  const V3 to_light = y.ToLight(same), to_next = y.ToNext(same);
  const SentColors light(block.glossy, r);
  const PartRows rows = MakeRows(block, s, light);
  const uint32_t begin = s * block.num_receivers;
  for (uint32_t i = 0; i < block.num_receivers;
       i += static_cast<uint32_t>(hn::Lanes(df))) {
    const VI records = hn::BitCast(DI(), hn::LoadU(DU(), block.receivers + i));
    const V3 f = LoadF(pairs, begin + i), wo = y.ToFirst(Slots(records));
    V3 near = Splat3(0, 0, 0);
    if (light.any_lit) {
      near = Mul(EvalShared<Bsdf>(y.material, wo, to_light).f_cos, light.lit);
    }
    if (light.any_hit || light.any_far) {
      const BsdfValue next = EvalShared<Bsdf>(y.material, wo, to_next);
      near = near + Mul(next.f_cos, light.hit);
      if (light.any_far) {
        const VF pdf = hn::Mul(hn::LoadU(df, pairs.pdf_area + begin + i), next.pdf);
        StoreF(Mul(f, Mul(next.f_cos, light.far)), pairs, rows.far + i);
        hn::StoreU(pdf, df, pairs.pdf_area + rows.far + i);
      }
    }
    if (light.any_lit || light.any_hit) StoreF(Mul(f, near), pairs, rows.near + i);
  }
}

void LightGlossy(Wave& wave) {
  Block& block = *wave.block;
  for (uint32_t s = 0; s < block.num_suffixes; ++s) {
    const uint32_t record = block.rows[s].record;
    if (!IsReusableGlossy(block.second.state[record])) continue;
    OfGlossyKind(GlossyKindOf(wave, record),
                 [&]<class Bsdf>() HWY_ATTR { LightRow<Bsdf>(wave, s); });
    wave.lanes.items += block.size;
    wave.lanes.vectors += block.num_receivers / static_cast<uint32_t>(hn::Lanes(DF()));
  }
}

Stage ReuseGlossyStage() {
  return {.name = "reuse_glossy",
          .meaning = "evaluates light from glossy second vertices to all first ones",
          .input = QueueId::kScratch,
          .role = StageRole::kBlock,
          .needs = {Feature::kReuseGlossy, Feature::kScatters},
          .scope = StageScope::kBlock,
          .resolve = Always<LightGlossy>};
}

LANELIGHT_END_KERNELS

// reuse=block: keeps the first vertex of a path, and the second one.
//
// The first is the first vertex with a material of kReceivingKinds, possibly behind
// mirrors and clear glass: a property of the vertex, not of what is sampled there. The
// second is the next vertex, if the path left the first by a density. So first and second
// vertices partition the space of paths, whatever the samples are.
//
// A second vertex with a material of kEvenSidedKinds sends the same light to all
// directions on a side, so that other first vertices can use it: light gathered after it
// is kept apart from light before it, by a path with a throughput that begins with 1.
// Light of a glossy one depends on the incident direction: its material is kept as well,
// and the parts of its light separately (kernels/reuse/glossy.cc).
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/reuse/block-inl.h"

LANELIGHT_BEGIN_KERNELS

HWY_INLINE MF IsOfKinds(const Wave& wave, const Slots& slots, uint32_t kinds) {
  const DU du;
  const VI kind = Lookup(wave.materials->kind, Gather(wave.path.material, slots));
  const VU bit = hn::Shl(hn::Set(du, 1u), hn::BitCast(du, kind));
  return hn::RebindMask(DF(), hn::Ne(hn::And(bit, hn::Set(du, kinds)), hn::Zero(du)));
}

HWY_INLINE MF IsIn(const Wave& wave, const Slots& slots, ReuseState state) {
  const VI mine = Gather(wave.path.reuse, slots);
  return hn::RebindMask(DF(), hn::Eq(mine, StateLanes(state)));
}

HWY_INLINE void SetState(const Wave& wave, const Slots& slots, VI record,
                         ReuseState state) {
  Scatter(StateLanes(state), wave.path.reuse, slots);
  Scatter(StateLanes(state), wave.block->second.state, record);
}

HWY_INLINE VI RecordsOf(const Wave& wave, const Slots& slots) {
  return RecordOf(wave.work, Gather(wave.path.output, slots));
}

// A metal's lobe may be too narrow for other paths.
HWY_INLINE MF IsGlossy(const Wave& wave, const Slots& slots) {
  const PathColumns& p = wave.path;
  const MaterialTable& materials = *wave.materials;
  const VI material = Gather(p.material, slots);
  const VI kind = Lookup(materials.kind, material);
  const VI metal = hn::Set(DI(), static_cast<int32_t>(ShadeKind::kConductorRough));
  const auto alpha = [&](const float* column,
                         const AlignedVector<float>& table) HWY_ATTR {
    return column != nullptr ? Gather(column, slots) : Lookup(table, material);
  };
  const VF minimum =
      hn::Min(alpha(p.alpha_x, materials.alpha_x), alpha(p.alpha_y, materials.alpha_y));
  const MF wide = hn::Or(hn::RebindMask(DF(), hn::Ne(kind, metal)),
                         hn::Ge(minimum, Splat(kMinGlossyAlpha)));
  return hn::And(IsOfKinds(wave, slots, kGlossyKinds), wide);
}

HWY_INLINE void StoreColumns(const StoredColumns& columns, const Slots& slots,
                             VI record) {
  for (uint32_t c = 0; c < columns.count; ++c) {
    Scatter(Gather(columns.from[c], slots), columns.to[c], record);
  }
}

HWY_INLINE void StoreSecond(const Wave& wave, const Slots& slots, VI record) {
  const PathColumns& p = wave.path;
  const ReuseColumns& second = wave.block->second;
  const V3 d = Gather3(p.d_x, p.d_y, p.d_z, slots);
  const auto facing = [&](V3 n) HWY_ATTR {
    return IfThenElse(hn::Gt(Dot(n, d), hn::Zero(DF())), -n, n);
  };
  const V3 ng = facing(Gather3(p.ng_x, p.ng_y, p.ng_z, slots));
  const V3 ns = p.ns_x == nullptr ? ng : facing(Gather3(p.ns_x, p.ns_y, p.ns_z, slots));
  const V3 at = Gather3(p.p_x, p.p_y, p.p_z, slots);
  Scatter3(at, second.x, second.y, second.z, record);
  Scatter(Gather(p.p_error, slots), second.p_error, record);
  Scatter3(ng, second.ng_x, second.ng_y, second.ng_z, record);
  Scatter3(ns, second.ns_x, second.ns_y, second.ns_z, record);
  const V3 before = Gather3(p.l_r, p.l_g, p.l_b, slots);
  Scatter3(before, second.before_r, second.before_g, second.before_b, record);
}

// Roulette assumes that a suffix, which serves other paths too, is this many times as
// bright as for its own path, at most its own brightness. Efficiency relative to paths
// alone (128 x 128, 32 spp, blocks of 64) in dining-room, cornell-box and
// veach-ajar: 1.27, 4.9 and 3.0 for 4; 1.33, 4.3 and 3.0 for 1; 1.17, 4.9 and 3.0 without
// a limit.
constexpr float kSuffixBrightness = 4;

HWY_INLINE void BeginSuffix(const PathColumns& p, const StoreSlots& slots) {
  const VF brightest = MaxComponent(Gather3(p.beta_r, p.beta_g, p.beta_b, slots));
  const VF worth = hn::Min(hn::Mul(brightest, Splat(kSuffixBrightness)), Splat(1.0f));
  Scatter3(Splat3(0, 0, 0), p.l_r, p.l_g, p.l_b, slots);
  Scatter3(Splat3(1, 1, 1), p.beta_r, p.beta_g, p.beta_b, slots);
  Scatter(worth, p.eta_scale, slots);
}

// Curves, except ribbons, turn towards the ray that meets them: another path would find
// another point and normal.
HWY_INLINE MF IsSameToAll(const Wave& wave, const Slots& slots) {
  const VI curves = hn::Set(DI(), static_cast<int32_t>(wave.ranges->curves));
  return hn::RebindMask(DF(), hn::Lt(Gather(wave.path.prim, slots), curves));
}

// Returns the paths at a second vertex that they have found by a density.
HWY_INLINE MF FindsSecond(const Wave& wave, const Slots& slots) {
  MF found = hn::Gt(Gather(wave.path.bsdf_pdf, slots), hn::Zero(DF()));
  if (wave.run->features.Has(Feature::kCurves)) {
    found = hn::And(found, IsSameToAll(wave, slots));
  }
  return hn::And(IsIn(wave, slots, ReuseState::kFirst), found);
}

HWY_INLINE void RecordEven(Wave& wave, const Queue& vertices) {
  const Queue& serving = FilterQueue(wave, vertices, [&](const Slots& slots) HWY_ATTR {
    return hn::And(FindsSecond(wave, slots), IsOfKinds(wave, slots, kEvenSidedKinds));
  });
  ForEachBatch(wave, serving, [&](const StoreSlots& slots, MF) HWY_ATTR {
    const VI record = RecordsOf(wave, slots);
    StoreSecond(wave, slots, record);
    BeginSuffix(wave.path, slots);
    SetState(wave, slots, record, ReuseState::kSecond);
  });
}

HWY_INLINE void RecordGlossy(Wave& wave, const Queue& vertices) {
  const PathColumns& p = wave.path;
  const GlossyColumns& glossy = wave.block->glossy;
  const Queue& serving = FilterQueue(wave, vertices, [&](const Slots& slots) HWY_ATTR {
    return hn::And(FindsSecond(wave, slots), IsGlossy(wave, slots));
  });
  ForEachBatch(wave, serving, [&](const StoreSlots& slots, MF) HWY_ATTR {
    const VI record = RecordsOf(wave, slots);
    StoreSecond(wave, slots, record);
    StoreColumns(wave.block->glossy_columns, slots, record);
    Scatter3(Gather3(p.beta_r, p.beta_g, p.beta_b, slots), glossy.beta_r, glossy.beta_g,
             glossy.beta_b, record);
    BeginSuffix(p, slots);
    SetState(wave, slots, record, ReuseState::kGlossy);
  });
}

// Records, at the vertex after a glossy second one, its light from lights.
HWY_INLINE void RecordNear(Wave& wave, const Queue& vertices) {
  const PathColumns& p = wave.path;
  const GlossyColumns& glossy = wave.block->glossy;
  const Queue& far = FilterQueue(wave, vertices, [&](const Slots& slots) HWY_ATTR {
    return IsIn(wave, slots, ReuseState::kOnward);
  });
  ForEachBatch(wave, far, [&](const Slots& slots, MF) HWY_ATTR {
    const VI record = RecordsOf(wave, slots);
    Scatter3(Gather3(p.l_r, p.l_g, p.l_b, slots), glossy.hit_r, glossy.hit_g,
             glossy.hit_b, record);
    SetState(wave, slots, record, ReuseState::kFar);
  });
}

HWY_INLINE void RecordSeconds(Wave& wave) {
  const Queue& vertices = wave.queue(QueueId::kVertex);
  RecordEven(wave, vertices);
  if (wave.run->features.Has(Feature::kReuseGlossy)) {
    RecordNear(wave, vertices);
    RecordGlossy(wave, vertices);
  }
  const Queue& others = FilterQueue(wave, vertices, [&](const Slots& slots) HWY_ATTR {
    return IsIn(wave, slots, ReuseState::kFirst);
  });
  ForEachBatch(wave, others, [&](const Slots& slots, MF) HWY_ATTR {
    SetState(wave, slots, RecordsOf(wave, slots), ReuseState::kOwn);
  });
}

// Records the columns that the evaluation of a material reads, before the path scatters.
// The last batch may store a path twice: before its state changes and after.
HWY_INLINE void RecordFirsts(Wave& wave) {
  const Queue& mine =
      FilterQueue(wave, wave.queue(QueueId::kVertex), [&](const Slots& slots) HWY_ATTR {
        return hn::And(IsIn(wave, slots, ReuseState::kNoVertex),
                       IsOfKinds(wave, slots, kReceivingKinds));
      });
  ForEachBatch(wave, mine, [&](const Slots& slots, MF) HWY_ATTR {
    const VI record = RecordsOf(wave, slots);
    StoreColumns(wave.block->first_columns, slots, record);
    SetState(wave, slots, record, ReuseState::kFirst);
  });
}

// Second vertices come first, because a vertex is not both.
void SecondVertices(Wave& wave) {
  RecordSeconds(wave);
  RecordFirsts(wave);
}

Stage SecondVerticesStage() {
  using namespace fields;
  const FieldSet state = {Field::reuse, Field::eta_scale};
  return {.name = "reuse_second_vertices",
          .meaning = "keeps first and second vertices of paths for their block",
          .input = QueueId::kVertex,
          .role = StageRole::kRecord,
          .needs = {Feature::kReuse, Feature::kScatters},
          .reads = FirstVertexFields(true, true) | kRadiance | state |
                   FieldSet{Field::output, Field::bsdf_pdf, Field::prim},
          .writes = kRadiance | kThroughput | state,
          .resolve = Always<SecondVertices>};
}

LANELIGHT_END_KERNELS

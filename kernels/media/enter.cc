// Which medium a scattered ray enters: the one on its side of the surface. A ray that
// scattered in a medium, or on a surface with nothing beside it, stays where it is.
#include "kernels/simd/each_target-inl.h"

#include "kernels/media/medium-inl.h"
#include "kernels/queue/depth-inl.h"

LANELIGHT_BEGIN_KERNELS

// Interpolates the albedo of a medium in a table by the reflectance of a deep layer.
HWY_INLINE VF AlbedoOf(const MediumTable& media, VI table, VF reflectance) {
  const DI di;
  const VF at = hn::Mul(reflectance, Splat(kAlbedoTableSize - 1.0f));
  const VI cell =
      hn::Clamp(hn::ConvertTo(di, at), hn::Zero(di), hn::Set(di, kAlbedoTableSize - 2));
  const VI first = hn::Add(table, cell);
  const VF low = Gather(media.albedos.data(), first);
  const VF high = Gather(media.albedos.data(), hn::Add(first, hn::Set(di, 1)));
  const VF fraction = hn::Sub(at, hn::ConvertTo(DF(), cell));
  return hn::MulAdd(fraction, hn::Sub(high, low), low);
}

// Paths that enter a material with a textured medium keep the albedo at that point.
HWY_INLINE void EnterInside(const Wave& wave, const StoreSlots& slots, VI before,
                            VI after) {
  const PathColumns& p = wave.path;
  const Media medium(*wave.media, after);
  const MF changes = hn::And(hn::RebindMask(DF(), hn::Ne(before, after)),
                             hn::And(IsInMedium(after), medium.IsTextured()));
  const VI table = hn::Max(medium.I(offsetof(MediumRecord, albedos)), hn::Zero(DI()));
  const auto of = [&](VF reflectance)
                      HWY_ATTR { return AlbedoOf(*wave.media, table, reflectance); };
  const V3 color = Gather3(p.color0_r, p.color0_g, p.color0_b, slots);
  const V3 here = {of(color.x), of(color.y), of(color.z)};
  const V3 had = Gather3(p.inside_r, p.inside_g, p.inside_b, slots);
  Scatter3(IfThenElse(changes, here, had), p.inside_r, p.inside_g, p.inside_b, slots);
}

template <bool kInterfaces>
void Enter(Wave& wave) {
  const PathColumns& p = wave.path;
  const MediumTable& media = *wave.media;
  ForEachBatch(wave, wave.queue(QueueId::kScattered),
               [&](const StoreSlots& slots, MF) HWY_ATTR {
                 const V3 d = Gather3(p.d_x, p.d_y, p.d_z, slots);
                 const V3 ng = Gather3(p.ng_x, p.ng_y, p.ng_z, slots);
                 const Sides sides(media, Gather(p.prim, slots));
                 const VI before = Gather(p.medium, slots);
                 const VI after = sides.Toward(d, ng, before);
                 if (p.walked != nullptr) {
                   const auto free = hn::RebindMask(DI(), WalksInside(wave, slots));
                   const VI one = hn::IfThenElseZero(free, hn::Set(DI(), 1));
                   Scatter(hn::Add(Gather(p.walked, slots), one), p.walked, slots);
                 }
                 if (p.inside_r != nullptr) EnterInside(wave, slots, before, after);
                 Scatter(after, p.medium, slots);
                 if constexpr (kInterfaces) {
                   Scatter(hn::Zero(DF()), p.passed, slots);
                   Scatter(hn::Zero(DI()), p.crossings, slots);
                 }
               });
}

Stage EnterMediaStage() {
  const FieldSet ray = {Field::medium,   Field::passed,   Field::crossings, Field::walked,
                        Field::inside_r, Field::inside_g, Field::inside_b};
  return {.name = "enter_media",
          .meaning = "finds the medium that scattered rays enter",
          .input = QueueId::kScattered,
          .role = StageRole::kMedia,
          .needs = {Feature::kMediumChanges, Feature::kScatters},
          .reads = FieldSet{Field::d_x, Field::d_y, Field::d_z, Field::prim} |
                   fields::kNormal | ray |
                   FieldSet{Field::color0_r, Field::color0_g, Field::color0_b},
          .writes = ray,
          .resolve = ByFeature<Feature::kInterfaces, Enter<true>, Enter<false>>};
}

// Surfaces that only bound a medium (material "interface"): paths continue straight,
// without scattering or roulette. The first stage takes these paths out of the surfaces
// that scatter, and ends other paths at the max depth, which stage `limit` left to it.
// The second stage moves the origins of these paths behind the interface.

void Interfaces(Wave& wave) {
  const PathColumns& p = wave.path;
  const VI max_crossings = hn::Set(DI(), static_cast<int32_t>(kMaxInterfaceCrossings));
  Queue& surfaces = wave.queue(QueueId::kSurface);
  Queue rest = {surfaces.items, 0};  // compacts in place: writes never pass reads
  ForEachBatch(wave, surfaces, [&](const Slots& slots, MF valid) HWY_ATTR {
    const MF passes = hn::And(valid, Sides(*wave.media, Gather(p.prim, slots)).Passes());
    const MF stays = hn::AndNot(passes, valid);
    const MF below = MayScatter(wave, slots);
    const MF few =
        hn::RebindMask(DF(), hn::Lt(Gather(p.crossings, slots), max_crossings));
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
          .meaning = "separates paths that pass interfaces of media",
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
          .meaning = "continues paths behind interfaces of media",
          .input = QueueId::kPassed,
          .role = StageRole::kMedia,
          .needs = {Feature::kInterfaces, Feature::kScatters},
          .reads = fields::kRay | fields::kPoint | fields::kNormal | ray |
                   FieldSet{Field::prim},
          .writes = fields::kRay | ray,
          .resolve = Always<PassInterfaces>};
}

LANELIGHT_END_KERNELS

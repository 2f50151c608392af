// light-paths=splats: starts light subpaths at lights (kernels/light_paths/starts-inl.h).
//   estimator   Le cos / (p_A p_dir) of shapes, I / p_dir of lights with a position,
//               L / (p_dir p_origin) of lights at infinity
#include "kernels/simd/each_target-inl.h"

#include "kernels/generate/camera-inl.h"
#include "kernels/lights/intensity-inl.h"
#include "kernels/light_paths/shape_points-inl.h"
#include "kernels/light_paths/starts-inl.h"
#include "kernels/warp/sphere-inl.h"

LANELIGHT_BEGIN_KERNELS

// The start of a light subpath.
struct Start {
  V3 o, d;
  V3 light;    // radiance, intensity or irradiance of the light
  VF scale;    // factor that makes it the estimate; 0: no subpath starts
  VF chain;    // column lp_chain
  VF density;  // column lp_pdf
  MF behind = hn::FirstN(DF(), 0);  // starts on the inside of a shape
  VI cell = hn::Set(DI(), -1);      // of EmissionGuide, of lights at infinity

  HWY_INLINE void Take(MF mask, const Start& s) {
    o = IfThenElse(mask, s.o, o);
    d = IfThenElse(mask, s.d, d);
    light = IfThenElse(mask, s.light, light);
    scale = hn::IfThenElse(mask, s.scale, scale);
    chain = hn::IfThenElse(mask, s.chain, chain);
    density = hn::IfThenElse(mask, s.density, density);
    behind = hn::Or(hn::And(mask, s.behind), hn::AndNot(mask, behind));
    cell = hn::IfThenElse(hn::RebindMask(DI(), mask), s.cell, cell);
  }
};

// Random numbers for the start of a light subpath.
struct StartNumbers {
  VF select, alias, side;
  V2 place, direction;
  VF guide, cell, cell_alias;  // whether EmissionGuide is used, and a cell of it

  HWY_INLINE StartNumbers(const Wave& wave, const Slots& slots) {
    const DU du;
    const PathColumns& p = wave.path;
    LaneRandom random = {hn::BitCast(du, Gather(p.pixel, slots)),
                         hn::BitCast(du, Gather(p.sample, slots)), hn::Zero(du),
                         hn::Set(du, wave.run->seed ^ 0x51ed270bu)};
    VF u[4], v[4];
    random.Next4(u);
    random.Next4(v);
    select = u[0];
    place = {u[1], u[2]};
    direction = {u[3], v[0]};
    alias = v[1];
    side = v[2];
    if (GuideOf(wave) == nullptr) return;
    VF w[4];
    random.Next4(w);
    guide = v[3];
    cell = w[0];
    cell_alias = w[1];
  }
};

HWY_INLINE VI SelectStart(const LightStarts& table, const StartNumbers& u) {
  const VF count = Splat(static_cast<float>(table.alias.size()));
  const VI last = hn::Set(DI(), static_cast<int32_t>(table.alias.size()) - 1);
  const VI bin = hn::Min(hn::ConvertTo(DI(), hn::Mul(u.select, count)), last);
  const VF own = Gather(table.alias_q.data(), bin);
  return hn::IfThenElse(hn::RebindMask(DI(), hn::Lt(u.alias, own)), bin,
                        Gather(table.alias.data(), bin));
}

HWY_INLINE Start StartAtShape(const Wave& wave, const Lights& light, VI index,
                              const StartNumbers& u) {
  EmittedFrom from = PointOf(wave, light, u.place);
  const V3 share = ShareAtStart(wave, light, from);
  const MF second = hn::And(light.TwoSided(), hn::Lt(u.side, Splat(0.5f)));
  from.n = IfThenElse(second, -from.n, from.n);
  const V3 local = SampleCosineHemisphere(u.direction.x, u.direction.y);
  const VF clearance = hn::Mul(Splat(2e-6f), SumAbs(from.at));
  const VF density = AreaDensity(wave, light, index), per_cosine = PerCosine(light);
  const VF area =
      hn::IfThenElseZero(hn::Gt(density, hn::Zero(DF())), hn::Div(Splat(1.0f), density));
  return {MulAdd(from.n, clearance, from.at),
          Renormalize(FrameFromNormal(from.n).FromLocal(local)),
          Mul(light.Radiance(), share),
          hn::Div(area, per_cosine),
          hn::Mul(local.z, area),
          hn::Mul(local.z, per_cosine),
          second};
}

// Multiplies the light by the share of it that leaves in direction d.
HWY_INLINE void ScaleIntensity(const Wave& wave, const Lights& light, Start& start) {
  const LightEmission& emission = wave.chances->emission;
  if (emission.Has(LightShape::kSpot)) {
    const VF share = wave.lights->stretched_spots
                         ? SpotShare<true>(wave, light, start.d)
                         : SpotShare<false>(wave, light, start.d);
    const MF spot = HasShape(light, LightShape::kSpot);
    start.light = IfThenElse(spot, Mul(start.light, share), start.light);
  }
  const auto multiply = [&](auto kind) HWY_ATTR {
    using Kind = decltype(kind);
    if (!emission.Has(Kind::kShape)) return;
    const MF mine = HasShape(light, Kind::kShape);
    const VI image = hn::IfThenElseZero(hn::RebindMask(DI(), mine),
                                        light.I(offsetof(LightRecord, image)));
    const V3 value = Kind::Intensity(LightImages(*wave.lights, image), start.d);
    start.light = IfThenElse(mine, Mul(start.light, value), start.light);
  };
  multiply(Goniometric());
  multiply(Projection());
}

HWY_INLINE Start StartAtPosition(const Wave& wave, const Lights& light, VF inverse_pmf,
                                 const StartNumbers& u) {
  const StartCone cone(wave, light);
  const VF below = hn::Mul(cone.versine, u.direction.x);  // 1 - cos
  const VF sin2 = hn::Mul(below, hn::Sub(Splat(2.0f), below));
  const V3 local = FromHeight(hn::Sub(Splat(1.0f), below), sin2, u.direction.y);
  const VF pdf = cone.Pdf();
  Start start = {light.F3(offsetof(LightRecord, position)),
                 Renormalize(FrameFromNormal(cone.axis).FromLocal(local)),
                 light.Radiance(),
                 hn::Div(inverse_pmf, pdf),
                 hn::Zero(DF()),
                 pdf};
  ScaleIntensity(wave, light, start);
  return start;
}

// Returns a place on the disk, or where the guide says.
HWY_INLINE DiskPlace SamplePlace(const Wave& wave, const GuideSquare& square,
                                 const StartNumbers& u) {
  const V2 at = SampleDisk(u.place.x, u.place.y);
  const EmissionGuide* guide = GuideOf(wave);
  if (guide == nullptr) return {at.x, at.y};
  const DI di;
  const int32_t cells = static_cast<int32_t>(square.side * square.side);
  const VF scaled = hn::Mul(u.cell, Splat(static_cast<float>(cells)));
  VI local = hn::Min(hn::ConvertTo(di, scaled), hn::Set(di, cells - 1));
  const VI entry = hn::Add(hn::Max(square.first, hn::Zero(di)), local);
  const MF own = hn::Lt(u.cell_alias, Gather(guide->alias_q.data(), entry));
  local =
      hn::IfThenElse(hn::RebindMask(di, own), local, Gather(guide->alias.data(), entry));
  const VF side = Splat(static_cast<float>(square.side)), one = Splat(1.0f);
  const VF row =
      hn::Floor(hn::Div(hn::Add(hn::ConvertTo(DF(), local), Splat(0.5f)), side));
  const VF column = hn::NegMulAdd(row, side, hn::ConvertTo(DF(), local));
  const VF unit = Splat(2 / static_cast<float>(square.side));
  // Not at the very edge, so that rounding does not lead to the next cell.
  const auto inside = [](VF v) HWY_ATTR {
    return hn::Min(hn::Max(v, Splat(0x1p-18f)), Splat(1 - 0x1p-18f));
  };
  const VF x = hn::MulSub(hn::Add(column, inside(u.place.x)), unit, one);
  const VF y = hn::MulSub(hn::Add(row, inside(u.place.y)), unit, one);
  const MF guided = hn::And(hn::Ge(u.guide, Splat(EmissionGuide::kDefensive)),
                            hn::RebindMask(DF(), hn::Gt(square.first, hn::Set(di, -1))));
  return {hn::IfThenElse(guided, x, at.x), hn::IfThenElse(guided, y, at.y)};
}

// Light from the direction `toward` it, whose density is 1 / `inverse`.
struct FarLight {
  V3 toward, light;
  VF inverse;
  GuideSquare square;
};

// Returns the start for it. E never finds it, unless the caller sets `chain`.
HWY_INLINE Start FromDisk(const Wave& wave, const FarLight& far, const StartNumbers& u) {
  const LightTable& table = *wave.lights;
  const auto& [toward, light, inverse, square] = far;
  const DiskPlace place = SamplePlace(wave, square, u);
  const VF radius = Splat(table.radius), density = OriginDensity(wave, square, place);
  const V3 center = Splat3(table.center[0], table.center[1], table.center[2]);
  const V3 local = {hn::Mul(place.x, radius), hn::Mul(place.y, radius), radius};
  const V3 o = center + FrameFromNormal(toward).FromLocal(local);
  VF scale = hn::Div(inverse, density);
  if (HasPlanes(wave)) {
    scale = hn::IfThenZeroElse(IsBehindPlane(wave, o, toward), scale);
  }
  const VI none = hn::Set(DI(), -1);
  const VI cell =
      hn::IfThenElse(hn::RebindMask(DI(), square.HasCells()), square.CellOf(place), none);
  const MF nowhere = hn::FirstN(DF(), 0);
  return {o, -toward, light, scale, hn::Zero(DF()), hn::Neg(density), nowhere, cell};
}

// Takes the starts of infinite lights, one image after the other.
HWY_INLINE void TakeSky(const Wave& wave, const Lights& light, VF inverse_pmf,
                        const StartNumbers& u, Start& start) {
  const LightTable& table = *wave.lights;
  const auto take = [&](MF mine, V3 toward, V3 radiance, VF pdf_sa) HWY_ATTR {
    const VF inverse = hn::Div(inverse_pmf, pdf_sa);
    Start from =
        FromDisk(wave, {toward, radiance, inverse, SquareOfSky(wave, toward)}, u);
    // At the edges of texels the two may differ.
    const VF density = SkyDensity(wave, toward);
    from.chain = hn::Min(inverse, hn::Div(Splat(1.0f), density));
    start.Take(mine, from);
  };
  const MF constant = HasShape(light, LightShape::kInfiniteConstant);
  if (!hn::AllFalse(DF(), constant)) {
    const VF z = hn::NegMulAdd(Splat(2.0f), u.direction.x, Splat(1.0f));
    const VF sin2 = hn::NegMulAdd(z, z, Splat(1.0f));
    take(constant, FromHeight(z, sin2, u.direction.y), light.Radiance(),
         Splat(0.25f * kInvPi));
  }
  for (std::size_t e = 0; e < table.environments.size(); ++e) {
    const VI number = light.I(offsetof(LightRecord, environment));
    const MF mine = hn::And(
        HasShape(light, LightShape::kInfiniteImage),
        hn::RebindMask(DF(), hn::Eq(number, hn::Set(DI(), static_cast<int32_t>(e)))));
    if (hn::AllFalse(DF(), mine)) continue;
    const Environment& map = table.environments[e];
    const MapSample s = SampleEnvironment(map, *map.table, u.direction.x, u.direction.y);
    take(mine, Renormalize(s.direction), s.radiance, s.pdf_sa);
  }
}

HWY_INLINE Start StartAt(const Wave& wave, const Lights& light, VI index,
                         const StartNumbers& u) {
  const LightEmission& emission = wave.chances->emission;
  const VF zero = hn::Zero(DF());
  const V3 none = Splat3(0, 0, 0);
  const VF inverse_pmf = hn::Div(Splat(1.0f), StartPmf(wave, index));
  Start start = {none, Splat3(0, 0, 1), none, zero, zero, zero};
  if (emission.HasAny(kEmittingShape)) start = StartAtShape(wave, light, index, u);
  if (StartAtPositions(emission)) {
    const MF mine = HasPosition(light);
    if (!hn::AllFalse(DF(), mine)) {
      start.Take(mine, StartAtPosition(wave, light, inverse_pmf, u));
    }
  }
  if (emission.Has(LightShape::kDistant)) {
    const MF mine = HasShape(light, LightShape::kDistant);
    const V3 toward =
        IfThenElse(mine, light.F3(offsetof(LightRecord, direction)), Splat3(0, 0, 1));
    start.Take(mine, FromDisk(wave,
                              {toward, light.Radiance(), inverse_pmf,
                               SquareOfDistant(wave, index)},
                              u));
  }
  if (StartAtSky(emission)) TakeSky(wave, light, inverse_pmf, u, start);
  return start;
}

// Stores where subpaths start, for a training pass: the cell, or else the number of cells
// plus the index of the light.
HWY_INLINE void StoreStart(const Wave& wave, const StoreSlots& slots, VI index, VI cell) {
  if (wave.light_splats->starts == nullptr) return;
  const VI behind = hn::Set(DI(), static_cast<int32_t>(GuideOf(wave)->num_cells));
  const VI start =
      hn::IfThenElse(hn::Lt(cell, hn::Zero(DI())), hn::Add(behind, index), cell);
  Scatter(start, reinterpret_cast<int32_t*>(wave.light_splats->starts),
          Gather(wave.path.output, slots));
}

// Stores the medium around the light, where not all of them are in the camera's.
HWY_INLINE void StoreMedium(const Wave& wave, const StoreSlots& slots, VI index,
                            MF behind) {
  const AlignedVector<int32_t>& media = wave.chances->emission.media;
  if (wave.path.medium == nullptr || media.empty()) return;
  const VI second = hn::ShiftLeft<1>(index), first = hn::Add(second, hn::Set(DI(), 1));
  const VI side = hn::IfThenElse(hn::RebindMask(DI(), behind), second, first);
  Scatter(Gather(media.data(), side), wave.path.medium, slots);
}

void EmitLightPath(Wave& wave) {
  const PathColumns& p = wave.path;
  ForEachBatch(wave, wave.queue(QueueId::kCamera),
               [&](const StoreSlots& slots, MF valid) HWY_ATTR {
                 StoreFirstValues(wave, slots);
                 const StartNumbers u(wave, slots);
                 const VI index = SelectStart(StartsOf(wave), u);
                 const Lights light(wave, index);
                 const Start start = StartAt(wave, light, index, u);
                 const V3 leaves = AsCarried(wave, slots, index, start.light);
                 const VF brightest = MaxComponent(leaves);
                 const MF starts = hn::And(IsPositiveFinite(start.scale),
                                           hn::Gt(brightest, hn::Zero(DF())));
                 Scatter3(start.o, p.o_x, p.o_y, p.o_z, slots);
                 Scatter3(start.d, p.d_x, p.d_y, p.d_z, slots);
                 Scatter3(Mul(leaves, hn::Div(Splat(1.0f), brightest)), p.beta_r,
                          p.beta_g, p.beta_b, slots);
                 Scatter(hn::Mul(brightest, start.scale), p.lp_scale, slots);
                 Scatter(start.chain, p.lp_chain, slots);
                 Scatter(start.density, p.lp_pdf, slots);
                 Scatter(light.Primitive(), p.prim, slots);
                 StoreStart(wave, slots, index, start.cell);
                 StoreMedium(wave, slots, index, start.behind);
                 Push(wave.queue(QueueId::kActive), slots, hn::And(valid, starts));
                 Push(wave.queue(QueueId::kDone), slots, hn::AndNot(starts, valid));
               });
}

void EndLightPath(Wave& wave) {
  ForEachBatch(wave, wave.queue(QueueId::kDone),
               [&](const Slots& slots, MF valid)
                   HWY_ATTR { Push(wave.queue(QueueId::kFree), slots, valid); });
}

Stage EmitLightPathStage() {
  return {.name = "emit",
          .meaning = "starts light subpaths",
          .input = QueueId::kCamera,
          .role = StageRole::kCamera,
          .needs = {Feature::kLightSubpath},
          .reads = {Field::pixel, Field::sample, Field::wavelength},
          .writes = fields::kRay | fields::WithFirstValue() |
                    FieldSet{Field::medium, Field::weight},
          .resolve = Always<EmitLightPath>};
}

Stage EndLightPathStage() {
  return {.name = "end_light_path",
          .meaning = "frees the slots of light subpaths",
          .input = QueueId::kDone,
          .role = StageRole::kSort,
          .needs = {Feature::kLightSubpath},
          .resolve = Always<EndLightPath>};
}

LANELIGHT_END_KERNELS

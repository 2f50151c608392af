// light-paths=splats: starts a light subpath at a point of an emitting shape, chosen by
// the probability of the light and uniform over its area, in a direction distributed like
// the cosine.
//   estimator   Le cos / (p_A p_dir) = Le pi area / pmf
#include "kernels/simd/each_target-inl.h"

#include "kernels/generate/camera-inl.h"
#include "kernels/lights/geometry-inl.h"
#include "kernels/light_paths/chain-inl.h"
#include "kernels/warp/sphere-inl.h"

LANELIGHT_BEGIN_KERNELS

struct EmittedFrom {
  V3 at, n;

  HWY_INLINE void Take(MF mask, V3 other_at, V3 other_n) {
    at = IfThenElse(mask, other_at, at);
    n = IfThenElse(mask, other_n, n);
  }
};

// Returns a primitive of the shape in all lanes: that of lights that have it.
HWY_INLINE VI PrimitiveOf(const Lights& light, MF has_shape, uint32_t any) {
  return hn::IfThenElse(hn::RebindMask(DI(), has_shape), light.Primitive(),
                        hn::Set(DI(), static_cast<int32_t>(any)));
}

HWY_INLINE void TakeTriangle(const Wave& wave, const Lights& light, V2 u,
                             EmittedFrom& from) {
  const MF mine = HasShape(light, LightShape::kTriangle);
  if (hn::AllFalse(DF(), mine)) return;
  const LightTriangle t(wave, PrimitiveOf(light, mine, 0));
  const VF root = hn::Sqrt(u.x);
  const V3 at = MulAdd(t.e1, hn::Mul(root, hn::Sub(Splat(1.0f), u.y)),
                       MulAdd(t.e2, hn::Mul(root, u.y), t.p0));
  from.Take(mine, at, t.n);
}

HWY_INLINE void TakeSphere(const Wave& wave, const Lights& light, V2 u,
                           EmittedFrom& from) {
  const MF mine = HasShape(light, LightShape::kSphere);
  if (hn::AllFalse(DF(), mine)) return;
  const LightSphere sphere(wave, PrimitiveOf(light, mine, wave.ranges->spheres));
  const VF z = hn::NegMulAdd(Splat(2.0f), u.x, Splat(1.0f));
  const VF ring = hn::Sqrt(hn::Max(hn::NegMulAdd(z, z, Splat(1.0f)), Splat(0)));
  const auto [sine, cosine] = SinCos2Pi(u.y);
  const V3 n = {hn::Mul(ring, cosine), hn::Mul(ring, sine), z};
  from.Take(mine, MulAdd(n, sphere.radius, sphere.center), Mul(n, sphere.normal_sign));
}

HWY_INLINE void TakeDisk(const Wave& wave, const Lights& light, V2 u, EmittedFrom& from) {
  const MF mine = HasShape(light, LightShape::kDisk);
  if (hn::AllFalse(DF(), mine)) return;
  const LightDisk disk(wave, PrimitiveOf(light, mine, wave.ranges->disks));
  const VF inner2 = hn::Mul(disk.inner_radius, disk.inner_radius);
  const VF outer2 = hn::Mul(disk.radius, disk.radius);
  const VF r = hn::Sqrt(hn::MulAdd(u.x, hn::Sub(outer2, inner2), inner2));
  const auto [sine, cosine] = SinCos2Pi(u.y);
  const ShadingFrame frame = FrameFromNormal(disk.n);
  const V3 at = frame.FromLocal({hn::Mul(r, cosine), hn::Mul(r, sine), Splat(0)});
  from.Take(mine, disk.center + at, disk.n);
}

// Returns a point of the light, uniform over its area, with the normal.
HWY_INLINE EmittedFrom PointOf(const Wave& wave, const Lights& light, V2 u) {
  const LightRectangle r(light);
  EmittedFrom from = {r.At(hn::Mul(u.x, r.size_x), hn::Mul(u.y, r.size_y)), r.n};
  if (hn::AllTrue(DF(), HasShape(light, LightShape::kRectangle))) return from;
  TakeTriangle(wave, light, u, from);
  TakeSphere(wave, light, u, from);
  TakeDisk(wave, light, u, from);
  return from;
}

// The light with the cumulative probability u, among those that emit subpaths.
HWY_INLINE VI SelectEmitter(const Wave& wave, VF u) {
  const LightChances& table = *wave.chances;
  const VF scaled = hn::Mul(u, Splat(static_cast<float>(table.alias.size())));
  const VI last = hn::Set(DI(), static_cast<int32_t>(table.alias.size()) - 1);
  if (table.alias.empty()) return hn::Zero(DI());
  const VI bin = hn::Min(hn::ConvertTo(DI(), scaled), last);
  const VF fraction = hn::Sub(scaled, hn::ConvertTo(DF(), bin));
  const auto keep =
      hn::RebindMask(DI(), hn::Lt(fraction, Gather(table.alias_q.data(), bin)));
  return hn::IfThenElse(keep, bin, Gather(table.alias.data(), bin));
}

void EmitLightPath(Wave& wave) {
  const PathColumns& p = wave.path;
  const DU du;
  ForEachBatch(wave, wave.queue(QueueId::kCamera),
               [&](const StoreSlots& slots, MF valid) HWY_ATTR {
                 StoreFirstValues(wave, slots);
                 LaneRandom random = {hn::BitCast(du, Gather(p.pixel, slots)),
                                      hn::BitCast(du, Gather(p.sample, slots)),
                                      hn::Zero(du),
                                      hn::Set(du, wave.run->seed ^ 0x51ed270bu)};
                 VF u[4], v[4];
                 random.Next4(u);
                 random.Next4(v);
                 const VI index = SelectEmitter(wave, u[0]);
                 const Lights light(wave, index);
                 const EmittedFrom from = PointOf(wave, light, {u[1], u[2]});
                 const ShadingFrame frame = FrameFromNormal(from.n);
                 const V3 local = SampleCosineHemisphere(u[3], v[0]);
                 const V3 d = Renormalize(frame.FromLocal(local));
                 const VF density = EmissionDensity(wave, light, index);
                 const VF area = hn::Div(Splat(1.0f), density);
                 const V3 radiance = AsCarried(wave, slots, index, light.Radiance());
                 const VF brightest = MaxComponent(radiance);
                 const VF least = hn::Min(density, hn::Min(local.z, brightest));
                 const MF emits = hn::Gt(least, hn::Zero(DF()));
                 const VF clearance = hn::Mul(Splat(2e-6f), SumAbs(from.at));
                 Scatter3(MulAdd(from.n, clearance, from.at), p.o_x, p.o_y, p.o_z, slots);
                 Scatter3(d, p.d_x, p.d_y, p.d_z, slots);
                 Scatter3(Mul(radiance, hn::Div(Splat(1.0f), brightest)), p.beta_r,
                          p.beta_g, p.beta_b, slots);
                 Scatter(hn::Mul(hn::Mul(brightest, area), Splat(3.14159265358979f)),
                         p.lp_scale, slots);
                 Scatter(hn::Mul(local.z, area), p.lp_chain, slots);
                 Scatter(hn::Mul(local.z, Splat(0.318309886183791f)), p.lp_pdf, slots);
                 Scatter(light.Primitive(), p.prim, slots);
                 Push(wave.queue(QueueId::kActive), slots, hn::And(valid, emits));
                 Push(wave.queue(QueueId::kDone), slots, hn::AndNot(emits, valid));
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

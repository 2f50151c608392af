// light-paths=splats: weights of light that camera paths find, against light subpaths,
// and the reverse (kernels/light_paths/chain-inl.h).
#include "kernels/simd/each_target-inl.h"

#include "kernels/light_paths/camera_view-inl.h"
#include "kernels/light_paths/starts-inl.h"
#include "kernels/lights/flat_hits-inl.h"
#include "kernels/lights/geometry-inl.h"
#include "kernels/lights/round_hits-inl.h"

LANELIGHT_BEGIN_KERNELS

// Returns the paths whose light subpath connects at its last vertex.
HWY_INLINE MF IsCovered(VI number) {
  return hn::And(IsAtLeast(number, 1), IsAtMost(number, kMaxLightVertices));
}

// Returns the normal of shapes at a point on them; of other lights anything.
HWY_INLINE V3 NormalOfLight(const Wave& wave, const Lights& light, V3 at) {
  V3 n = LightRectangle(light).n;
  const MF rectangle = HasShape(light, LightShape::kRectangle);
  if (hn::AllTrue(DF(), rectangle)) return n;
  const MF triangle = HasShape(light, LightShape::kTriangle);
  if (!hn::AllFalse(DF(), triangle)) {
    n = IfThenElse(triangle, LightTriangle(wave, PrimitiveOf(light, triangle, 0)).n, n);
  }
  const MF disk = HasShape(light, LightShape::kDisk);
  if (!hn::AllFalse(DF(), disk)) {
    n = IfThenElse(disk, LightDisk(wave, PrimitiveOf(light, disk, wave.ranges->disks)).n,
                   n);
  }
  const MF round = HasShape(light, LightShape::kSphere);
  if (!hn::AllFalse(DF(), round)) {
    const LightSphere sphere(wave, PrimitiveOf(light, round, wave.ranges->spheres));
    n = IfThenElse(round, Normalize(at - sphere.center), n);
  }
  return n;
}

// Returns the step to the light sample.
HWY_NOINLINE LastStep StepToSample(const Wave& wave, const Slots& slots) {
  const PathColumns& p = wave.path;
  const LightEmission& emission = wave.chances->emission;
  const V3 to_light = Gather3(p.ls_x, p.ls_y, p.ls_z, slots);
  const VI index = p.ls_light == nullptr ? hn::Zero(DI()) : Gather(p.ls_light, slots);
  const Lights light(wave, index);
  const VF zero = hn::Zero(DF()), one = Splat(1.0f);
  const VF distance = Gather(p.ls_distance, slots);
  LastStep step = {zero, one, hn::Lt(one, zero)};
  const V3 from = Gather3(p.p_x, p.p_y, p.p_z, slots);
  if (emission.HasAny(kEmittingShape)) {
    const V3 at = MulAdd(to_light, distance, from);
    const VF cosine = hn::Abs(Dot(NormalOfLight(wave, light, at), to_light));
    step = StepToShape(wave, light, index, distance, cosine);
  }
  const MF starts = hn::Gt(StartPmf(wave, index), zero);
  if (StartAtPositions(emission)) {
    const VF rate = hn::Div(StartCone(wave, light).Pdf(), hn::Mul(distance, distance));
    step.Take(hn::And(starts, HasPosition(light)), {rate, one, hn::Lt(one, zero)});
  }
  if (emission.Has(LightShape::kDistant)) {
    step.Take(hn::And(starts, HasShape(light, LightShape::kDistant)),
              {DensityFromDisk(wave, from, to_light, SquareOfDistant(wave, index)), one,
               hn::Lt(one, zero)});
  }
  if (StartAtSky(emission)) {
    const MF sky = hn::Or(HasShape(light, LightShape::kInfiniteConstant),
                          HasShape(light, LightShape::kInfiniteImage));
    if (!hn::AllFalse(DF(), sky)) step.Take(sky, StepToSky(wave, from, to_light));
  }
  return step;
}

template <class Bsdf>
HWY_NOINLINE void WeighSamplesOf(Wave& wave, const Queue& queue) {
  const PathColumns& p = wave.path;
  const SurfaceReader<Bsdf> reader(wave);
  ForEachBatch(wave, queue, [&](const StoreSlots& slots, MF) HWY_ATTR {
    const ChainVertex<Bsdf> vertex(reader, slots);
    const V3 to_light = Gather3(p.ls_x, p.ls_y, p.ls_z, slots);
    const V3 wi = vertex.frame.ToLocal(to_light);
    const BothDensities<Bsdf> pdf(vertex.material, vertex.wo, wi);
    const VI number = Gather(p.lp_vertex, slots);
    const LastStep step = StepToSample(wave, slots);
    const VF chain = hn::IfThenElse(IsNumber(number, 1), Splat(1.0f),
                                    hn::Mul(Gather(p.lp_chain, slots), pdf.back));
    const VF cosine = vertex.Cosine(to_light);
    const VF ratio = hn::Mul(hn::Mul(hn::Mul(chain, Gather(p.lp_inverse, slots)), cosine),
                             step.subpath);
    const VF found = hn::Add(hn::IfThenElseZero(step.can_hit, pdf.forward), step.sample);
    const MF any = hn::And(IsCovered(number), hn::Gt(step.subpath, hn::Zero(DF())));
    const VF weight = hn::IfThenElse(any, CameraWeight(wave, ratio, found), Splat(1.0f));
    const V3 carried = Gather3(p.sh_r, p.sh_g, p.sh_b, slots);
    Scatter3(Mul(carried, weight), p.sh_r, p.sh_g, p.sh_b, slots);
  });
}

// Light vertices that connect to the camera; T / (T + E + N).
template <class Bsdf>
HWY_NOINLINE void WeighSplatsOf(Wave& wave, const Queue& queue) {
  const PathColumns& p = wave.path;
  const CameraView view(*wave.camera);
  const SurfaceReader<Bsdf> reader(wave);
  const VF n = Splat(wave.light_splats->paths_per_sample);
  ForEachBatch(wave, queue, [&](const StoreSlots& slots, MF) HWY_ATTR {
    const ChainVertex<Bsdf> vertex(reader, slots);
    const V3 to_camera = Gather3(p.ls_x, p.ls_y, p.ls_z, slots);
    const V3 wi = vertex.frame.ToLocal(to_camera);
    const VF back = Bsdf::Eval(vertex.material, wi, vertex.wo).pdf;
    const VF chain = hn::Mul(Gather(p.lp_chain, slots), back);
    const VF through = hn::IfThenElse(IsNumber(Gather(p.lp_vertex, slots), 1),
                                      hn::Add(chain, Splat(1.0f)), chain);
    const VF distance = Gather(p.ls_distance, slots);
    const VF cosine = vertex.Cosine(to_camera);
    const VF density =
        hn::Div(hn::Mul(view.Density(-to_camera), cosine), hn::Mul(distance, distance));
    const VF others = hn::Mul(hn::Mul(density, Gather(p.lp_inverse, slots)), through);
    const VF inverse = hn::Div(Splat(1.0f), hn::Add(n, others));
    const VF weight = hn::Mul(n, inverse);
    Scatter(hn::Mul(others, inverse), wave.light_splats->share, EntryOf(p, slots));
    const V3 carried = Gather3(p.sh_r, p.sh_g, p.sh_b, slots);
    Scatter3(Mul(carried, weight), p.sh_r, p.sh_g, p.sh_b, slots);
  });
}

template <bool kLight>
void WeighConnections(Wave& wave) {
  ForEachShaded(wave, [&]<class Bsdf>(Queue& queue) HWY_ATTR {
    if constexpr (!Bsdf::kSpecular && !kLight) WeighSamplesOf<Bsdf>(wave, queue);
    if constexpr (!Bsdf::kSpecular && kLight) WeighSplatsOf<Bsdf>(wave, queue);
  });
}

// A path whose ray has found a light by this step.
HWY_INLINE void WeighFound(const Wave& wave, const StoreSlots& slots,
                           const LastStep& step) {
  const PathColumns& p = wave.path;
  const VI number = Gather(p.lp_vertex, slots);
  const MF by_density = hn::Gt(Gather(p.bsdf_pdf, slots), hn::Zero(DF()));
  const VF found =
      hn::Add(Gather(p.lp_pdf, slots), hn::IfThenElseZero(by_density, step.sample));
  const VF ratio = hn::Mul(Gather(p.lp_chain, slots), step.subpath);
  const MF any = hn::And(IsCovered(number), hn::Gt(step.subpath, hn::Zero(DF())));
  Scatter(hn::IfThenElse(any, CameraWeight(wave, ratio, found), Splat(1.0f)),
          p.hit_weight, slots);
}

// A path whose ray has hit a light at a point with the normal n.
HWY_INLINE void WeighHit(const Wave& wave, const StoreSlots& slots, VI index, V3 n) {
  const PathColumns& p = wave.path;
  const V3 d = Gather3(p.d_x, p.d_y, p.d_z, slots);
  const Lights light(wave, index);
  WeighFound(wave, slots,
             StepToShape(wave, light, index, HitDistance(p, slots), hn::Abs(Dot(n, d))));
}

template <LightShape kShape>
HWY_INLINE void WeighFlatHits(Wave& wave) {
  ForEachBatch(wave, HitsOf(wave, kShape), [&](const StoreSlots& slots, MF) HWY_ATTR {
    const VI prim = Gather(wave.path.prim, slots);
    WeighHit(wave, slots, LightOfTriangle(wave, prim), LightTriangle(wave, prim).n);
  });
}

template <class Shape>
HWY_INLINE void WeighRoundHits(Wave& wave) {
  const PathColumns& p = wave.path;
  ForEachBatch(wave, RoundHitsOf<Shape>(wave), [&](const StoreSlots& slots, MF) HWY_ATTR {
    const VI prim = Gather(p.prim, slots);
    const V3 d = Gather3(p.d_x, p.d_y, p.d_z, slots);
    WeighHit(wave, slots, LightOfRound<Shape>(wave, prim),
             Shape(wave, p, slots, prim, d).n);
  });
}

void WeighHits(Wave& wave) {
  if (!wave.chances->emission.HasAny(kEmittingShape)) return;
  const FeatureSet& features = wave.run->features;
  if (features.Has(Feature::kTriangleLights)) {
    WeighFlatHits<LightShape::kTriangle>(wave);
  }
  if (features.Has(Feature::kRectangleLights)) {
    WeighFlatHits<LightShape::kRectangle>(wave);
  }
  if (features.Has(Feature::kSphereLights)) WeighRoundHits<EmittingSphere>(wave);
  if (features.Has(Feature::kDiskLights)) WeighRoundHits<EmittingDisk>(wave);
}

void WeighEscaped(Wave& wave) {
  if (!StartAtSky(wave.chances->emission)) return;
  const PathColumns& p = wave.path;
  ForEachBatch(wave, wave.queue(QueueId::kMiss),
               [&](const StoreSlots& slots, MF) HWY_ATTR {
                 const V3 d = Gather3(p.d_x, p.d_y, p.d_z, slots);
                 const V3 from = Gather3(p.o_x, p.o_y, p.o_z, slots);
                 WeighFound(wave, slots, StepToSky(wave, from, d));
               });
}

Stage WeighConnectionsStage() {
  using namespace fields;
  return {.name = "light_path_weigh",
          .meaning = "weighs light samples against light subpaths, or the reverse",
          .input = QueueId::kShadow,
          .role = StageRole::kRecord,
          .needs = {Feature::kLightPaths, Feature::kLights, Feature::kScatters},
          .reads =
              FirstVertexFields(true, true) | kLightSample | kShadow |
              FieldSet{Field::lp_chain, Field::lp_inverse, Field::lp_in_x, Field::lp_in_y,
                       Field::lp_in_z, Field::lp_vertex, Field::ls_light, Field::output},
          .writes = kShadow,
          .resolve = ByFeature<Feature::kLightSubpath, WeighConnections<true>,
                               WeighConnections<false>>};
}

Stage WeighHitsStage() {
  return {.name = "light_path_hits",
          .meaning = "weighs lights that rays hit against light subpaths",
          .input = QueueId::kHit,
          .role = StageRole::kRecord,
          .needs = {Feature::kLightPaths, Feature::kAreaLights},
          .reads = fields::kRay | fields::kHit |
                   FieldSet{Field::lp_chain, Field::lp_pdf, Field::lp_vertex,
                            Field::bsdf_pdf, Field::passed},
          .writes = {Field::hit_weight},
          .resolve = Always<WeighHits>};
}

Stage WeighEscapedStage() {
  return {.name = "light_path_escaped",
          .meaning = "weighs infinite lights that rays find against light subpaths",
          .input = QueueId::kMiss,
          .role = StageRole::kRecord,
          .needs = {Feature::kLightPaths, Feature::kInfiniteLights},
          .reads = fields::kRay | FieldSet{Field::lp_chain, Field::lp_pdf,
                                           Field::lp_vertex, Field::bsdf_pdf},
          .writes = {Field::hit_weight},
          .resolve = Always<WeighEscaped>};
}

LANELIGHT_END_KERNELS

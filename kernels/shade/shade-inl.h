// The skeleton of every shading stage: light sample, then the next ray. A material policy
// (kernels/bsdf/bsdf-inl.h) fills in the physics.
#ifndef LANELIGHT_SHADE_SHADE_INL_H_
#define LANELIGHT_SHADE_SHADE_INL_H_

#include <limits>

#include "kernels/directions/heuristic-inl.h"
#include "kernels/directions/material-inl.h"
#include "kernels/directions/uniform-inl.h"
#include "kernels/queue/batch-inl.h"
#include "src/scene/compiled/materials.h"

LANELIGHT_BEGIN_KERNELS

/// Returns the shading frame around n with the first axis along the surface tangent; any
/// frame if the tangent is missing or along n.
HWY_INLINE ShadingFrame FrameFromTangent(V3 n, V3 tangent) {
  const ShadingFrame any = FrameFromNormal(n);
  const V3 flat = MulAdd(n, hn::Neg(Dot(n, tangent)), tangent);
  const VF length2 = Dot(flat, flat);
  const MF usable =
      hn::And(hn::Gt(length2, hn::Mul(Splat(1e-10f), Dot(tangent, tangent))),
              hn::Lt(length2, Splat(std::numeric_limits<float>::infinity())));
  const V3 s = IfThenElse(usable, Mul(flat, Rsqrt(length2)), any.s);
  return {s, IfThenElse(usable, Cross(n, s), any.t), n};
}

HWY_INLINE MF IsPositiveFinite(VF v) {
  return hn::And(hn::Gt(v, hn::Zero(DF())),
                 hn::Lt(v, Splat(std::numeric_limits<float>::infinity())));
}
/// Returns whether no component is NaN, infinite or negative and one is positive.
HWY_INLINE MF CarriesLight(V3 c) {
  return hn::And(IsPositiveFinite(hn::Add(c.x, hn::Add(c.y, c.z))),
                 hn::Ge(hn::Min(c.x, hn::Min(c.y, c.z)), hn::Zero(DF())));
}

/// Returns whether the vector has length 1, up to rounding.
HWY_INLINE MF IsUnit(V3 d) {
  return hn::Lt(hn::Abs(hn::Sub(Dot(d, d), Splat(1.0f))), Splat(1e-4f));
}

/// Reads shading frames and material parameters of surfaces.
template <class Bsdf>
struct SurfaceReader {
  Wave& wave;
  HWY_INLINE explicit SurfaceReader(Wave& w) : wave(w) {}

  HWY_INLINE ShadingFrame ReadFrame(V3 ng, const Slots& slots) const {
    const PathColumns& path = wave.path;
    V3 n = ng;
    if (path.ns_x != nullptr) n = Gather3(path.ns_x, path.ns_y, path.ns_z, slots);
    if constexpr (Bsdf::kAnisotropic) {
      if (path.tg_x != nullptr) {
        return FrameFromTangent(n, Gather3(path.tg_x, path.tg_y, path.tg_z, slots));
      }
    }
    return FrameFromNormal(n);
  }

  HWY_INLINE MaterialInputs Inputs(const Slots& slots) const {
    const PathColumns& path = wave.path;
    MaterialInputs in{*wave.materials, path, slots, Gather(path.material, slots), {}};
    if constexpr (Bsdf::kStochastic) {
      in.random = LaneRandom(path, slots, wave.run->seed ^ LaneRandom::kStream);
    }
    return in;
  }
};

/// The point to shade: directions to the previous vertex in the frame of the shading
/// normal, geometric normals, and throughputs.
struct ShadedPoint {
  const ShadingFrame& frame;
  V3 wo, ng, beta;
};

/// Besides the material, a shading stage has a proposal of directions
/// (kernels/directions/). kMis: light samples and scattered rays are weighted against
/// each other, and rays carry their density. Otherwise light samples count in full, and
/// scattered rays find no light that is sampled.
template <class Bsdf, class Proposal, bool kMis>
struct Shader : SurfaceReader<Bsdf> {
  using Material = typename Bsdf::Params;
  using SurfaceReader<Bsdf>::wave;

  HWY_INLINE explicit Shader(Wave& w) : SurfaceReader<Bsdf>(w) {}

  /// Computes what the sampled light adds if nothing is in between.
  HWY_INLINE void SampleLight(const Material& material, const ShadedPoint& at,
                              const StoreSlots& slots, MF valid) {
    const PathColumns& path = wave.path;
    const V3 light = Gather3(path.ls_r, path.ls_g, path.ls_b, slots);
    const V3 wi = at.frame.ToLocal(Gather3(path.ls_x, path.ls_y, path.ls_z, slots));
    const BsdfValue value = Bsdf::Eval(material, at.wo, wi);
    V3 carried = Mul(Mul(at.beta, value.f_cos), light);
    if constexpr (kMis) {
      const VF pdf = Proposal::template Pdf<Bsdf>(at.wo, wi, value.pdf);
      carried =
          Mul(carried, LightSampleWeight(wave.run->mis, Gather(path.ls_pdf, slots), pdf));
    }
    Scatter3(carried, path.sh_r, path.sh_g, path.sh_b, slots);
    Push(wave.queue(QueueId::kShadow), slots, hn::And(valid, CarriesLight(carried)));
  }

  /// Scatters the path: new ray, throughput and density. Returns the paths that continue.
  HWY_INLINE MF Bounce(const Material& material, const ShadedPoint& at,
                       const StoreSlots& slots) {
    const PathColumns& path = wave.path;
    BsdfPoints u = {hn::Zero(DF()), Gather(path.u_bsdf_0, slots),
                    Gather(path.u_bsdf_1, slots)};
    if (path.u_lobe != nullptr) u.lobe = Gather(path.u_lobe, slots);
    const BsdfSample sample = Proposal::template Sample<Bsdf>(material, at.wo, u);
    const V3 d = Renormalize(at.frame.FromLocal(sample.wi));
    const V3 p = Gather3(path.p_x, path.p_y, path.p_z, slots);
    const V3 o = OffsetOrigin(p, at.ng, Gather(path.p_error, slots), d);
    // A tangential wo has no defined side; pbrt absorbs it as well.
    MF alive = hn::And(CarriesLight(sample.weight), hn::Ne(at.wo.z, hn::Zero(DF())));
    if constexpr (kMis) {
      alive =
          hn::And(alive, hn::Lt(sample.pdf, Splat(std::numeric_limits<float>::max())));
    }
    if (kMis || path.bsdf_pdf != nullptr) {  // or another stage reads it
      Scatter(sample.pdf, path.bsdf_pdf, slots);
    }
    if constexpr (kMis && !Bsdf::kSpecular) {
      if (path.start_n_x != nullptr) {  // hits are weighed against what it makes likely
        const V3 facing = Mul(at.frame.n, hn::CopySign(Splat(1.0f), at.wo.z));
        Scatter3(facing, path.start_n_x, path.start_n_y, path.start_n_z, slots);
      }
    }
    LL_DCHECK(AllUnder(alive, IsUnit(d)));
    // Walks through coats weigh by a density of their own, which may be 0 here.
    LL_DCHECK(AllUnder(alive, hn::Ge(sample.pdf, hn::Zero(DF()))));
    const V3 carried = IfThenElseZero(alive, Mul(at.beta, sample.weight));
    Scatter3(o, path.o_x, path.o_y, path.o_z, slots);
    Scatter3(d, path.d_x, path.d_y, path.d_z, slots);
    Scatter3(carried, path.beta_r, path.beta_g, path.beta_b, slots);
    Scatter(Splat(std::numeric_limits<float>::infinity()), path.t, slots);
    if constexpr (Bsdf::kRefracts) {
      Scatter(hn::Mul(Gather(path.eta_scale, slots), sample.eta_scale), path.eta_scale,
              slots);
    }
    const VI depth = Gather(path.depth, slots);
    Scatter(hn::Add(depth, hn::Set(DI(), 1)), path.depth, slots);
    return hn::And(alive, CarriesLight(carried));
  }

  HWY_INLINE void operator()(const StoreSlots& slots, MF valid) {
    const PathColumns& path = wave.path;
    const V3 ng = Gather3(path.ng_x, path.ng_y, path.ng_z, slots);
    const ShadingFrame frame = this->ReadFrame(ng, slots);
    const V3 wo = frame.ToLocal(-Gather3(path.d_x, path.d_y, path.d_z, slots));
    const V3 beta = Gather3(path.beta_r, path.beta_g, path.beta_b, slots);
    const Material material = Bsdf::Load(this->Inputs(slots));
    const ShadedPoint at = {frame, wo, ng, beta};
    if constexpr (!Bsdf::kSpecular) {
      if (path.sh_r != nullptr) SampleLight(material, at, slots, valid);
    }
    const MF alive = Bounce(material, at, slots);
    Push(wave.queue(QueueId::kScattered), slots, hn::And(valid, alive));
    Push(wave.queue(QueueId::kDone), slots, hn::AndNot(alive, valid));
  }
};

template <class Bsdf, ShadeKind kKind, class Proposal, bool kMis>
void ShadeKernel(Wave& wave) {
  Shader<Bsdf, Proposal, kMis> shader(wave);
  const uint32_t shadow_rays = wave.queue(QueueId::kShadow).size;
  ForEachBatch(wave, wave.queue(ShadeQueue(kKind)),
               [&](const StoreSlots& slots, MF valid) HWY_ATTR { shader(slots, valid); });
  wave.rays_shadow += wave.queue(QueueId::kShadow).size - shadow_rays;
}

/// Returns the kernel for the features of a scene. Only combinations that a plan can need
/// are instantiated: with uniform directions, light samples are of lights that no ray can
/// hit, so that there is no weight.
template <class Bsdf, ShadeKind kKind>
StageFn ResolveShade(const FeatureSet& features) {
  static_assert(HasTrait(kKind, kSpecularOnly) == Bsdf::kSpecular);
  static_assert(HasTrait(kKind, kRefracting) == Bsdf::kRefracts);
  static_assert(HasTrait(kKind, kWalks) == Bsdf::kStochastic);
  static_assert(HasTrait(kKind, kEvenSides) == Bsdf::kEvenSides);
  static_assert(HasTrait(kKind, kFibre) == Bsdf::kFibre);
  static_assert(HasTrait(kKind, kInMedium) == Bsdf::kPhase);
  if (features.Has(Feature::kMis)) {
    return ShadeKernel<Bsdf, kKind, MaterialProposal, true>;
  }
  if constexpr (!Bsdf::kSpecular) {
    if (features.Has(Feature::kUniformDirections)) {
      return ShadeKernel<Bsdf, kKind, UniformProposal, false>;
    }
  }
  return ShadeKernel<Bsdf, kKind, MaterialProposal, false>;
}

/// The shading stage of a kind, present if the scene has it.
template <class Bsdf, ShadeKind kKind>
Stage ShadeStage(const char* name, const char* meaning) {
  using namespace fields;
  const FieldSet points = {Field::u_lobe, Field::u_bsdf_0, Field::u_bsdf_1};
  // Random walks inside a coat draw numbers by the identity of the path.
  const FieldSet identity = {Field::pixel, Field::sample, Field::branch, Field::depth,
                             Field::material};
  const FieldSet direction = {Field::d_x, Field::d_y, Field::d_z};
  const FieldSet across = Bsdf::kFibre ? FieldSet{Field::uv_v} : FieldSet{};
  const FieldSet spectra = Bsdf::kByWavelength ? FieldSet{Field::wavelength} : FieldSet{};
  const FieldSet history = {Field::bsdf_pdf, Field::eta_scale, Field::depth, Field::t};
  return {.name = name,
          .meaning = meaning,
          .input = ShadeQueue(kKind),
          .role = StageRole::kShade,
          .needs = {ShadeFeature(kKind), Feature::kScatters},
          .reads = identity | direction | kThroughput | kPoint | kNormal | kTangent |
                   kParameters | points | kLightSample | across | spectra |
                   FieldSet{Field::eta_scale},
          .writes = kRay | kThroughput | kShadow | kStartNormal | history,
          .resolve = ResolveShade<Bsdf, kKind>};
}

LANELIGHT_END_KERNELS

#endif

// A material policy has parameters, Eval and Sample, in the local frame of the shading
// normal (+z). kernels/shade/shade-inl.h turns each policy into a stage.
//
//   struct XBsdf : PlainBsdf {
//     what PlainBsdf below has, where it is otherwise
//     struct Params;
//     static Params Load(const MaterialInputs&);
//     static BsdfValue Eval(const Params&, V3 wo, V3 wi);
//     static BsdfSample Sample(const Params&, V3 wo, const BsdfPoints&);
//     static BsdfValue EvalShared(const Params&, V3 wo, V3 wi);  of the lobes that are
//     wide
//                                 enough to serve others (kernels/reuse/), if not of all
//     static VF FirstLobe(const Params&, V3 wo);  probability of the first of two lobes,
//                                 which BsdfPoints::lobe below it chooses: if control/
//                                 choices.cc has a line for the kind
//   };
// wo and wi are unit and point away from the surface; wo.z is never 0.
#ifndef LANELIGHT_BSDF_BSDF_INL_H_
#define LANELIGHT_BSDF_BSDF_INL_H_

#include "kernels/bsdf/random-inl.h"
#include "kernels/queue/slots-inl.h"
#include "kernels/simd/math-inl.h"
#include "src/scene/compiled/materials.h"

// Eval and Sample are part of three kernels each. Long ones, whose lanes are full of
// work, lose nothing by a call, and the compiler sees them once.
#undef LANELIGHT_LONG_BSDF_CALL
#define LANELIGHT_LONG_BSDF_CALL HWY_NOINLINE

LANELIGHT_BEGIN_KERNELS

/// Uniform in [0,1): the choice of a lobe, and a direction within it.
struct BsdfPoints {
  VF lobe, u0, u1;
};

/// f(wo, wi) * |cos theta_i|, and the density (solid angle) with which Sample would find
/// wi by its non-delta lobes.
struct BsdfValue {
  V3 f_cos;
  VF pdf;
};

/// A direction, f * |cos| / density, and the density with respect to solid angle, 0 for a
/// delta direction. weight 0: absorbed, nothing else counts. eta_scale: square of the
/// relative index entered, 1 without refraction.
struct BsdfSample {
  V3 wi, weight;
  VF pdf, eta_scale;
};

/// The default traits of a material.
struct PlainBsdf {
  static constexpr bool kSpecular = false;     // only delta directions: no Eval, no
                                               // light samples
  static constexpr bool kAnisotropic = false;  // the tangent matters
  static constexpr bool kRefracts = false;     // Sample fills eta_scale
  static constexpr bool kStochastic = false;   // Load receives random numbers
  static constexpr bool kHasDelta = false;     // delta directions besides others: Sample
                                               // then returns density 0
  static constexpr bool kEvenSides = false;  // f for wi is the same for all wo on a side
  static constexpr bool kTransmits = false;  // not all directions are on wo's side
  static constexpr bool kFibre = false;      // MaterialSource has uv_v
  static constexpr bool kByWavelength = false;  // Load looks at the path's wavelengths
};

/// The source of material parameters: the table, or columns filled by the texture stage.
/// It is the same for all paths of a scene, so it is resolved once per stage call.
struct MaterialSource {
  const MaterialTable* table;
  const float *color0_r, *color0_g, *color0_b, *alpha_x, *alpha_y;
  const float *color1_r, *color1_g, *color1_b;
  const float *alpha2_x, *alpha2_y, *coat_thickness;
  const float *coat_albedo_r, *coat_albedo_g, *coat_albedo_b, *coat_g;
  bool color_by_path, alpha_by_path, color1_by_path, coat_by_path, medium_by_path;
  const float* uv_v;        // only for kFibre; null otherwise
  const float* eta;         // of glass, by path; null: of the table
  const float* wavelength;  // of paths that carry wavelengths; else null
};

LANELIGHT_INLINE MaterialSource TableSource(const MaterialTable& t) {
  return {&t,
          t.color0_r.data(),
          t.color0_g.data(),
          t.color0_b.data(),
          t.alpha_x.data(),
          t.alpha_y.data(),
          t.color1_r.data(),
          t.color1_g.data(),
          t.color1_b.data(),
          t.alpha2_x.data(),
          t.alpha2_y.data(),
          t.coat_thickness.data(),
          t.coat_albedo_r.data(),
          t.coat_albedo_g.data(),
          t.coat_albedo_b.data(),
          t.coat_g.data(),
          false,
          false,
          false,
          false,
          false,
          nullptr,
          nullptr,
          nullptr};
}

/// Parameters of one batch of paths.
struct MaterialInputs {
  const MaterialSource& source;
  Slots slot;
  VI material;
  LaneRandom random;  // only filled for kStochastic

  /// Colours are in range, reflectances in [0, 1]: constants since the scene was
  /// compiled, textures since they were looked up.
  LANELIGHT_INLINE V3 Color0() const {
    const MaterialSource& s = source;
    return s.color_by_path
               ? Gather3(s.color0_r, s.color0_g, s.color0_b, slot)
               : LookUp3(s.table->color0_r, s.table->color0_g, s.table->color0_b);
  }
  LANELIGHT_INLINE V3 Color1() const {
    const MaterialSource& s = source;
    return s.color1_by_path
               ? Gather3(s.color1_r, s.color1_g, s.color1_b, slot)
               : LookUp3(s.table->color1_r, s.table->color1_g, s.table->color1_b);
  }
  LANELIGHT_INLINE VF AlphaX() const {
    return Varying(source.alpha_by_path, source.alpha_x, source.table->alpha_x);
  }
  LANELIGHT_INLINE VF AlphaY() const {
    return Varying(source.alpha_by_path, source.alpha_y, source.table->alpha_y);
  }
  /// Returns the roughness of the metal below a coat.
  LANELIGHT_INLINE VF Alpha2X() const {
    return Varying(source.coat_by_path, source.alpha2_x, source.table->alpha2_x);
  }
  LANELIGHT_INLINE VF Alpha2Y() const {
    return Varying(source.coat_by_path, source.alpha2_y, source.table->alpha2_y);
  }
  LANELIGHT_INLINE VF CoatThickness() const {
    return Varying(source.coat_by_path, source.coat_thickness,
                   source.table->coat_thickness);
  }
  /// Returns the albedo of the medium in a coat.
  LANELIGHT_INLINE V3 CoatAlbedo() const {
    const MaterialSource& s = source;
    return s.medium_by_path
               ? Gather3(s.coat_albedo_r, s.coat_albedo_g, s.coat_albedo_b, slot)
               : LookUp3(s.table->coat_albedo_r, s.table->coat_albedo_g,
                         s.table->coat_albedo_b);
  }
  LANELIGHT_INLINE VF CoatG() const {
    return Varying(source.medium_by_path, source.coat_g, source.table->coat_g);
  }
  /// Returns the index of glass without a coat.
  LANELIGHT_INLINE VF Eta() const {
    return Varying(source.eta != nullptr, source.eta, source.table->eta);
  }
  LANELIGHT_INLINE VF Float(const AlignedVector<float>& column) const {
    return Lookup(column, material);
  }
  LANELIGHT_INLINE VI Int(const AlignedVector<std::int32_t>& column) const {
    return Lookup(column, material);
  }
  LANELIGHT_INLINE VI Int(const AlignedVector<std::uint32_t>& column) const {
    return Lookup(column, material);
  }

 private:
  LANELIGHT_INLINE VF Varying(bool varies, const float* by_path,
                              const AlignedVector<float>& column) const {
    return varies ? Gather(by_path, slot) : Lookup(column, material);
  }
  LANELIGHT_INLINE V3 LookUp3(const AlignedVector<float>& x,
                              const AlignedVector<float>& y,
                              const AlignedVector<float>& z) const {
    return {Lookup(x, material), Lookup(y, material), Lookup(z, material)};
  }
};

LANELIGHT_INLINE V3 Grey(VF v) { return {v, v, v}; }
LANELIGHT_INLINE MF SameSide(V3 a, V3 b) {
  return hn::Gt(hn::Mul(a.z, b.z), hn::Zero(DF()));
}
/// v with its height taken to the side of wo, for v on the upper side.
LANELIGHT_INLINE V3 ToSideOf(V3 wo, V3 v) { return {v.x, v.y, hn::CopySign(v.z, wo.z)}; }

LANELIGHT_END_KERNELS

#endif

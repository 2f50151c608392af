// A material policy has parameters, Eval and Sample, in the local frame of the shading
// normal (+z). kernels/shade/shade-inl.h turns each policy into a stage.
//
//   struct XBsdf : PlainBsdf {
//     members of PlainBsdf that differ
//     struct Params;
//     static Params Load(const MaterialInputs&);
//     static BsdfValue Eval(const Params&, V3 wo, V3 wi);
//     static BsdfSample Sample(const Params&, V3 wo, const BsdfPoints&);
//     // Optional: the lobes that other paths can reuse (kernels/reuse/).
//     static BsdfValue EvalShared(const Params&, V3 wo, V3 wi);
//     // For control/regression.cc: the probability of the first of two lobes.
//     static VF FirstLobe(const Params&, V3 wo);
//   };
// wo and wi are unit and point away from the surface; wo.z is never 0.
#ifndef LANELIGHT_BSDF_BSDF_INL_H_
#define LANELIGHT_BSDF_BSDF_INL_H_

#include "kernels/queue/slots-inl.h"
#include "src/vocabulary/path/fields.h"
#include "kernels/simd/math-inl.h"
#include "kernels/simd/rng-inl.h"
#include "src/scene/compiled/materials.h"

// Eval and Sample are part of three kernels each. Long ones are called: the call costs
// little, and they are compiled once.
#undef LANELIGHT_LONG_BSDF_CALL
#define LANELIGHT_LONG_BSDF_CALL HWY_NOINLINE

LANELIGHT_BEGIN_KERNELS

/// Random numbers for materials that are evaluated by a random walk and need more than
/// the three sample points of a bounce. Uniform in [0, 1) with 24 bits, a pure function
/// of the four key words and of how many were drawn before. Each hash (Pcg4d) gives four
/// numbers. The counter advances with every call of Next4, whichever lanes need it, so
/// lanes never influence each other.
struct LaneRandom {
  /// Combined with the seed, keeps these numbers apart from the sample points.
  static constexpr std::uint32_t kStream = 0x7feb352du;

  VU pixel, sample, depth, seed;

  LaneRandom() = default;
  LANELIGHT_INLINE LaneRandom(VU of_pixel, VU of_sample, VU of_depth, VU of_seed)
      : pixel(of_pixel), sample(of_sample), depth(of_depth), seed(of_seed) {}
  /// The stream of each path.
  LANELIGHT_INLINE LaneRandom(const PathColumns& p, const Slots& slots,
                              std::uint32_t stream)
      : pixel(AsUnsigned(Gather(p.pixel, slots))),
        sample(AsUnsigned(Gather(p.sample, slots))),
        depth(AsUnsigned(Gather(p.depth, slots))),
        seed(SplatU(stream)) {
    if (p.branch == nullptr) return;
    seed = hn::Xor(seed, hn::ShiftLeft<24>(AsUnsigned(Gather(p.branch, slots))));
  }

  HWY_NOINLINE void Next4(VF out[4]) {
    const U4 bits = Pcg4d({pixel, sample, depth, seed});
    out[0] = ToUnit(bits.x);
    out[1] = ToUnit(bits.y);
    out[2] = ToUnit(bits.z);
    out[3] = ToUnit(bits.w);
    // The bounce number uses the low bits of `depth`; draws count above them.
    depth = hn::Add(depth, SplatU(1u << 20));
  }
};

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
/// delta direction. A weight of 0 means absorption. eta_scale: square of the relative
/// index entered, 1 without refraction.
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
  static constexpr bool kFibre = false;      // Load reads the column uv_v
  static constexpr bool kPhase = false;      // of points in a medium
  static constexpr bool kByWavelength = false;  // Load looks at the path's wavelengths
};

/// Parameters of one batch of paths: from columns that the texture stages fill, if the
/// scene has them, else from the table. Colours are in range, reflectances in [0, 1].
struct MaterialInputs {
  const MaterialTable& table;
  const PathColumns& path;
  Slots slot;
  VI material;
  LaneRandom random;  // only filled for kStochastic

  LANELIGHT_INLINE bool CoatVaries() const { return path.coat_thickness != nullptr; }

  LANELIGHT_INLINE V3 Color0() const {
    return path.color0_r != nullptr
               ? Gather3(path.color0_r, path.color0_g, path.color0_b, slot)
               : LookUp3(table.color0_r, table.color0_g, table.color0_b);
  }
  LANELIGHT_INLINE V3 Color1() const {
    return path.color1_r != nullptr
               ? Gather3(path.color1_r, path.color1_g, path.color1_b, slot)
               : LookUp3(table.color1_r, table.color1_g, table.color1_b);
  }
  LANELIGHT_INLINE VF AlphaX() const {
    return Varying(path.alpha_x != nullptr, path.alpha_x, table.alpha_x);
  }
  LANELIGHT_INLINE VF AlphaY() const {
    return Varying(path.alpha_x != nullptr, path.alpha_y, table.alpha_y);
  }
  /// Returns the roughness of the metal below a coat.
  LANELIGHT_INLINE VF Alpha2X() const {
    return Varying(CoatVaries(), path.alpha2_0, table.alpha2_x);
  }
  LANELIGHT_INLINE VF Alpha2Y() const {
    return Varying(CoatVaries(), path.alpha2_1, table.alpha2_y);
  }
  LANELIGHT_INLINE VF CoatThickness() const {
    return Varying(CoatVaries(), path.coat_thickness, table.coat_thickness);
  }
  /// Returns the albedo of the medium in a coat.
  LANELIGHT_INLINE V3 CoatAlbedo() const {
    return path.coat_g != nullptr
               ? Gather3(path.coat_albedo_r, path.coat_albedo_g, path.coat_albedo_b, slot)
               : LookUp3(table.coat_albedo_r, table.coat_albedo_g, table.coat_albedo_b);
  }
  LANELIGHT_INLINE VF CoatG() const {
    return Varying(path.coat_g != nullptr, path.coat_g, table.coat_g);
  }
  /// Returns the index of glass without a coat.
  LANELIGHT_INLINE VF Eta() const {
    return Varying(path.eta != nullptr, path.eta, table.eta);
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
/// Moves v from the upper side to the side of wo.
LANELIGHT_INLINE V3 ToSideOf(V3 wo, V3 v) { return {v.x, v.y, hn::CopySign(v.z, wo.z)}; }

LANELIGHT_END_KERNELS

#endif

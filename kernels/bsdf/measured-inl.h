// Measured reflectance (Dupuy and Jakob 2018, "An Adaptive Parameterization for Efficient
// Material Acquisition and Rendering"); src/base/image/measured_reflectance.h says what f
// is. Both sides of the surface reflect.
//   sampling   a point s of the square by the luminance, taken by visible normals to a
//              microfacet normal m, which reflects
//   density    luminance(s) vndf(m) / (2 pi^2 sqrt(2 theta_m / pi) sin theta_m), of
//              normals per solid angle, over 4 wo.m, of directions
#ifndef LANELIGHT_BSDF_MEASURED_INL_H_
#define LANELIGHT_BSDF_MEASURED_INL_H_

#include "kernels/bsdf/bsdf-inl.h"
#include "kernels/bsdf/measured_tables-inl.h"
#include "kernels/texture/wavelengths-inl.h"

LANELIGHT_BEGIN_KERNELS

struct MeasuredBsdf : PlainBsdf {
  static constexpr bool kAnisotropic = true;
  static constexpr bool kByWavelength = true;
  struct Params {
    const MeasuredTable* table;
    VI record;
    bool spectral;  // paths carry wavelengths
    VI triple;      // the paths' wavelengths
  };
  LANELIGHT_INLINE static Params Load(const MaterialInputs& in) {
    const MeasuredTable& table = in.table.measured;
    const VI record = hn::Max(in.Int(table.of_material), hn::Zero(DI()));
    const float* number = in.path.wavelength;
    if (number == nullptr) return {&table, record, false, hn::Zero(DI())};
    return {&table, record, true, Wavelengths(Gather(number, in.slot)).triple};
  }

  LANELIGHT_LONG_BSDF_CALL static BsdfValue Eval(const Params& m, V3 wo, V3 wi) {
    const Known known(m, wo);
    const V3 in = known.Fold(wi);
    const V3 h = Normalize(known.wo + in);
    const Normal normal = known.Describe(h);
    const MeasuredMap::Point s = known.vndf.Invert(normal.x, normal.y);
    const VF picked = known.luminance.Invert(s.x, s.y).pdf;
    const VF jacobian = Jacobian(normal, Dot(known.wo, h));
    const VF pdf = hn::Div(hn::Mul(s.pdf, picked), jacobian);
    const MF reflects = SameSide(wo, wi);
    const V3 f = known.Value(normal, s.x, s.y);
    return {IfThenElseZero(reflects, f), hn::IfThenElseZero(reflects, pdf)};
  }

  LANELIGHT_LONG_BSDF_CALL static BsdfSample Sample(const Params& m, V3 wo,
                                                    const BsdfPoints& u) {
    const Known known(m, wo);
    const MeasuredMap::Point s = known.luminance.Sample(u.u0, u.u1);
    const MeasuredMap::Point at = known.vndf.Sample(s.x, s.y);
    const SinCosPair theta = SinCos2Pi(hn::Mul(Splat(0.25f), Sqr(at.x)));
    const SinCosPair phi = SinCos2Pi(hn::Sub(at.y, Splat(0.5f)));
    const V3 turned = known.FromOwnAzimuth({phi.cos, phi.sin, theta.cos});
    const V3 h = {hn::Mul(turned.x, theta.sin), hn::Mul(turned.y, theta.sin), turned.z};
    const VF cosine = Dot(known.wo, h);
    const V3 in = MulAdd(h, hn::Add(cosine, cosine), -known.wo);
    const Normal normal = {at.x, at.y, theta.sin};
    const VF pdf = hn::Div(hn::Mul(at.pdf, s.pdf), Jacobian(normal, cosine));
    const VF weight = hn::Div(Splat(1.0f), pdf);
    const MF reflects =
        hn::And(hn::Gt(in.z, hn::Zero(DF())),
                hn::And(hn::Gt(cosine, hn::Zero(DF())), hn::Gt(pdf, hn::Zero(DF()))));
    const V3 f = Mul(known.Value(normal, s.x, s.y), weight);
    return {known.Fold(in), IfThenElseZero(reflects, f),
            hn::IfThenElseZero(reflects, pdf), Splat(1.0f)};
  }

 private:
  /// A microfacet normal: as a point of the square, and the sine to the surface normal.
  struct Normal {
    VF x, y, sine;
  };

  /// Values shared by all directions that are paired with a known one.
  struct Known {
    const MeasuredTable& table;
    RecordWords<MeasuredRecord> record;
    bool spectral;
    VI triple;
    VF flip_x, flip_y, flip_z;  // signs that move wo to the measured part
    V3 wo;
    VF theta, phi;
    MF is_anisotropic;
    MeasuredSlices slices;
    MeasuredMap vndf, luminance;

    LANELIGHT_INLINE Known(const Params& m, V3 direction)
        : table(*m.table),
          record(table.records.data(), m.record),
          spectral(m.spectral),
          triple(m.triple),
          vndf(table, record, slices, offsetof(MeasuredRecord, vndf)),
          luminance(table, record, slices, offsetof(MeasuredRecord, luminance)) {
      SetWo(direction);
    }
    Known(const Known&) = delete;  // the maps refer to its slices

    LANELIGHT_INLINE void SetWo(V3 direction) {
      const VF one = Splat(1.0f);
      flip_x = flip_y = flip_z = hn::CopySign(one, direction.z);
      wo = Fold(direction);
      const VI parts = record.I(offsetof(MeasuredRecord, parts));
      const MF half = hn::RebindMask(DF(), hn::Gt(parts, hn::Set(DI(), 1)));
      const MF quarter = hn::RebindMask(DF(), hn::Gt(parts, hn::Set(DI(), 2)));
      const VF to_y = hn::CopySign(one, hn::Neg(wo.y));
      const VF to_x = hn::IfThenElse(quarter, hn::CopySign(one, hn::Neg(wo.x)), to_y);
      flip_x = hn::Mul(flip_x, hn::IfThenElse(half, to_x, one));
      flip_y = hn::Mul(flip_y, hn::IfThenElse(half, to_y, one));
      wo = Fold(direction);
      is_anisotropic = record.IsSet(offsetof(MeasuredRecord, is_anisotropic));
      theta = Atan2(hn::Sqrt(hn::MulAdd(wo.x, wo.x, hn::Mul(wo.y, wo.y))), wo.z);
      phi = Atan2(wo.y, wo.x);
      SetSlices();
    }

    /// Applies the signs; it is its own inverse.
    LANELIGHT_INLINE V3 Fold(V3 w) const {
      return {hn::Mul(w.x, flip_x), hn::Mul(w.y, flip_y), hn::Mul(w.z, flip_z)};
    }

    LANELIGHT_INLINE void SetSlices() {
      const float* nodes = table.values.data();
      const auto word = [&](std::size_t offset) HWY_ATTR { return record.I(offset); };
      const VI count = word(offsetof(MeasuredRecord, thetas));
      const MeasuredNodes t(nodes, word(offsetof(MeasuredRecord, theta_at)), count,
                            theta);
      slices.count = 2;
      slices.at[0] = t.first, slices.at[1] = t.next;
      slices.fraction[1] = t.fraction,
      slices.fraction[0] = hn::Sub(Splat(1.0f), t.fraction);
      if (!table.any_anisotropic) return;
      const MeasuredNodes p(nodes, word(offsetof(MeasuredRecord, phi_at)),
                            word(offsetof(MeasuredRecord, phis)), phi);
      slices.count = 4;
      const VF rest = hn::Sub(Splat(1.0f), p.fraction);
      for (int i = 0; i < 2; ++i) {
        const VI at = slices.at[i];
        slices.at[i] = hn::Add(hn::Mul(p.first, count), at);
        slices.at[i + 2] = hn::Add(hn::Mul(p.next, count), at);
        slices.fraction[i + 2] = hn::Mul(slices.fraction[i], p.fraction);
        slices.fraction[i] = hn::Mul(slices.fraction[i], rest);
      }
    }

    LANELIGHT_INLINE Normal Describe(V3 h) const {
      const VF sine = hn::Sqrt(hn::MulAdd(h.x, h.x, hn::Mul(h.y, h.y)));
      const VF own = hn::IfThenElseZero(hn::Not(is_anisotropic), phi);
      const VF azimuth = hn::Sub(Atan2(h.y, h.x), own);
      const VF y = hn::MulAdd(azimuth, Splat(0.5f * kInvPi), Splat(0.5f));
      return {OfTheta(Atan2(sine, h.z)), hn::Sub(y, hn::Floor(y)), sine};
    }

    /// Converts a direction from the azimuths of the measurement.
    LANELIGHT_INLINE V3 FromOwnAzimuth(V3 w) const {
      const VF flat = hn::Sqrt(hn::MulAdd(wo.x, wo.x, hn::Mul(wo.y, wo.y)));
      const MF plain = hn::Or(is_anisotropic, hn::Eq(flat, hn::Zero(DF())));
      const VF c = hn::IfThenElse(plain, Splat(1.0f), hn::Div(wo.x, flat));
      const VF s = hn::IfThenElseZero(hn::Not(plain), hn::Div(wo.y, flat));
      return {hn::NegMulAdd(s, w.y, hn::Mul(c, w.x)), hn::MulAdd(s, w.x, hn::Mul(c, w.y)),
              w.z};
    }

    LANELIGHT_INLINE V3 Value(const Normal& normal, VF x, VF y) const {
      const auto of = [&](std::size_t offset) HWY_ATTR {
        return MeasuredFunction(table, record, slices, offset);
      };
      const VF azimuth = hn::MulAdd(phi, Splat(0.5f * kInvPi), Splat(0.5f));
      const VF sigma =
          of(offsetof(MeasuredRecord, sigma)).Single(OfTheta(theta), azimuth);
      const VF ndf = of(offsetof(MeasuredRecord, ndf)).Single(normal.x, normal.y);
      const VF scale = hn::Div(hn::Mul(Splat(0.25f), ndf), sigma);
      const MF seen = hn::Gt(sigma, hn::Zero(DF()));
      const MeasuredFunction reflectance = of(offsetof(MeasuredRecord, reflectance));
      const V3 color = spectral ? Spectrum(reflectance, x, y) : reflectance.Color(x, y);
      return Mul(color, hn::IfThenElseZero(seen, scale));
    }

    /// Interpolates linearly at the wavelengths of paths.
    LANELIGHT_INLINE V3 Spectrum(const MeasuredFunction& f, VF x, VF y) const {
      const VI bins = record.I(offsetof(MeasuredRecord, bins));
      const VI count = record.I(offsetof(MeasuredRecord, wavelengths));
      const V3 at = ByBin(table.values.data(), bins, triple);
      return f.Between(x, y, count, at);
    }

    LANELIGHT_INLINE static VF OfTheta(VF angle) {
      return hn::Min(hn::Sqrt(hn::Mul(angle, Splat(2 * kInvPi))), Splat(1.0f));
    }
  };

  /// Solid angle of directions per area of the square, of a normal; not 0 (as pbrt-v4).
  LANELIGHT_INLINE static VF Jacobian(const Normal& normal, VF cosine) {
    const VF normals = hn::Mul(Splat(2 * kPi * kPi), hn::Mul(normal.x, normal.sine));
    return hn::Mul(hn::Max(normals, Splat(1e-6f)), hn::Mul(Splat(4.0f), cosine));
  }
};

LANELIGHT_END_KERNELS

#endif

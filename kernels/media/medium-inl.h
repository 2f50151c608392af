// Shared by the kernels of participating media: coefficients, media on both sides of
// surfaces, transmittance.
//
// Coefficients are rgb, and a distance is sampled for one channel. Each distance is
// sampled for a channel that is drawn in proportion to its density of the path so far,
// its `odds` p_c / p with p = (p_r + p_g + p_b) / 3. So the throughput f / p is at most
// three times that of the best channel, however many events a path has (the balance
// heuristic over whole paths: Wilkie et al. 2014, "Hero Wavelength Spectral Sampling";
// Miller, Georgiev and Jarosz 2019).
#ifndef LANELIGHT_MEDIA_MEDIUM_INL_H_
#define LANELIGHT_MEDIA_MEDIUM_INL_H_

#include <cstddef>

#include "hwy/contrib/math/math-inl.h"
#include "kernels/queue/batch-inl.h"
#include "kernels/simd/records-inl.h"
#include "kernels/simd/rng-inl.h"
#include "kernels/texture/wavelengths-inl.h"
#include "src/scene/compiled/media.h"

LANELIGHT_BEGIN_KERNELS

/// The media of a vector of lanes; lanes in vacuum read any record.
struct Media : RecordWords<MediumRecord> {
  LANELIGHT_INLINE Media(const MediumTable& table, VI medium)
      : RecordWords(table.media.data(), hn::Max(medium, hn::Zero(DI()))) {}
  // Coefficients as paths carry them: colours, or values at three wavelengths.
  LANELIGHT_INLINE V3 SigmaT(const Wave& wave, const Slots& slots) const {
    return Carried(wave, slots, offsetof(MediumRecord, sigma_t), MediumRow::kSigmaT);
  }
  LANELIGHT_INLINE V3 SigmaS(const Wave& wave, const Slots& slots) const {
    return Carried(wave, slots, offsetof(MediumRecord, sigma_s), MediumRow::kSigmaS);
  }
  LANELIGHT_INLINE V3 Emission(const Wave& wave, const Slots& slots) const {
    return Carried(wave, slots, offsetof(MediumRecord, emission), MediumRow::kEmission);
  }
  /// Requires paths that carry wavelengths and media that have this row.
  LANELIGHT_INLINE V3 Planck(const Wave& wave, const Slots& slots) const {
    return AtRow(wave, slots, MediumRow::kPlanck);
  }
  /// Returns whether the medium has a grid.
  LANELIGHT_INLINE MF Varies() const {
    return hn::RebindMask(DF(),
                          hn::Gt(I(offsetof(MediumRecord, grid)), hn::Set(DI(), -1)));
  }
  /// Returns whether the path carries the albedo.
  LANELIGHT_INLINE MF IsTextured() const {
    return hn::RebindMask(DF(),
                          hn::Gt(I(offsetof(MediumRecord, albedos)), hn::Set(DI(), -1)));
  }
  LANELIGHT_INLINE MF Scatters() const { return IsSet(offsetof(MediumRecord, scatters)); }

 private:
  LANELIGHT_INLINE V3 Carried(const Wave& wave, const Slots& slots, std::size_t color,
                              MediumRow row) const {
    if (HWY_LIKELY(wave.path.wavelength == nullptr)) return F3(color);
    return AtRow(wave, slots, row);
  }
  LANELIGHT_INLINE V3 AtRow(const Wave& wave, const Slots& slots, MediumRow row) const {
    const VI first = I(offsetof(MediumRecord, spectra));
    return AtRows(*wave.spectra, hn::Add(first, hn::Set(DI(), static_cast<int32_t>(row))),
                  Wavelengths(wave.path, slots));
  }
};

LANELIGHT_INLINE MF IsInMedium(VI medium) {
  return hn::RebindMask(DF(), hn::Gt(medium, hn::Set(DI(), kVacuum)));
}

/// The media beside the primitive of each lane.
struct Sides {
  const MediumTable& table;
  VI index;  // of its sides; -1: none

  /// `prim` may be kNoPrimitive.
  LANELIGHT_INLINE Sides(const MediumTable& t, VI prim) : table(t) {
    const VI none = hn::Set(DI(), -1), zero = hn::Zero(DI());
    const VI found = Gather(t.primitives.data(), hn::Max(prim, zero));
    index = hn::IfThenElse(hn::Gt(prim, none), found, none);
  }
  LANELIGHT_INLINE MF Known() const { return IsInMedium(index); }
  LANELIGHT_INLINE MF Passes() const {
    const VI passes = Word(offsetof(MediumSides, passes));
    return hn::And(Known(), hn::RebindMask(DF(), hn::Ne(passes, hn::Zero(DI()))));
  }
  /// Returns the medium in direction d; `here` if the primitive has none beside it.
  LANELIGHT_INLINE VI Toward(V3 d, V3 normal, VI here) const {
    const auto out = hn::RebindMask(DI(), hn::Gt(Dot(d, normal), hn::Zero(DF())));
    const VI beyond = hn::IfThenElse(out, Word(offsetof(MediumSides, outside)),
                                     Word(offsetof(MediumSides, inside)));
    return hn::IfThenElse(hn::RebindMask(DI(), Known()), beyond, here);
  }

 private:
  LANELIGHT_INLINE VI Word(std::size_t byte_offset) const {
    return RecordWords(table.sides.data(), hn::Max(index, hn::Zero(DI()))).I(byte_offset);
  }
};
static_assert(sizeof(MediumSides) == 16);

/// The maximum number of interfaces that a path or a shadow ray passes. A ray can meet a
/// shape that is finer than the rounding of points again and again.
inline constexpr uint32_t kMaxInterfaceCrossings = 1u << 16;

/// Returns exp(-sigma d); 1 if sigma is 0 and d infinite.
LANELIGHT_INLINE VF Transmittance(VF sigma, VF d) {
  const VF depth = hn::Mul(sigma, d);
  return hn::IfThenElse(hn::Gt(sigma, hn::Zero(DF())), Exp(hn::Neg(depth)), Splat(1.0f));
}
LANELIGHT_INLINE V3 Transmittance(V3 sigma, VF d) {
  return {Transmittance(sigma.x, d), Transmittance(sigma.y, d),
          Transmittance(sigma.z, d)};
}

/// Returns 1 - exp(-sigma d) without cancellation.
LANELIGHT_INLINE VF Interacted(VF sigma, VF d) {
  const VF depth = hn::Mul(sigma, d);
  const VF series =
      hn::MulAdd(depth, hn::MulAdd(depth, Splat(1.0f / 6), Splat(-0.5f)), Splat(1.0f));
  const VF thick = hn::Sub(Splat(1.0f), Transmittance(sigma, d));
  return hn::IfThenElse(hn::Lt(depth, Splat(0.01f)), hn::Mul(depth, series), thick);
}
LANELIGHT_INLINE V3 Interacted(V3 sigma, VF d) {
  return {Interacted(sigma.x, d), Interacted(sigma.y, d), Interacted(sigma.z, d)};
}

LANELIGHT_INLINE VF MeanChannel(V3 v) {
  return hn::Mul(hn::Add(v.x, hn::Add(v.y, v.z)), Splat(1.0f / 3));
}

/// A channel drawn with the probabilities odds / 3 by u in [0, 1).
struct Channel {
  MF first, second;  // neither: the third

  LANELIGHT_INLINE Channel(V3 odds, VF u)
      : first(hn::Lt(Thrice(u), odds.x)),
        second(hn::AndNot(first, hn::Lt(Thrice(u), hn::Add(odds.x, odds.y)))) {}
  LANELIGHT_INLINE VF Of(V3 v) const {
    return hn::IfThenElse(first, v.x, hn::IfThenElse(second, v.y, v.z));
  }
  /// Returns a uniform number that draws the same channel by the odds after the event.
  LANELIGHT_INLINE VF Redrawn(V3 before, V3 after, VF u) const {
    const VF fraction = hn::Div(hn::Sub(Thrice(u), Below(before)), Of(before));
    const VF moved = hn::MulAdd(fraction, Of(after), Below(after));
    return hn::Clamp(hn::Mul(moved, Splat(1.0f / 3)), Splat(0), Splat(1 - 0x1p-24f));
  }

 private:
  LANELIGHT_INLINE static VF Thrice(VF u) { return hn::Mul(u, Splat(3.0f)); }
  LANELIGHT_INLINE VF Below(V3 odds) const {
    const VF two = hn::Add(odds.x, odds.y);
    return hn::IfThenElse(first, Splat(0), hn::IfThenElse(second, odds.x, two));
  }
};

/// Maps u in [0, 1) to an exponential distribution with mean 1.
LANELIGHT_INLINE VF ExponentialOf(VF u) {
  return hn::Neg(hn::Log(DF(), hn::Sub(Splat(1.0f), u)));
}

/// Uniform numbers for walks of any length: hashes of the path's identity and depth, and
/// of how many were drawn before.
struct WalkRandom {
  VU pixel, sample, key, seed;

  LANELIGHT_INLINE WalkRandom(const Wave& wave, const Slots& slots, uint32_t purpose) {
    const PathColumns& p = wave.path;
    pixel = AsUnsigned(Gather(p.pixel, slots));
    sample = AsUnsigned(Gather(p.sample, slots));
    key = AsUnsigned(Gather(p.depth, slots));
    seed = SplatU(wave.run->seed ^ purpose);
    if (p.branch != nullptr) {
      const VU branch = AsUnsigned(Gather(p.branch, slots));
      key = hn::Or(key, hn::ShiftLeft<24>(branch));
    }
    if (p.crossings != nullptr) {
      const VU crossings = AsUnsigned(Gather(p.crossings, slots));
      seed = hn::Add(seed, hn::Mul(crossings, SplatU(0x632be5abu)));
    }
  }
  /// Draws two independent numbers in [0, 1).
  LANELIGHT_INLINE void Next(VF* u0, VF* u1) {
    const U4 bits = Pcg4d({pixel, sample, key, seed});
    *u0 = ToUnit(bits.x), *u1 = ToUnit(bits.y);
    seed = hn::Add(seed, SplatU(0x9e3779b9u));
  }
  /// Draws for the lanes of `mask` only: a lane's numbers do not depend on its
  /// neighbours.
  LANELIGHT_INLINE void NextWhere(MF mask, VF* u0, VF* u1) {
    const VU before = seed;
    Next(u0, u1);
    seed = hn::IfThenElse(hn::RebindMask(DU(), mask), seed, before);
  }
};

LANELIGHT_END_KERNELS

#endif

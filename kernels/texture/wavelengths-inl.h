// Colours at the three wavelengths of a path, and back (src/scene/compiled/spectra.h).
#ifndef LANELIGHT_TEXTURE_WAVELENGTHS_INL_H_
#define LANELIGHT_TEXTURE_WAVELENGTHS_INL_H_

#include "kernels/queue/slots-inl.h"
#include "kernels/simd/math-inl.h"
#include "kernels/texture/cube-inl.h"
#include "src/base/core/spectral_constants.h"
#include "src/scene/compiled/spectra.h"
#include "src/vocabulary/path/fields.h"

LANELIGHT_BEGIN_KERNELS

/// The choice of a path's number u in [0, 1): 3 u is one of its three wavelengths, 0
/// being the short one, and a place in the triples.
struct Wavelengths {
  VF place;   // [0, kTriples): bin and place within it
  VI triple;  // = the bin of the short wavelength
  VI hero;    // 0, 1, 2: the wavelength that remains after dispersion
  MF alone;   // the path has been dispersed

  LANELIGHT_INLINE Wavelengths(const PathColumns& p, const Slots& slots)
      : Wavelengths(Gather(p.wavelength, slots)) {}
  LANELIGHT_INLINE explicit Wavelengths(VF number) {
    const DI di;
    alone =
        hn::MaskFromVec(hn::BitCast(DF(), hn::BroadcastSignBit(hn::BitCast(di, number))));
    const VF thirds = hn::Mul(hn::Abs(number), Splat(3.0f));
    hero = hn::Min(hn::ConvertTo(di, thirds), hn::Set(di, 2));
    const VF part = hn::Sub(thirds, hn::ConvertTo(DF(), hero));
    place = hn::Mul(part, Splat(float{kTriples}));
    triple = hn::Min(hn::ConvertTo(di, place), hn::Set(di, kTriples - 1));
  }
};

/// True if eight vectors hold an entry for each triple: permutations then take a quarter
/// of the time of a gather.
inline constexpr bool kTriplesInVectors =
    !HWY_HAVE_SCALABLE && hn::MaxLanes(DF()) * 8 == kTriples;

/// Entry `triple` of an array of kTriples.
LANELIGHT_INLINE VF OfTriple(const float* array, VI triple) {
  if constexpr (!kTriplesInVectors) {
    return Gather(array, triple);
  } else {
    const DF df;
    const auto lane = hn::IndicesFromVec(df, hn::And(triple, hn::Set(DI(), 15)));
    const auto has = [&](int bit)
                         HWY_ATTR { return hn::TestBit(triple, hn::Set(DI(), bit)); };
    const MF odd = hn::RebindMask(df, has(16)), second = hn::RebindMask(df, has(32)),
             last = hn::RebindMask(df, has(64));
    const auto of = [&](int begin) HWY_ATTR {
      return hn::TableLookupLanes(hn::LoadU(df, array + begin), lane);
    };
    const auto of_pair = [&](int begin) HWY_ATTR {
      return hn::IfThenElse(odd, of(begin + 16), of(begin));
    };
    const auto of_half = [&](int begin) HWY_ATTR {
      return hn::IfThenElse(second, of_pair(begin + 32), of_pair(begin));
    };
    return hn::IfThenElse(last, of_half(64), of_half(0));
  }
}

/// Entries of an array by bin, of the long, the middle and the short wavelength.
LANELIGHT_INLINE V3 ByBin(const float* array, VI triple) {
  return {OfTriple(array + 2 * kTriples, triple), OfTriple(array + kTriples, triple),
          OfTriple(array, triple)};
}
/// Does the same for arrays that begin at `begin`, often all in one place.
LANELIGHT_INLINE V3 ByBin(const float* arrays, VI begin, VI triple) {
  if constexpr (kTriplesInVectors) {
    const int32_t first = hn::GetLane(begin);
    if (hn::AllTrue(DI(), hn::Eq(begin, hn::Set(DI(), first)))) {
      return ByBin(arrays + first, triple);
    }
  }
  const VI at = hn::Add(begin, triple);
  return {Gather(arrays + 2 * kTriples, at), Gather(arrays + kTriples, at),
          Gather(arrays, at)};
}

/// Returns the values of spectra that are rows of the table.
LANELIGHT_INLINE V3 AtRows(const SpectrumTable& table, VI row, const Wavelengths& w) {
  const VI begin = hn::Mul(row, hn::Set(DI(), kWavelengthBins));
  return ByBin(table.rows.data(), begin, w.triple);
}

/// Index of refraction at the hero's wavelength.
LANELIGHT_INLINE VF IndexAt(const SpectrumTable& table, VI row, const Wavelengths& w) {
  const VI begin = hn::Mul(row, hn::Set(DI(), kWavelengthEdges));
  const VI bin = hn::Add(w.triple, hn::Mul(w.hero, hn::Set(DI(), kTriples)));
  const VI at = hn::Add(begin, bin);
  const VF low = Gather(table.indices.data(), at);
  const VF high = Gather(table.indices.data() + 1, at);
  const VF part = hn::Sub(w.place, hn::ConvertTo(DF(), w.triple));
  return hn::MulAdd(part, hn::Sub(high, low), low);
}

/// Converts values at the three wavelengths to linear sRGB. Three ones add 1 to each
/// channel, so only the differences of two values from the third are looked up.
LANELIGHT_INLINE V3 FilmColor(const SpectrumTable& table, V3 value,
                              const Wavelengths& w) {
  const VF longer = hn::Sub(value.x, value.z), middle = hn::Sub(value.y, value.z);
  const auto channel = [&](const float* film) HWY_ATTR {
    const VF of_longer = OfTriple(film + 2 * kTriples, w.triple);
    const VF of_middle = OfTriple(film + kTriples, w.triple);
    return hn::MulAdd(longer, of_longer, hn::MulAdd(middle, of_middle, value.z));
  };
  return {channel(table.film[0].data()), channel(table.film[1].data()),
          channel(table.film[2].data())};
}

/// Reflectances, their channels in [0, 1], by UpsamplingTable().
inline HWY_NOINLINE V3 UpsampledReflectances(const SpectrumTable& table, V3 rgb,
                                             const Wavelengths& w) {
  const VF one = Splat(1.0f), half = Splat(0.5f), two = Splat(2.0f);
  const VF minimum = Splat(float{kMinUpsampled}), maximum = hn::Sub(one, minimum);
  const VF middle = Splat(0.5f * (kUpsamplingNodes - 1));
  const VF scale = hn::Mul(middle, Splat(table.per_half_tangent));
  const auto coordinate = [&](VF v) HWY_ATTR {
    const VF c = hn::Clamp(v, minimum, maximum);
    const VF root = hn::Sqrt(hn::Mul(c, hn::Sub(one, c)));
    const VF h = hn::Div(hn::MulSub(two, c, one), hn::MulAdd(two, root, one));
    return hn::Clamp(hn::MulAdd(h, scale, middle), Splat(0), hn::Mul(two, middle));
  };
  const V3 at = {coordinate(rgb.x), coordinate(rgb.y), coordinate(rgb.z)};
  const V3 h = AddOfCube<kUpsamplingNodes>(table.sigmoids.data(), at, Splat3(0, 0, 0));
  const auto tangent = [&](VF t) HWY_ATTR {
    return hn::Div(hn::Mul(two, t), hn::NegMulAdd(t, t, one));
  };
  const V3 p = {tangent(h.x), tangent(h.y), tangent(h.z)};
  const auto row = [&](int i) HWY_ATTR {
    const float* r = table.polynomial.data() + 3 * i;
    return Dot(p, Splat3(r[0], r[1], r[2]));
  };
  const VF c0 = row(0), c1 = row(1), c2 = row(2);
  const auto sigmoid = [&](VF t) HWY_ATTR {
    const VF v = hn::MulAdd(hn::MulAdd(c0, t, c1), t, c2);
    return hn::MulAdd(half, hn::Mul(v, Rsqrt(hn::MulAdd(v, v, one))), half);
  };
  const V3 t = ByBin(table.place.data(), w.triple);
  return {sigmoid(t.x), sigmoid(t.y), sigmoid(t.z)};
}

/// Colours without bound, no channel below 0: as UpsampledColor().
LANELIGHT_INLINE V3 UpsampledColors(const SpectrumTable& table, V3 rgb,
                                    const Wavelengths& w) {
  const VF largest = hn::Max(rgb.x, hn::Max(rgb.y, rgb.z));
  const VF scale = hn::Add(largest, largest);
  const VF safe = hn::Max(scale, Splat(1e-30f));
  const V3 shape = Mul(rgb, hn::Div(Splat(1.0f), safe));
  return Mul(UpsampledReflectances(table, shape, w), scale);
}

LANELIGHT_END_KERNELS

#endif

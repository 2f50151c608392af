// Wavelengths that are even over the samples of a pixel, or of a tile.
//
// The triples of wavelengths (src/base/image/wavelengths.h) make a circle: half of it
// goes up through them, half down again, so that what is smooth along them has no step
// where the circle closes (the baker's transformation: Hickernell 2002). 2^k samples of a
// replicate are 2^k even steps around it, in an order and from a start that are chosen at
// random. Of the light of a lamp 8 samples then have a tenth of the variance that strata
// leave.
//
// Paths that serve each other (reuse=block) must carry the same wavelengths, and any two
// of a tile may. What triples lack of a colour is then an error that all pixels of the
// tile have in common, which no filter takes away: it is worth more than to know it well.
// So replicates are not independent there, but begin a fifth of the circle after one
// another: together they are four of five even steps between (2^k / 5 has the remainders
// 1, 2, 3 and 4 fifths), which leaves a quarter of the variance. And wavelengths of tiles
// are even with points=independent too. Stated errors then count more of it than there
// is.
#ifndef LANELIGHT_SAMPLERS_WAVELENGTH_INL_H_
#define LANELIGHT_SAMPLERS_WAVELENGTH_INL_H_

#include "kernels/samplers/sobol-inl.h"
#include "kernels/simd/math-inl.h"
#include "src/vocabulary/strategy/strategy.h"

LANELIGHT_BEGIN_KERNELS

/// A walk around the circle, and its offset from the start.
struct CircleWalk {
  VU pixel_or_tile, group, index, offset;
};

/// Fills the column `wavelength` from the first third of its numbers, since dispersion
/// does not ask here which wavelength stays.
LANELIGHT_INLINE VF WavelengthOn(const CircleWalk& walk, uint32_t seed) {
  const VU key = SplatU(static_cast<uint32_t>(Dimension::kWavelength));
  const U4 h = Pcg4d({walk.pixel_or_tile, walk.group, key, SplatU(seed)});
  const VU step = LaineKarras(ReverseBits32(walk.index), h.y);
  const VU place = hn::Add(step, hn::Add(walk.offset, h.x));
  const VU down = AsUnsigned(hn::BroadcastSignBit(hn::BitCast(DI(), place)));
  return hn::Mul(ToUnit(hn::Xor(hn::ShiftLeft<1>(place), down)), Splat(1.0f / 3));
}

/// Places of samples among replicates, as GroupRoundRobin, without an end of the
/// sequence.
LANELIGHT_INLINE GroupIndex WavelengthGroup(const RunParameters& run, VU sample) {
  const VU own = run.pairs ? UnpairedSample(sample) : sample;
  return GroupRoundRobin({.group_shift = 20}, own);
}

LANELIGHT_INLINE VF PixelWavelength(const RunParameters& run, VU pixel, VU sample) {
  const GroupIndex at = WavelengthGroup(run, sample);
  return WavelengthOn({pixel, at.group, at.index, hn::Zero(DU())}, run.seed);
}

/// Returns a number that depends on the seed, the tile and the sample only: `pixel` may
/// be any of the tile.
LANELIGHT_INLINE VF TileWavelength(const RunParameters& run, VU pixel, VU sample) {
  static_assert(kReuseTile == 16);
  const PixelPlace place(hn::BitCast(DI(), pixel), run.width);
  const VU tile = AsUnsigned(hn::Or(hn::ShiftLeft<16>(hn::ShiftRight<4>(place.row)),
                                    hn::ShiftRight<4>(place.column)));
  const GroupIndex at = WavelengthGroup(run, sample);
  const VU round = hn::ShiftRight<kLogReplicates>(at.group);
  const VU replicate = hn::And(at.group, SplatU(kReplicates - 1));
  const VU fifths = hn::Mul(replicate, SplatU(0x33333333u));
  return WavelengthOn({tile, round, at.index, fifths}, run.seed);
}

LANELIGHT_END_KERNELS

#endif

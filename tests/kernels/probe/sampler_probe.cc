#include "kernels/simd/each_target-inl.h"

#include "kernels/samplers/fill-inl.h"
#include "kernels/samplers/halton-inl.h"
#include "kernels/samplers/independent-inl.h"
#include "kernels/samplers/sobol-inl.h"
#include "kernels/samplers/stratified-inl.h"
#include "tests/kernels/probe/sampler_probe.h"

LANELIGHT_BEGIN_KERNELS

// Calls body(i, pixels, samples) for each vector of the query: lanes are pixels or, of a
// single pixel, samples. The last one is repeated past the end, as in a queue (PadTail);
// what it writes there the next row overwrites.
template <class Body>
HWY_INLINE void ForEachPoint(const SamplerQuery& q, Body&& body) {
  const DU du;
  const uint32_t lanes = static_cast<uint32_t>(hn::Lanes(du));
  const bool one = q.pixels == 1;
  const uint32_t rows = one ? 1 : q.count, columns = one ? q.count : q.pixels;
  for (uint32_t row = 0; row < rows; ++row) {
    for (uint32_t i = 0; i < columns; i += lanes) {
      const VU column = hn::Min(hn::Iota(du, i), SplatU(columns - 1));
      const VU pixel = hn::Add(SplatU(q.pixel), one ? hn::Zero(du) : column);
      const VU sample = hn::Add(SplatU(q.first_sample),
                                hn::Mul(one ? column : SplatU(row), SplatU(q.stride)));
      body(std::size_t{row} * columns + i, pixel, sample);
    }
  }
}

// Draws the numbers of a pair of dimensions; of a scalar dimension if u1 is null.
template <class Policy>
void ProbePolicy(const SamplerQuery& q, const SamplerParameters& sampler, float* u0,
                 float* u1) {
  ForEachPoint(q, [&](std::size_t i, VU pixel, VU sample) HWY_ATTR {
    const GroupIndex at = Policy::Group(sampler, sample);
    const PointKey of = {pixel, at, SplatU(q.key), SplatU(q.seed)};
    VF a, b;
    if constexpr (HasNumber<Policy>) {
      if (u1 == nullptr) {
        a = Policy::Number(of);
        return hn::StoreU(a, DF(), u0 + i);
      }
    }
    Policy::Point(of, &a, &b);
    hn::StoreU(a, DF(), u0 + i);
    if (u1 != nullptr) hn::StoreU(b, DF(), u1 + i);
  });
}

void Probe(const SamplerQuery& q, const SamplerParameters& sampler, float* u0,
           float* u1) {
  switch (q.sampler) {
#define X(Type, key, name, ...) \
  case SampleSequence::k##name: \
    return ProbePolicy<name##Sequence>(q, sampler, u0, u1);
    LANELIGHT_SAMPLE_SEQUENCES(X, SampleSequence, "points")
#undef X
  }
}

void ProbeRoundRobin(const SamplerParameters& sampler, uint32_t first, uint32_t count,
                     const GroupColumns& out) {
  const DU du;
  const uint32_t lanes = static_cast<uint32_t>(hn::Lanes(du));
  for (uint32_t i = 0; i < count; i += lanes) {
    const VU offset = hn::Min(hn::Iota(du, i), SplatU(count - 1));
    const VU sample = hn::Add(SplatU(first), offset);
    const GroupIndex at = GroupRoundRobin(sampler, sample);
    hn::StoreU(at.group, du, out.group + i);
    hn::StoreU(at.index, du, out.index + i);
    hn::StoreU(UnpairedSample(sample), du, out.unpaired + i);
  }
}

void ProbePermuted(uint32_t count, uint32_t key, bool octaves, uint32_t* out) {
  const DU du;
  const uint32_t lanes = static_cast<uint32_t>(hn::Lanes(du));
  for (uint32_t i = 0; i < count; i += lanes) {
    const VU index = hn::Min(hn::Iota(du, i), SplatU(count - 1));
    const VU image = octaves ? PermuteOctaves(index, SplatU(key))
                             : PermuteMasked(index, SplatU(count - 1), SplatU(key));
    hn::StoreU(image, du, out + i);
  }
}

LANELIGHT_END_KERNELS

#if HWY_ONCE
namespace lanelight {

HWY_EXPORT(Probe);
HWY_EXPORT(ProbeRoundRobin);
HWY_EXPORT(ProbePermuted);

void ProbeSampler(SimdTarget target, const SamplerQuery& query, float* u0, float* u1) {
  LANELIGHT_ON(target, Probe)(query, MakeSamplerParameters(query.sampler), u0, u1);
}

void ProbeNumbers(SimdTarget target, const SamplerQuery& query, float* u) {
  ProbeSampler(target, query, u, nullptr);
}

void ProbeGroups(SimdTarget target, std::uint32_t group_shift, std::uint32_t first,
                 std::uint32_t count, const GroupColumns& out) {
  SamplerParameters sampler;
  sampler.group_shift = group_shift;
  LANELIGHT_ON(target, ProbeRoundRobin)(sampler, first, count, out);
}

void ProbePermutation(SimdTarget target, std::uint32_t count, std::uint32_t key,
                      bool octaves, std::uint32_t* out) {
  LANELIGHT_ON(target, ProbePermuted)(count, key, octaves, out);
}

}  // namespace lanelight
#endif  // HWY_ONCE

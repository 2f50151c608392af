// Draws sample points for tests.
#pragma once

#include <vector>

#include "tests/kernels/probe/sampler_probe.h"
#include "tests/support/test_target.h"

namespace lanelight::test {

inline constexpr SampleSequence kAllSequences[] = {
    SampleSequence::kIndependent, SampleSequence::kStratified, SampleSequence::kSobol,
    SampleSequence::kHalton};

struct Drawn {
  std::vector<float> u0, u1;
};

inline Drawn Draw(const SamplerQuery& q) {
  const std::size_t size = std::size_t{q.count} * q.pixels;
  Drawn p{std::vector<float>(size + 16), std::vector<float>(size + 16)};
  ProbeSampler(TestTarget(), q, p.u0.data(), p.u1.data());
  p.u0.resize(size);
  p.u1.resize(size);
  return p;
}

inline std::vector<float> DrawNumbers(const SamplerQuery& q) {
  const std::size_t size = std::size_t{q.count} * q.pixels;
  std::vector<float> u(size + 16);
  ProbeNumbers(TestTarget(), q, u.data());
  u.resize(size);
  return u;
}

}  // namespace lanelight::test

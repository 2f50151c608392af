// Read bandwidth and multiply-add peak, for src/render/job/peaks.cc.
#include "kernels/simd/each_target-inl.h"

#include "kernels/peaks/peaks.h"
#include "kernels/simd/lanes-inl.h"

LANELIGHT_BEGIN_KERNELS

uint32_t SumOfWords(const uint32_t* words, size_t count, size_t passes) {
  const DU du;
  const size_t n = hn::Lanes(du);
  auto s0 = hn::Zero(du), s1 = s0, s2 = s0, s3 = s0, s4 = s0, s5 = s0, s6 = s0, s7 = s0;
  for (size_t pass = 0; pass < passes; ++pass) {
    for (size_t i = 0; i < count; i += 8 * n) {
      const uint32_t* at = words + i;
      s0 = hn::Add(s0, hn::Load(du, at));
      s1 = hn::Add(s1, hn::Load(du, at + n));
      s2 = hn::Add(s2, hn::Load(du, at + 2 * n));
      s3 = hn::Add(s3, hn::Load(du, at + 3 * n));
      s4 = hn::Add(s4, hn::Load(du, at + 4 * n));
      s5 = hn::Add(s5, hn::Load(du, at + 5 * n));
      s6 = hn::Add(s6, hn::Load(du, at + 6 * n));
      s7 = hn::Add(s7, hn::Load(du, at + 7 * n));
    }
  }
  s0 = hn::Add(hn::Add(s0, s1), hn::Add(s2, s3));
  s4 = hn::Add(hn::Add(s4, s5), hn::Add(s6, s7));
  return hn::GetLane(hn::SumOfLanes(du, hn::Add(s0, s4)));
}

// Twelve chains: two units with a latency of four to six cycles need that many.
float TwelveChains(uint64_t iterations, float factor, float addend) {
  const DF df;
  const VF f = hn::Set(df, factor), a = hn::Set(df, addend);
  const auto start = [&](float x) HWY_ATTR { return hn::Set(df, x); };
  VF x0 = start(1), x1 = start(2), x2 = start(3), x3 = start(4), x4 = start(5),
     x5 = start(6), x6 = start(7), x7 = start(8), x8 = start(9), x9 = start(10),
     x10 = start(11), x11 = start(12);
  for (uint64_t i = 0; i < iterations; ++i) {
    x0 = hn::MulAdd(x0, f, a), x1 = hn::MulAdd(x1, f, a), x2 = hn::MulAdd(x2, f, a);
    x3 = hn::MulAdd(x3, f, a), x4 = hn::MulAdd(x4, f, a), x5 = hn::MulAdd(x5, f, a);
    x6 = hn::MulAdd(x6, f, a), x7 = hn::MulAdd(x7, f, a), x8 = hn::MulAdd(x8, f, a);
    x9 = hn::MulAdd(x9, f, a), x10 = hn::MulAdd(x10, f, a), x11 = hn::MulAdd(x11, f, a);
  }
  const VF sum =
      hn::Add(hn::Add(hn::Add(hn::Add(x0, x1), hn::Add(x2, x3)), hn::Add(x4, x5)),
              hn::Add(hn::Add(hn::Add(x6, x7), hn::Add(x8, x9)), hn::Add(x10, x11)));
  return hn::GetLane(hn::SumOfLanes(df, sum)) / (12.0f * static_cast<float>(Lanes(df)));
}

int OperationsOfChains() { return 2 * 12 * static_cast<int>(hn::Lanes(DF())); }

LANELIGHT_END_KERNELS

#if HWY_ONCE
#include "src/base/core/check.h"

namespace lanelight {

HWY_EXPORT(SumOfWords);
HWY_EXPORT(TwelveChains);
HWY_EXPORT(OperationsOfChains);

std::uint32_t ReadSum(SimdTarget target, const std::uint32_t* words, std::size_t count,
                      std::size_t passes) {
  LL_CHECK_EQ(count % 1024, std::size_t{0});
  LL_CHECK_EQ(reinterpret_cast<std::uintptr_t>(words) % 64, std::uintptr_t{0});
  return LANELIGHT_ON(target, SumOfWords)(words, count, passes);
}

int MultiplyAddsOperations(SimdTarget target) {
  return LANELIGHT_ON(target, OperationsOfChains)();
}

float MultiplyAdds(SimdTarget target, std::uint64_t iterations, float factor,
                   float addend) {
  return LANELIGHT_ON(target, TwelveChains)(iterations, factor, addend);
}

}  // namespace lanelight
#endif  // HWY_ONCE

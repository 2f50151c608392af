#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/points/probe.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/points/independent-inl.h"
#include "kernels/points/probe.h"
#include "kernels/points/sobol-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

template <class Policy>
void ProbePolicy(const PointsQuery& q, float* u0, float* u1) {
  const PointsParameters points = MakePointsParameters(q.points, q.group_size);
  const uint32_t lanes = static_cast<uint32_t>(hn::Lanes(DF()));
  for (uint32_t i = 0; i < q.count; i += lanes) {
    const GroupIndex at = Policy::Group(points, hn::Iota(DU(), q.first_sample + i));
    VF a, b;
    Policy::Point(points, SplatU(q.pixel), at, SplatU(q.key), SplatU(q.seed), &a, &b);
    hn::StoreU(a, DF(), u0 + i);
    hn::StoreU(b, DF(), u1 + i);
  }
}

void Probe(const PointsQuery& q, float* u0, float* u1) {
  if (q.points == Points::kSobol) {
    ProbePolicy<SobolPoints>(q, u0, u1);
  } else {
    ProbePolicy<IndependentPoints>(q, u0, u1);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lanelight {

HWY_EXPORT(Probe);

void ProbePoints(const PointsQuery& query, float* u0, float* u1) {
  HWY_DYNAMIC_DISPATCH(Probe)(query, u0, u1);
}

}  // namespace lanelight
#endif  // HWY_ONCE

#include "kernels/probe/guide_probe.h"

#include "kernels/simd/each_target-inl.h"

#include "kernels/guide/guide-inl.h"

LANELIGHT_BEGIN_KERNELS

LANELIGHT_INLINE V3 LoadAt(const float* const a[3], std::uint32_t i) {
  const DF df;
  return {hn::LoadU(df, a[0] + i), hn::LoadU(df, a[1] + i), hn::LoadU(df, a[2] + i)};
}
LANELIGHT_INLINE VI CellsAt(const GuideBatch& b, std::uint32_t i) {
  return hn::LoadU(DI(), reinterpret_cast<const int32_t*>(b.cell) + i);
}

void GuideCells(const GuideBatch& b) {
  const GuideTop top(*b.guide);
  for (std::uint32_t i = 0; i < b.n; i += hn::Lanes(DF())) {
    const VI cell = GuideCell(*b.guide, top, LoadAt(b.point, i), LoadAt(b.normal, i));
    hn::StoreU(cell, DI(), reinterpret_cast<int32_t*>(b.cell) + i);
  }
}

void GuideSamples(const GuideBatch& b) {
  const DF df;
  for (std::uint32_t i = 0; i < b.n; i += hn::Lanes(df)) {
    const GuideSample s = SampleGuide(*b.guide, CellsAt(b, i), hn::LoadU(df, b.u0 + i),
                                      hn::LoadU(df, b.u1 + i));
    hn::StoreU(s.direction.x, df, b.direction[0] + i);
    hn::StoreU(s.direction.y, df, b.direction[1] + i);
    hn::StoreU(s.direction.z, df, b.direction[2] + i);
    hn::StoreU(s.pdf_sa, df, b.pdf_sa + i);
  }
}

void GuidePdfs(const GuideBatch& b) {
  for (std::uint32_t i = 0; i < b.n; i += hn::Lanes(DF())) {
    const VF pdf = GuidePdf(*b.guide, CellsAt(b, i), LoadAt(b.direction, i));
    hn::StoreU(pdf, DF(), b.pdf_sa + i);
  }
}

LANELIGHT_END_KERNELS

#if HWY_ONCE
namespace lanelight {

HWY_EXPORT(GuideCells);
HWY_EXPORT(GuideSamples);
HWY_EXPORT(GuidePdfs);

void ProbeGuideCells(SimdTarget target, const GuideBatch& batch) {
  LANELIGHT_ON(target, GuideCells)(batch);
}
void ProbeGuideSamples(SimdTarget target, const GuideBatch& batch) {
  LANELIGHT_ON(target, GuideSamples)(batch);
}
void ProbeGuidePdfs(SimdTarget target, const GuideBatch& batch) {
  LANELIGHT_ON(target, GuidePdfs)(batch);
}

}  // namespace lanelight
#endif  // HWY_ONCE

// Integrator parameter "regularize": after a bounce that is not specular, surfaces use
// a variant of their material whose small roughnesses are larger (pbrt-v4,
// BSDF::Regularize). Caustics become less noisy but blurred.
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/queue/slots-inl.h"
#include "src/scene/compiled/materials.h"

LANELIGHT_BEGIN_KERNELS

void Regularize(Wave& wave) {
  const PathColumns& path = wave.path;
  const AlignedVector<int32_t>& regular = wave.materials->regular;
  ForEachBatch(wave, wave.queue(QueueId::kSurface), [&](const Slots& slots, MF) HWY_ATTR {
    const DI di;
    const MF scattered = hn::Gt(Gather(path.bsdf_pdf, slots), hn::Zero(DF()));
    const VI one = hn::Set(di, 1);
    const VI now = hn::IfThenElse(hn::RebindMask(di, scattered), one,
                                  hn::BitCast(di, Gather(path.regular, slots)));
    Scatter(now, path.regular, slots);
    const VI material = Gather(path.material, slots);
    const VI rougher = Lookup(regular, material);
    Scatter(hn::IfThenElse(hn::Eq(now, one), rougher, material), path.material, slots);
  });
}

Stage RegularizeStage() {
  return {.name = "regularize",
          .meaning = "rougher materials behind a bounce that is not specular",
          .input = QueueId::kSurface,
          .role = StageRole::kShade,
          .needs = {Feature::kRegularizes, Feature::kScatters},
          .reads = {Field::bsdf_pdf, Field::regular, Field::material},
          .writes = {Field::regular, Field::material},
          .resolve = Always<Regularize>};
}

LANELIGHT_END_KERNELS

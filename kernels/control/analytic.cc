// control=analytic: at every Lambertian vertex, h is the light of the area light that was
// sampled, as if nothing were in between.
//   estimator   f - c (h - E[h]) (the paper's equation 7 with the sign of c turned), at a
//               vertex of throughput beta: h = beta (f cos) Le / p of the light sample,
//               without the weight of multiple importance sampling;
//               E[h] = beta (albedo / pi) sum over lights of Le times the irradiance of a
//               light of radiance 1 (irradiance-inl.h). A sheet that transmits adds the
//               same of its other side. c = number: applied here; optimal: by the film
//               (src/image/control_film.h)
//   unbiased    for any c, as E[h] is exact: the light sample has the density p over the
//               lights that take part at the vertex, which only its place decides. A
//               light takes no part where the vertex lies in its plane, inside its
//               sphere, or where the rim of a disk crosses the horizon
//   variance    directions=light, c=1: 0 where nothing shadows (and rounding); each light
//               adds (1 - visibility)^2 of the variance of its h where f had
//               visibility^2, a gain where more than half of the light arrives.
//               directions=mis: f holds a part of h only, so c=1 can lose: use optimal
//   elsewhere   glossy and other materials: h = 0, f is left alone
//   cost        per vertex a loop over all area lights: about 3 double arc tangents per
//               triangle, 2 per sphere, none per disk. Meant for few lights
//   source      Lambert 1760 (polygons); formulas of disk and sphere in irradiance-inl.h;
//               Fan et al. 2006, "Optimizing Control Variate Estimators for Rendering"
#include "kernels/simd/each_target-inl.h"

#include "kernels/control/apply-inl.h"
#include "kernels/control/area_lights-inl.h"
#include "kernels/bsdf/diffuse-inl.h"
#include "kernels/bsdf/diffuse_transmission-inl.h"
#include "kernels/lights/light-inl.h"
#include "kernels/queue/batch-inl.h"

LANELIGHT_BEGIN_KERNELS

template <class Bsdf, ShadeKind kKind>
void Analytic(Wave& wave) {
  const PathColumns& path = wave.path;
  const SurfaceReader<Bsdf> reader(wave);
  ForEachBatch(wave, wave.queue(ShadeQueue(kKind)), [&](const Slots& slots, MF) HWY_ATTR {
    const DiffuseVertex<Bsdf> vertex(reader, slots);
    const VI selected =
        path.ls_light != nullptr ? Gather(path.ls_light, slots) : hn::Zero(DI());
    const AreaLight lights = AreaLightsAt<Bsdf::kTransmits>(
        *wave.scene, {vertex.p, Gather(path.p_error, slots), vertex.normal}, selected,
        [&](VI light, V3 radiance)
            HWY_ATTR { return AsCarried(wave, slots, light, radiance); });
    const V3 sample = Gather3(path.ls_r, path.ls_g, path.ls_b, slots);
    const V3 h =
        Mul(vertex.Eval(Gather3(path.ls_x, path.ls_y, path.ls_z, slots)).f_cos, sample);
    const V3 expected = vertex.Scattered(lights.above, lights.below);
    const V3 difference = IfThenElseZero(lights.selected, h) - expected;
    ApplyControl(wave, slots,
                 IfThenElseZero(vertex.usable, Mul(vertex.beta, difference)));
  });
}

Stage AnalyticDiffuseStage() {
  return SurfaceControlStage("control_analytic", "control by unshadowed area lights",
                             Feature::kAnalyticControl, ShadeKind::kDiffuse,
                             Always<Analytic<DiffuseBsdf, ShadeKind::kDiffuse>>);
}
Stage AnalyticTransmissionStage() {
  return SurfaceControlStage(
      "control_analytic_sheet", "control by unshadowed area lights on both sides",
      Feature::kAnalyticControl, ShadeKind::kDiffuseTransmission,
      Always<Analytic<DiffuseTransmissionBsdf, ShadeKind::kDiffuseTransmission>>);
}

LANELIGHT_END_KERNELS

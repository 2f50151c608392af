// light-paths=splats: connects vertices of light subpaths to the camera.
//   estimator   f_cos beta |ng w| / d^2 times pixels^2 per solid angle, through a uniform
//               point of the lens
//   weight      kernels/light_paths/weights.cc
//   source      Veach 1997, section 10.3 (light image)
//
// A connection is a light sample whose light is the camera: the shading stages multiply
// with the material, the shadow stages trace its ray, and the last stage keeps it.
#include "kernels/simd/each_target-inl.h"

#include "kernels/light_paths/camera_view-inl.h"
#include "kernels/light_paths/chain-inl.h"
#include "kernels/texture/wavelengths-inl.h"
#include "kernels/warp/sphere-inl.h"
#include "src/scene/compiled/spectra.h"

LANELIGHT_BEGIN_KERNELS

constexpr uint32_t kLensStream = 0x2545f491u;

// Returns a point of the lens in camera space.
HWY_INLINE V3 LensPoint(const Wave& wave, const Slots& slots) {
  const float radius = wave.camera->lens_radius;
  if (radius == 0) return Splat3(0, 0, 0);
  const PathColumns& p = wave.path;
  const DU du;
  LaneRandom random = {
      hn::BitCast(du, Gather(p.pixel, slots)), hn::BitCast(du, Gather(p.sample, slots)),
      hn::BitCast(du, Gather(p.depth, slots)), hn::Set(du, wave.run->seed ^ kLensStream)};
  VF u[4];
  random.Next4(u);
  const V2 lens = SampleDisk(u[0], u[1]);
  return {hn::Mul(lens.x, Splat(radius)), hn::Mul(lens.y, Splat(radius)), Splat(0)};
}

HWY_INLINE MF IsBetween(VF v, float low, float high) {
  return hn::And(hn::Ge(v, Splat(low)), hn::Le(v, Splat(high)));
}

// Entries of film positions are written here, and marked as present when the shadow ray
// has arrived.
void SampleCamera(Wave& wave) {
  const PathColumns& p = wave.path;
  const LightSplats& splats = *wave.light_splats;
  const CompiledCamera& camera = *wave.camera;
  const CameraView view(camera);
  const auto splat3 = [](Vec3f v) HWY_ATTR { return Splat3(v.x, v.y, v.z); };
  const ShadingFrame axes = {splat3(camera.right), splat3(camera.up),
                             splat3(camera.forward)};
  ForEachBatch(
      wave, wave.queue(QueueId::kVertex), [&](const StoreSlots& slots, MF) HWY_ATTR {
        const V3 lens = LensPoint(wave, slots);
        const V3 eye = splat3(camera.origin) + axes.FromLocal(lens);
        const V3 at = Gather3(p.p_x, p.p_y, p.p_z, slots);
        const V3 to = eye - at;
        const VF d2 = Dot(to, to);
        const VF distance = hn::Sqrt(d2);
        const V3 w = Mul(to, hn::Div(Splat(1.0f), distance));
        const V3 film = view.FilmPoint(lens, -w);
        const V3 in = Gather3(p.d_x, p.d_y, p.d_z, slots);
        const V3 ng = Gather3(p.ng_x, p.ng_y, p.ng_z, slots);
        V3 ns = ng;
        if (p.ns_x != nullptr) ns = Gather3(p.ns_x, p.ns_y, p.ns_z, slots);
        // Importance arrives by the geometric cosine and leaves by the shading one (Veach
        // 1997, section 5.3); the material has the latter.
        const VF arrives = hn::Div(hn::Abs(Dot(ns, in)), hn::Abs(Dot(ng, in)));
        const VF leaves = hn::Div(hn::Abs(Dot(ng, w)), hn::Abs(Dot(ns, w)));
        const VF value =
            hn::Mul(hn::Mul(arrives, leaves),
                    hn::Mul(hn::Div(view.Density(-w), d2), Gather(p.lp_scale, slots)));
        const MF on_film = hn::And(IsBetween(film.x, splats.x0, splats.x1),
                                   IsBetween(film.y, splats.y0, splats.y1));
        const MF seen =
            hn::And(hn::And(hn::Gt(film.z, hn::Zero(DF())), IsPositiveFinite(value)),
                    hn::And(on_film, IsOfKind(wave, slots, kSplattingKinds)));
        const VF light = hn::IfThenElseZero(seen, value);
        Scatter3(w, p.ls_x, p.ls_y, p.ls_z, slots);
        Scatter(distance, p.ls_distance, slots);
        Scatter3({light, light, light}, p.ls_r, p.ls_g, p.ls_b, slots);
        Scatter(hn::Zero(DF()), p.ls_pdf, slots);
        const VI entry = EntryOf(p, slots);
        Scatter(film.x, splats.x, entry);
        Scatter(film.y, splats.y, entry);
      });
}

template <bool kSpectral>
void KeepSplats(Wave& wave) {
  const PathColumns& p = wave.path;
  const LightSplats& splats = *wave.light_splats;
  ForEachBatch(
      wave, wave.queue(QueueId::kShadow), [&](const StoreSlots& slots, MF) HWY_ATTR {
        const VI entry = EntryOf(p, slots);
        V3 light = Gather3(p.sh_r, p.sh_g, p.sh_b, slots);
        if constexpr (kSpectral) light = FilmColor(*wave.spectra, light, {p, slots});
        Scatter(light.x, splats.light[0], entry);
        Scatter(light.y, splats.light[1], entry);
        Scatter(light.z, splats.light[2], entry);
        Scatter(hn::Set(DI(), 1), reinterpret_cast<int32_t*>(splats.present), entry);
      });
}

Stage SampleCameraStage() {
  using namespace fields;
  return {.name = "light_path_camera",
          .meaning = "connects light vertices to the camera",
          .input = QueueId::kVertex,
          .role = StageRole::kRecord,
          .needs = {Feature::kLightSubpath, Feature::kScatters},
          .reads = kPoint | kNormal |
                   FieldSet{Field::d_x, Field::d_y, Field::d_z, Field::material,
                            Field::lp_vertex, Field::lp_scale, Field::output,
                            Field::pixel, Field::sample, Field::depth},
          .writes = kLightSample,
          .resolve = Always<SampleCamera>};
}

Stage KeepSplatsStage() {
  return {.name = "light_path_splat",
          .meaning = "keeps light vertices that the camera sees",
          .input = QueueId::kShadow,
          .role = StageRole::kRecord,
          .needs = {Feature::kLightSubpath, Feature::kScatters},
          .reads = fields::kShadow |
                   FieldSet{Field::output, Field::lp_vertex, Field::wavelength},
          .resolve = ByFeature<Feature::kSpectral, KeepSplats<true>, KeepSplats<false>>};
}

LANELIGHT_END_KERNELS

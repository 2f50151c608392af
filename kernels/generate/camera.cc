// Camera rays: film position by filter importance sampling, thin lens, perspective or
// orthographic projection; and the initial state of a path.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/generate/camera.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/generate/filter-inl.h"
#include "kernels/queue/batch-inl.h"
#include "kernels/simd/vec3-inl.h"
#include "kernels/warp/disk-inl.h"
#include "src/compiled/scene.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

// Constants that the columns of a new path begin with; absent columns are skipped here,
// once per call.
struct InitialValues {
  static constexpr int kMost = 24;
  float* columns[kMost];
  float values[kMost];
  int count = 0;

  explicit InitialValues(const PathColumns& p) {
    for (float* column : {p.beta_r, p.beta_g, p.beta_b, p.eta_scale}) Add(column, 1.0f);
    for (float* column :
         {p.l_r, p.l_g, p.l_b, p.bsdf_pdf, p.k_r, p.k_g, p.k_b, p.aov_albedo_r,
          p.aov_albedo_g, p.aov_albedo_b, p.aov_n_x, p.aov_n_y, p.aov_n_z, p.aov_depth}) {
      Add(column, 0.0f);
    }
    for (float* column : {p.first_0, p.first_1, p.first_2, p.first_3}) Add(column, -1.0f);
    Add(p.t, std::numeric_limits<float>::infinity());
  }
  void Add(float* column, float value) {
    if (column == nullptr) return;
    columns[count] = column;
    values[count++] = value;
  }
  HWY_INLINE void Store(const StoreSlots& slots) const {
    for (int i = 0; i < count; ++i) Scatter(Splat(values[i]), columns[i], slots);
  }
};

// Film position in pixels: pixel centre plus a point distributed like |filter|.
template <bool kBox>
HWY_INLINE void FilmPosition(const Wave& wave, const StoreSlots& slots, VF* x, VF* y) {
  const CompiledFilter& filter = wave.scene->filter;
  const PathColumns& p = wave.path;
  const VI pixel = Gather(p.pixel, slots);
  const VF u0 = Gather(p.u_film_0, slots), u1 = Gather(p.u_film_1, slots);
  VF dx, dy;
  if constexpr (kBox) {
    dx = hn::Mul(hn::MulAdd(u0, Splat(2.0f), Splat(-1.0f)), Splat(filter.x_radius));
    dy = hn::Mul(hn::MulAdd(u1, Splat(2.0f), Splat(-1.0f)), Splat(filter.y_radius));
  } else {
    VF sign_x, sign_y;
    dx = SampleFilterAxis(filter.x_cdf.data(), filter.x_sign.data(), filter.x_radius, u0,
                          &sign_x);
    dy = SampleFilterAxis(filter.y_cdf.data(), filter.y_sign.data(), filter.y_radius, u1,
                          &sign_y);
    if (p.weight != nullptr) {
      Scatter(hn::Mul(hn::Mul(sign_x, sign_y), Splat(filter.weight)), p.weight, slots);
    }
  }
  // Row and column of the pixel index: float division is off by at most one row for
  // images of less than 2^31 pixels, which the correction undoes.
  const DI di;
  const VI width = hn::Set(di, static_cast<int32_t>(wave.run->width));
  VI row = hn::ConvertTo(di, hn::Mul(hn::ConvertTo(DF(), pixel),
                                     Splat(1.0f / static_cast<float>(wave.run->width))));
  VI column = hn::Sub(pixel, hn::Mul(row, width));
  for (int step = 0; step < 2; ++step) {
    const auto low = hn::Lt(column, hn::Zero(di));
    row = hn::IfThenElse(low, hn::Sub(row, hn::Set(di, 1)), row);
    column = hn::IfThenElse(low, hn::Add(column, width), column);
    const auto high = hn::Gt(column, hn::Sub(width, hn::Set(di, 1)));
    row = hn::IfThenElse(high, hn::Add(row, hn::Set(di, 1)), row);
    column = hn::IfThenElse(high, hn::Sub(column, width), column);
  }
  *x = hn::Add(hn::Add(hn::ConvertTo(DF(), column), Splat(0.5f)), dx);
  *y = hn::Add(hn::Add(hn::ConvertTo(DF(), row), Splat(0.5f)), dy);
}

template <bool kBox, bool kLens, bool kPerspective>
void Camera(Wave& wave) {
  const CompiledCamera& camera = wave.scene->camera;
  const PathColumns& p = wave.path;
  Queue& queue = wave.queue(QueueId::kCamera);
  const auto splat = [](Vec3f v) HWY_ATTR { return Splat3(v.x, v.y, v.z); };
  const V3 base = splat(camera.base), dx = splat(camera.dx), dy = splat(camera.dy);
  const Frame axes = {splat(camera.right), splat(camera.up), splat(camera.forward)};
  const InitialValues initial(p);
  ForEachBatch(wave, queue, [&](const StoreSlots& slots, MF valid) HWY_ATTR {
    initial.Store(slots);
    Scatter(hn::Zero(DI()), p.depth, slots);
    if (p.b1 != nullptr) {  // with triangles
      Scatter(hn::Set(DI(), static_cast<int32_t>(kNoPrimitive)), p.prim, slots);
    }
    VF x, y;
    FilmPosition<kBox>(wave, slots, &x, &y);
    const V3 film = MulAdd(dx, x, MulAdd(dy, y, base));
    V3 origin = kPerspective ? Splat3(0, 0, 0) : film;
    V3 direction = kPerspective ? film : Splat3(0, 0, 1);
    if constexpr (kLens) {
      const V2 lens = SampleDisk(Gather(p.u_lens_0, slots), Gather(p.u_lens_1, slots));
      const VF radius = Splat(camera.lens_radius);
      const V3 focus = MulAdd(direction, Splat(camera.focal_distance), origin);
      origin = origin + V3{hn::Mul(lens.x, radius), hn::Mul(lens.y, radius), Splat(0)};
      direction = focus - origin;
    }
    const V3 o = splat(camera.origin) + axes.FromLocal(origin);
    Scatter3(o, p.o_x, p.o_y, p.o_z, slots);
    Scatter3(Normalize(axes.FromLocal(direction)), p.d_x, p.d_y, p.d_z, slots);
    Push(wave.queue(QueueId::kActive), slots, valid);
  });
}

// One exported kernel per variant.
void CameraBoxPinhole(Wave& w) { Camera<true, false, true>(w); }
void CameraBoxLens(Wave& w) { Camera<true, true, true>(w); }
void CameraFilteredPinhole(Wave& w) { Camera<false, false, true>(w); }
void CameraFilteredLens(Wave& w) { Camera<false, true, true>(w); }
void CameraBoxOrthographic(Wave& w) { Camera<true, false, false>(w); }
void CameraFilteredOrthographic(Wave& w) { Camera<false, false, false>(w); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "src/path/stage.h"

namespace lanelight {

HWY_EXPORT(CameraBoxPinhole);
HWY_EXPORT(CameraBoxLens);
HWY_EXPORT(CameraFilteredPinhole);
HWY_EXPORT(CameraFilteredLens);
HWY_EXPORT(CameraBoxOrthographic);
HWY_EXPORT(CameraFilteredOrthographic);

namespace {

StageFn ResolveCamera(const FeatureSet& features) {
  const bool filtered = features.Has(Feature::kFiltered);
  if (features.Has(Feature::kOrthographic)) {
    return filtered ? HWY_DYNAMIC_DISPATCH(CameraFilteredOrthographic)
                    : HWY_DYNAMIC_DISPATCH(CameraBoxOrthographic);
  }
  if (features.Has(Feature::kLens)) {
    return filtered ? HWY_DYNAMIC_DISPATCH(CameraFilteredLens)
                    : HWY_DYNAMIC_DISPATCH(CameraBoxLens);
  }
  return filtered ? HWY_DYNAMIC_DISPATCH(CameraFilteredPinhole)
                  : HWY_DYNAMIC_DISPATCH(CameraBoxPinhole);
}

}  // namespace

Stage CameraStage() {
  return {
      "camera",
      "camera rays and the initial state of a path",
      QueueId::kCamera,
      {},
      {Field::pixel, Field::u_film_0, Field::u_film_1, Field::u_lens_0, Field::u_lens_1},
      fields::kRay | fields::kThroughput | fields::kRadiance | fields::kAov |
          fields::kControl | fields::kFirstBounce |
          FieldSet{Field::depth, Field::bsdf_pdf, Field::eta_scale, Field::t, Field::prim,
                   Field::weight},
      ResolveCamera};
}

}  // namespace lanelight
#endif  // HWY_ONCE

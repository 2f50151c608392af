// Shared by the surface kernels of spheres, disks, planes and curves.
#ifndef LANELIGHT_SURFACE_STORE_INL_H_
#define LANELIGHT_SURFACE_STORE_INL_H_

#include <limits>
#include <numbers>

#include "hwy/contrib/math/math-inl.h"
#include "kernels/queue/batch-inl.h"
#include "kernels/simd/records-inl.h"
#include "kernels/surface/point-inl.h"

LANELIGHT_BEGIN_KERNELS

/// The surface at a vector of hits.
struct SurfaceLanes {
  V3 p, n;
  VF error;
  VI material;
};

/// Returns the records of hits on primitives of one shape, whose ids begin at `first`.
template <class Record>
LANELIGHT_INLINE RecordWords<Record> HitRecords(const AlignedVector<Record>& records,
                                                VI prim, uint32_t first) {
  const VI begin = hn::Set(DI(), static_cast<int32_t>(first));
  return RecordWords(records.data(), hn::Sub(prim, begin));
}

template <bool kUpper>
LANELIGHT_INLINE D3 RayPoint(const PathColumns& path, const Slots& slots) {
  const V3 o = Gather3(path.o_x, path.o_y, path.o_z, slots);
  const V3 d = Gather3(path.d_x, path.d_y, path.d_z, slots);
  return MulAdd(HalfOf<kUpper>(d), HalfOf<kUpper>(Gather(path.t, slots)),
                HalfOf<kUpper>(o));
}

/// Returns the foot of the perpendicular from `p` to the plane through `point` with
/// normal n.
template <bool kUpper>
LANELIGHT_INLINE D3 ProjectToPlane(D3 p, V3 point, V3 n) {
  const D3 nd = HalfOf<kUpper>(n), rel = Minus(p, HalfOf<kUpper>(point));
  return MulAdd(nd, hn::Neg(hn::Div(Dot(nd, rel), Dot(nd, nd))), p);
}

/// Writes the columns of every hit; these shapes have no shading normal of their own.
/// Optional columns are tested per vector, because a variant of the kernel for each set
/// of columns would take long to compile.
LANELIGHT_INLINE void StoreSurface(const PathColumns& path, const StoreSlots& slots,
                                   const SurfaceLanes& s) {
  Scatter3(s.p, path.p_x, path.p_y, path.p_z, slots);
  Scatter(s.error, path.p_error, slots);
  Scatter3(s.n, path.ng_x, path.ng_y, path.ng_z, slots);
  if (path.ns_x != nullptr) Scatter3(s.n, path.ns_x, path.ns_y, path.ns_z, slots);
  Scatter(s.material, path.material, slots);
}

/// Returns the angle of (x, y) in [0, 2 pi], as a fraction of the circle; absolute error
/// below 1e-6.
LANELIGHT_INLINE VF TurnFraction(VF y, VF x) {
  const DF df;
  const VF ay = hn::Abs(y), ax = hn::Abs(x);
  const VF high = hn::Max(ax, ay);
  const VF ratio = hn::Div(hn::Min(ax, ay), hn::Max(high, Splat(0x1p-126f)));
  const VF eighth = hn::Mul(hn::Atan(df, ratio), Splat(0.5f / std::numbers::pi_v<float>));
  const VF quarter =
      hn::IfThenElse(hn::Gt(ay, ax), hn::Sub(Splat(0.25f), eighth), eighth);
  const VF half =
      hn::IfThenElse(hn::Lt(x, hn::Zero(df)), hn::Sub(Splat(0.5f), quarter), quarter);
  return hn::IfThenElse(hn::Lt(y, hn::Zero(df)), hn::Sub(Splat(1.0f), half), half);
}

/// Returns `tangent`, or any direction across n if it vanishes (at the centre, at a
/// pole).
LANELIGHT_INLINE V3 TangentOr(V3 tangent, V3 n) {
  const VF length2 = Dot(tangent, tangent);
  return IfThenElse(hn::Gt(length2, hn::Zero(DF())), tangent, FrameFromNormal(n).s);
}

/// Writes dp/dv, or where it vanishes or is unbounded, a direction across n.
LANELIGHT_INLINE void StoreBitangent(const PathColumns& path, const StoreSlots& slots,
                                     V3 bitangent, V3 n) {
  const VF length2 = Dot(bitangent, bitangent);
  const MF usable = hn::And(hn::Gt(length2, hn::Zero(DF())),
                            hn::Lt(length2, Splat(std::numeric_limits<float>::max())));
  Scatter3(IfThenElse(usable, bitangent, FrameFromNormal(n).t), path.tv_x, path.tv_y,
           path.tv_z, slots);
}

/// Returns dp/dv of a sphere, v = 0 at the pole -z_axis, 1 at z_axis, at the unit vector
/// `out` from its centre: along the meridian, half a turn long. Not finite at the poles.
LANELIGHT_INLINE V3 SphereBitangent(V3 out, V3 z_axis, VF radius) {
  const V3 up = MulAdd(out, hn::Neg(Dot(out, z_axis)), z_axis);
  return Mul(
      up, hn::Mul(hn::Mul(radius, Splat(std::numbers::pi_v<float>)), Rsqrt(Dot(up, up))));
}

/// The unit vector `out` from the centre of a sphere.
struct SpherePoint {
  V3 out;
  VF radius, circumference;
};

/// Writes coordinates and tangents of a sphere. v = 1 - theta / pi, theta from the pole
/// z.
template <class Record>
LANELIGHT_INLINE void StoreSphereCoordinates(const PathColumns& path,
                                             const StoreSlots& slots,
                                             const RecordWords<Record>& record,
                                             const SpherePoint& at) {
  const V3 out = at.out;
  if (path.tg_x == nullptr && path.uv_u == nullptr) return;
  const V3 x_axis = record.F3(offsetof(Record, x_axis));
  const V3 z_axis = record.F3(offsetof(Record, z_axis));
  const V3 y_axis = Mul(Cross(z_axis, x_axis), record.F(offsetof(Record, y_sign)));
  const VF x = Dot(out, x_axis);
  const VF y = Dot(out, y_axis);
  if (path.uv_u != nullptr) {
    // Half a turn of (z, across).
    const VF z = Dot(out, z_axis);
    const VF across = hn::Sqrt(hn::MulAdd(x, x, hn::Mul(y, y)));
    const VF theta = TurnFraction(across, z);
    Scatter(TurnFraction(y, x), path.uv_u, slots);
    Scatter(hn::NegMulAdd(Splat(2.0f), theta, Splat(1.0f)), path.uv_v, slots);
  }
  if (path.tg_x == nullptr) return;
  const V3 around = MulAdd(y_axis, x, Mul(x_axis, hn::Neg(y)));
  Scatter3(TangentOr(Mul(around, at.circumference), out), path.tg_x, path.tg_y, path.tg_z,
           slots);
  if (path.tv_x != nullptr) {
    StoreBitangent(path, slots, SphereBitangent(out, z_axis, at.radius), out);
  }
}

/// Processes the hits on primitives of one shape, from one range to the next.
template <auto kBatch, std::uint32_t PrimitiveRanges::* kFirst,
          std::uint32_t PrimitiveRanges::* kNext>
void SurfaceOfShape(Wave& wave) {
  const PrimitiveRanges& ranges = *wave.ranges;
  const Queue& hits = FilterPrimitives(wave, wave.queue(QueueId::kSurface),
                                       ranges.*kFirst, ranges.*kNext);
  ForEachBatch(wave, hits,
               [&](const StoreSlots& slots, MF) HWY_ATTR { kBatch(wave, slots); });
}

/// The surface stage of a shape with that kernel.
inline Stage ShapeStage(const char* name, const char* meaning, Feature shape,
                        StageFn (*resolve)(const FeatureSet&)) {
  return {.name = name,
          .meaning = meaning,
          .input = QueueId::kSurface,
          .role = StageRole::kSurface,
          .needs = {shape, Feature::kScatters},
          .reads = fields::kRay | FieldSet{Field::t, Field::prim},
          .writes = kSurfaceFields,
          .resolve = resolve};
}

LANELIGHT_END_KERNELS

#endif

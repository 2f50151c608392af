// The surface at hits on curves.
//
// Flat curves face the ray. Curves of type cylinder have normals that turn across the
// width, like those of a tube. Points stay on the ray, at the depth of the middle line
// (as in pbrt-v4). v goes across, so that dp/du x dp/dv is the normal. Unlike here,
// normals of flat curves point away from the ray in pbrt-v4, and those of cylinders are
// the ones of a tube's far side.
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/simd/math-inl.h"
#include "kernels/surface/store-inl.h"
#include "src/scene/geometry/geometry.h"
#include "src/vocabulary/path/scene_kinds.h"

LANELIGHT_BEGIN_KERNELS

struct CurveLanes {
  V3 p[4];
  VF width[2], u;
  MF cylinder, ribbon;
  VI material;
};

HWY_INLINE CurveLanes LoadCurves(const Geometry& geometry, VI index, VF u) {
  const Records records(geometry.curves.data(), 16, index);
  VF w[16];
  for (int i = 0; i < 16; i += 4) records.Load4(i, w + i);
  const VI type = hn::BitCast(DI(), w[15]);
  const auto is = [&](CurveType t) HWY_ATTR {
    return hn::RebindMask(DF(), hn::Eq(type, hn::Set(DI(), static_cast<int32_t>(t))));
  };
  return {
      {{w[0], w[1], w[2]}, {w[3], w[4], w[5]}, {w[6], w[7], w[8]}, {w[9], w[10], w[11]}},
      {w[12], w[13]},
      u,
      is(CurveType::kCylinder),
      is(CurveType::kRibbon),
      hn::BitCast(DI(), w[14])};
}

// The point of a curve, and the tangent there, by the corner-cutting of de Casteljau.
struct OnCurve {
  D3 p, tangent;
};
template <bool kUpper>
HWY_INLINE OnCurve PointOnCurve(const CurveLanes& curve) {
  const VD u = HalfOf<kUpper>(curve.u);
  const auto mix = [&](D3 a, D3 b) HWY_ATTR { return MulAdd(Minus(b, a), u, a); };
  D3 p[4];
  for (int k = 0; k < 4; ++k) p[k] = HalfOf<kUpper>(curve.p[k]);
  for (int n = 3; n > 1; --n) {
    for (int k = 0; k < n; ++k) p[k] = mix(p[k], p[k + 1]);
  }
  const D3 chord = Minus(p[1], p[0]);
  const VD three = hn::Set(DD(), 3.0);
  return {mix(p[0], p[1]),
          {hn::Mul(chord.x, three), hn::Mul(chord.y, three), hn::Mul(chord.z, three)}};
}

// The point of the ray, and its offset from the middle line.
struct CurvePlaces {
  V3 p, aside, tangent;
};
HWY_INLINE CurvePlaces PlaceCurves(const PathColumns& path, const StoreSlots& slots,
                                   const CurveLanes& curve) {
  const D3 lower = RayPoint<false>(path, slots), upper = RayPoint<true>(path, slots);
  const OnCurve low = PointOnCurve<false>(curve), high = PointOnCurve<true>(curve);
  const V3 tangent = FromHalves(low.tangent, high.tangent);
  // An end where points coincide.
  const MF still = hn::Not(hn::Gt(Dot(tangent, tangent), hn::Zero(DF())));
  return {FromHalves(lower, upper), FromHalves(Minus(lower, low.p), Minus(upper, high.p)),
          IfThenElse(still, curve.p[3] - curve.p[0], tangent)};
}

// The normals of ribbons, across the tangent; `facing` of other curves.
HWY_INLINE V3 RibbonNormals(const Geometry& geometry, VI index, const CurveLanes& curve,
                            V3 facing) {
  if (geometry.ribbons.empty()) return facing;
  const Records records(geometry.ribbons.data(), 8, index);
  VF w[8];
  records.Load4(0, w);
  records.Load4(4, w + 4);
  const VF angle = w[6], one = Splat(1.0f);
  const VF rest = hn::Sub(one, curve.u);
  const MF turns = hn::Gt(angle, hn::Zero(DF()));
  const auto weight = [&](VF fraction) HWY_ATTR {
    const VF part = hn::Mul(hn::Mul(fraction, angle), Splat(0.5f * kInvPi));
    return hn::IfThenElse(turns, hn::Mul(SinCos2Pi(part).sin, w[7]), fraction);
  };
  const V3 n = MulAdd(V3{w[0], w[1], w[2]}, weight(rest),
                      Mul(V3{w[3], w[4], w[5]}, weight(curve.u)));
  return IfThenElse(curve.ribbon, n, facing);
}

// Unit, across `along`, which is unit: `n` made so.
HWY_INLINE V3 AcrossCurve(V3 n, V3 along) {
  const V3 flat = MulAdd(along, hn::Neg(Dot(n, along)), n);
  const MF usable = hn::Gt(Dot(flat, flat), Splat(1e-12f));
  return IfThenElse(usable, Normalize(flat), FrameFromNormal(along).s);
}

// The space where curves are met; see CurveSpace.
struct CurveSpaceLanes {
  V3 object[3], scene[3];  // rows of the maps to there and back

  HWY_INLINE CurveSpaceLanes(const Geometry& geometry, VI index) {
    const RecordWords words(geometry.curve_spaces.data(), index);
    for (std::size_t a = 0; a < 3; ++a) {
      object[a] = words.F3(offsetof(CurveSpace, object_from_scene) + 12 * a);
      scene[a] = words.F3(offsetof(CurveSpace, scene_from_object) + 12 * a);
    }
  }
  HWY_INLINE static V3 Map(const V3 rows[3], V3 v) {
    return {Dot(rows[0], v), Dot(rows[1], v), Dot(rows[2], v)};
  }
  HWY_INLINE V3 NormalToScene(V3 n) const {
    return MulAdd(object[0], n.x, MulAdd(object[1], n.y, Mul(object[2], n.z)));
  }
};

// Widths, normals and coordinates across, in the space of the curves.
struct CurveFaces {
  V3 n, bitangent;
  VF width, aside;
};
HWY_INLINE CurveFaces FaceCurves(const Geometry& geometry, VI index,
                                 const CurveLanes& curve, const CurvePlaces& at, V3 d) {
  const V3 along = Normalize(at.tangent);
  const V3 own = RibbonNormals(geometry, index, curve, -d);
  const V3 face = AcrossCurve(own, along);
  const V3 side = Cross(face, along);
  // The width across the sight.
  const VF turned = hn::IfThenElse(curve.ribbon, hn::Abs(Dot(own, d)), Splat(1.0f));
  const VF wider = hn::Sub(curve.width[1], curve.width[0]);
  const VF width = hn::Mul(turned, hn::MulAdd(wider, curve.u, curve.width[0]));
  // The offset across the curve and the ray, as a share of the width.
  const V3 seen = Cross(AcrossCurve(-d, along), along);
  const VF offset = Dot(at.aside, seen);
  const VF apart = hn::CopySign(offset, hn::Mul(offset, Dot(seen, side)));
  const VF half = Splat(0.5f);
  const VF aside =
      hn::Clamp(hn::Div(apart, hn::Max(width, Splat(1e-37f))), hn::Neg(half), half);
  const VF turn = hn::IfThenElseZero(curve.cylinder, hn::Mul(Splat(0.5f), aside));
  const SinCosPair a = SinCos2Pi(turn);
  return {MulAdd(face, a.cos, Mul(side, a.sin)),
          Mul(MulAdd(side, a.cos, Mul(face, hn::Neg(a.sin))), width), width, aside};
}

// The same in the scene.
HWY_INLINE CurveFaces FaceStretchedCurves(const Geometry& geometry, VI index,
                                          const CurveLanes& curve, CurvePlaces at, V3 d) {
  const CurveSpaceLanes space(geometry, index);
  at.aside = space.Map(space.object, at.aside);
  at.tangent = space.Map(space.object, at.tangent);
  CurveFaces faces =
      FaceCurves(geometry, index, curve, at, Normalize(space.Map(space.object, d)));
  faces.n = Normalize(space.NormalToScene(faces.n));
  faces.bitangent = space.Map(space.scene, faces.bitangent);
  return faces;
}

HWY_INLINE void CurveBatch(const Wave& wave, const StoreSlots& slots) {
  const PathColumns& path = wave.path;
  const Geometry& geometry = *wave.geometry;
  const VI first = hn::Set(DI(), static_cast<int32_t>(geometry.ranges.curves));
  const VI index = hn::Sub(Gather(path.prim, slots), first);
  const CurveLanes curve = LoadCurves(geometry, index, Gather(path.b1, slots));
  const CurvePlaces at = PlaceCurves(path, slots, curve);
  const V3 d = Gather3(path.d_x, path.d_y, path.d_z, slots);
  const CurveFaces faces = geometry.curve_spaces.empty()
                               ? FaceCurves(geometry, index, curve, at, d)
                               : FaceStretchedCurves(geometry, index, curve, at, d);
  SurfaceLanes surface{
      .p = at.p, .n = faces.n, .error = Splat(0), .material = curve.material};
  surface.error = RoundingError(at.p, faces.n, faces.width);
  StoreSurface(path, slots, surface);
  if (path.uv_u != nullptr) {
    Scatter(curve.u, path.uv_u, slots);
    Scatter(hn::Add(faces.aside, Splat(0.5f)), path.uv_v, slots);
  }
  if (path.tg_x == nullptr) return;
  Scatter3(at.tangent, path.tg_x, path.tg_y, path.tg_z, slots);
  if (path.tv_x != nullptr) StoreBitangent(path, slots, faces.bitangent, faces.n);
}

Stage SurfaceCurveStage() {
  Stage stage = ShapeStage(
      "surface_curve", "point, normals and material of hits on curves", Feature::kCurves,
      Always<
          SurfaceOfShape<CurveBatch, &PrimitiveRanges::curves, &PrimitiveRanges::end>>);
  stage.reads = stage.reads | FieldSet{Field::b1};
  return stage;
}

LANELIGHT_END_KERNELS

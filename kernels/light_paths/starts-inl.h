// Starts light subpaths at lights, and computes the densities of their starts for MIS
// weights (chain-inl.h). The light is chosen by the table of LightEmission.
//   shapes      point uniform over the area, direction by the cosine, to either side of
//               two: pmf cos / (pi area), half of that with two sides
//   positions   direction uniform in a cone: pmf / (2 pi versine)
//   infinity    direction that of the light or by its table; origin uniform on a disk
//               as large as the scene: pmf pdf_sa / (pi radius^2)
#ifndef LANELIGHT_LIGHT_PATHS_STARTS_INL_H_
#define LANELIGHT_LIGHT_PATHS_STARTS_INL_H_

#include "kernels/lights/environment-inl.h"
#include "kernels/lights/light_points-inl.h"
#include "kernels/light_paths/chain-inl.h"
#include "src/scene/prepare/tables.h"

LANELIGHT_BEGIN_KERNELS

HWY_INLINE bool HasPlanes(const Wave& wave) { return !wave.geometry->planes.empty(); }

/// Returns what has been learned of subpaths from infinity; null if nothing has.
HWY_INLINE const EmissionGuide* GuideOf(const Wave& wave) {
  const StrategyTables* tables = wave.run->tables;
  return tables != nullptr && tables->emission.has_learned() ? &tables->emission
                                                             : nullptr;
}
HWY_INLINE const LightStarts& StartsOf(const Wave& wave) {
  const EmissionGuide* guide = GuideOf(wave);
  return guide == nullptr ? wave.chances->emission : guide->lights;
}
/// Returns the probability of each light to start subpaths; 0: none start there.
HWY_INLINE VF StartPmf(const Wave& wave, VI index) {
  return Gather(StartsOf(wave).pmf.data(), index);
}

/// Returns the density, by area, of the points of shapes; 0 for other lights.
HWY_INLINE VF AreaDensity(const Wave& wave, const Lights& light, VI index) {
  const VF area = light.Area();
  const MF has_area = hn::Gt(area, hn::Zero(DF()));
  return hn::IfThenElseZero(has_area, hn::Div(StartPmf(wave, index), area));
}

/// Returns the density of directions from a shape over their cosine.
HWY_INLINE VF PerCosine(const Lights& light) {
  return hn::IfThenElse(light.TwoSided(), Splat(0.5f * kInvPi), Splat(kInvPi));
}

/// Directions from lights with a position: all, those of a spot's or projection's own
/// cone, or from outside the scene those of the cone around it, whichever are fewest.
struct StartCone {
  V3 axis;
  VF versine;  // 1 - cos of the half angle

  HWY_INLINE StartCone(const Wave& wave, const Lights& light) {
    const LightTable& table = *wave.lights;
    const LightEmission& emission = wave.chances->emission;
    axis = Splat3(0, 0, 1);
    versine = Splat(2.0f);
    if (table.radius > 0 && !HasPlanes(wave)) {
      const V3 center = Splat3(table.center[0], table.center[1], table.center[2]);
      const V3 to_center = center - light.F3(offsetof(LightRecord, position));
      const VF d2 = Dot(to_center, to_center), radius = Splat(table.radius);
      const MF outside = hn::Gt(d2, hn::Mul(radius, radius));
      axis = IfThenElse(outside, Normalize(to_center), axis);
      versine = hn::IfThenElse(outside, OneMinusCosCone(radius, d2), versine);
    }
    if (!emission.Has(LightShape::kSpot) && !emission.Has(LightShape::kProjection)) {
      return;
    }
    const VF own = light.F(offsetof(LightRecord, size));
    const MF has_cone = hn::Or(HasShape(light, LightShape::kSpot),
                               HasShape(light, LightShape::kProjection));
    const MF narrower = hn::And(has_cone, hn::Lt(own, versine));
    axis = IfThenElse(narrower, light.F3(offsetof(LightRecord, direction)), axis);
    versine = hn::IfThenElse(narrower, own, versine);
  }
  HWY_INLINE VF Pdf() const { return hn::Div(Splat(0.5f * kInvPi), versine); }
};

/// Returns whether lights have a position and no extent.
HWY_INLINE MF HasPosition(const Lights& light) {
  return hn::Or(
      hn::Or(HasShape(light, LightShape::kPoint), HasShape(light, LightShape::kSpot)),
      hn::Or(HasShape(light, LightShape::kGoniometric),
             HasShape(light, LightShape::kProjection)));
}
/// Returns whether subpaths start at lights of that kind.
HWY_INLINE bool StartAtPositions(const LightEmission& emission) {
  return emission.Has(LightShape::kPoint) || emission.Has(LightShape::kSpot) ||
         emission.Has(LightShape::kGoniometric) || emission.Has(LightShape::kProjection);
}

/// A place on the disk before lights at infinity, in units of its radius.
struct DiskPlace {
  VF x, y;
  MF on_disk;

  HWY_INLINE DiskPlace(VF along_x, VF along_y) : x(along_x), y(along_y) {
    const VF one = Splat(1.0f);
    on_disk = hn::Lt(hn::MulAdd(x, x, hn::Mul(y, y)), one);
  }
};

/// Returns where rays from infinity to these points start. Points of infinite planes lie
/// beside the disk, or beyond it: these have no place.
HWY_INLINE DiskPlace PlaceOnDisk(const Wave& wave, V3 at, V3 toward) {
  const LightTable& table = *wave.lights;
  const VF inverse = Splat(1 / table.radius);
  const V3 from =
      Mul(at - Splat3(table.center[0], table.center[1], table.center[2]), inverse);
  const ShadingFrame frame = FrameFromNormal(toward);
  DiskPlace place(Dot(from, frame.s), Dot(from, frame.t));
  const MF before = hn::Lt(Dot(from, toward), Splat(1.0f));
  place.on_disk = hn::And(place.on_disk, before);
  return place;
}

/// A square of cells for each lane; `first` < 0: none.
struct GuideSquare {
  VI first;
  uint32_t side;

  HWY_INLINE MF HasCells() const {
    return hn::RebindMask(DF(), hn::Gt(first, hn::Set(DI(), -1)));
  }
  /// Returns the cell of a place; where there are no cells, any.
  HWY_INLINE VI CellOf(const DiskPlace& place) const {
    const VF half = Splat(0.5f * static_cast<float>(side));
    const VI last = hn::Set(DI(), static_cast<int32_t>(side) - 1);
    const auto along = [&](VF v) HWY_ATTR {
      const VI cell = hn::ConvertTo(DI(), hn::MulAdd(v, half, half));
      return hn::Max(hn::Zero(DI()), hn::Min(cell, last));
    };
    const VI row = hn::Mul(along(place.y), hn::Set(DI(), static_cast<int32_t>(side)));
    return hn::Add(hn::Max(first, hn::Zero(DI())), hn::Add(row, along(place.x)));
  }
};

HWY_INLINE GuideSquare SquareOfDistant(const Wave& wave, VI index) {
  const EmissionGuide* guide = GuideOf(wave);
  const VI none = hn::Set(DI(), -1);
  const VI first = guide == nullptr ? none : Gather(guide->distant.data(), index);
  return {first, EmissionGuide::kSunSide};
}

/// Returns the square of the direction's bin.
HWY_INLINE GuideSquare SquareOfSky(const Wave& wave, V3 toward) {
  const EmissionGuide* guide = GuideOf(wave);
  const DI di;
  constexpr uint32_t kSide = EmissionGuide::kSkySide, kBins = EmissionGuide::kSkyBins;
  if (guide == nullptr || guide->sky < 0) return {hn::Set(di, -1), kSide};
  const VF one = Splat(1.0f), inverse = hn::Div(one, SumAbs(toward));
  const VF x = hn::Mul(toward.x, inverse), y = hn::Mul(toward.y, inverse);
  const MF below = hn::Lt(toward.z, hn::Zero(DF()));
  const VF u = hn::IfThenElse(below, hn::CopySign(hn::Sub(one, hn::Abs(y)), x), x);
  const VF v = hn::IfThenElse(below, hn::CopySign(hn::Sub(one, hn::Abs(x)), y), y);
  const VI bin = GuideSquare{hn::Zero(di), kBins}.CellOf(DiskPlace(u, v));
  const VI cells = hn::Mul(bin, hn::Set(di, static_cast<int32_t>(kSide * kSide)));
  return {hn::Add(hn::Set(di, guide->sky), cells), kSide};
}
/// Returns whether a plane lies between these points and infinity.
HWY_INLINE MF IsBehindPlane(const Wave& wave, V3 at, V3 toward) {
  const VF zero = hn::Zero(DF());
  MF behind = hn::Lt(zero, zero);
  for (const PlaneRecord& plane : wave.geometry->planes) {
    const V3 n = Splat3(plane.normal[0], plane.normal[1], plane.normal[2]);
    const V3 point = Splat3(plane.point[0], plane.point[1], plane.point[2]);
    const VF sides = hn::Mul(Dot(at - point, n), Dot(toward, n));
    behind = hn::Or(behind, hn::Lt(sides, zero));
  }
  return behind;
}

/// Returns the density of origins, by area, before lights at infinity.
HWY_INLINE VF OriginDensity(const Wave& wave, const GuideSquare& square,
                            const DiskPlace& place) {
  const float radius2 = wave.lights->radius * wave.lights->radius;
  const VF disk = hn::IfThenElseZero(place.on_disk, Splat(kInvPi / radius2));
  const EmissionGuide* guide = GuideOf(wave);
  if (guide == nullptr) return disk;
  const float cells = static_cast<float>(square.side * square.side);
  const VF pmf = Gather(guide->pmf.data(), square.CellOf(place));
  const VF per_area = Splat((1 - EmissionGuide::kDefensive) * cells / (4 * radius2));
  // Nothing starts in the corners of the square: beside infinite planes, what is found
  // there would depend on what has been learned.
  const VF learned = hn::IfThenElseZero(place.on_disk, hn::Mul(pmf, per_area));
  const VF both = hn::MulAdd(disk, Splat(EmissionGuide::kDefensive), learned);
  return hn::IfThenElse(square.HasCells(), both, disk);
}
HWY_INLINE bool StartAtSky(const LightEmission& emission) {
  return emission.Has(LightShape::kInfiniteConstant) ||
         emission.Has(LightShape::kInfiniteImage);
}

/// Returns the density of the direction `toward` infinite lights, of all together: they
/// are weighed as one light.
HWY_INLINE VF SkyDensity(const Wave& wave, V3 toward) {
  const LightTable& table = *wave.lights;
  VF sum = hn::Zero(DF());
  for (const uint32_t index : table.infinite) {
    const LightRecord& light = table.lights[index];
    VF pdf = Splat(0.25f * kInvPi);
    if (light.environment >= 0) {
      const Environment& e = table.environments[static_cast<uint32_t>(light.environment)];
      pdf = LookUpEnvironment(e, *e.table, toward).pdf_sa;
    }
    sum = hn::MulAdd(pdf, Splat(StartsOf(wave).pmf[index]), sum);
  }
  return sum;
}

/// Densities with which the last step of a path, from x_k to the light y, is found. The
/// densities of light samples and subpaths are relative to the measure of y in which E
/// has the density pdf_sa. If E cannot find y, they are relative to the light's measure.
struct LastStep {
  VF subpath;  // of x_k and y, over the cosine at x_k; 0: no subpath starts there
  VF sample;   // of y
  MF can_hit;  // E finds the light

  HWY_INLINE void Take(MF mask, const LastStep& other) {
    subpath = hn::IfThenElse(mask, other.subpath, subpath);
    sample = hn::IfThenElse(mask, other.sample, sample);
    can_hit = hn::Or(hn::And(mask, other.can_hit), hn::AndNot(mask, can_hit));
  }
};

/// Returns the step to a point of a shape, whose normal has this cosine > 0 to it.
HWY_INLINE LastStep StepToShape(const Wave& wave, const Lights& light, VI index,
                                VF distance, VF cosine) {
  const VF density = AreaDensity(wave, light, index);
  return {hn::Mul(density, PerCosine(light)),
          hn::Div(hn::Mul(density, hn::Mul(distance, distance)), cosine),
          hn::Gt(density, hn::Zero(DF()))};
}

/// Returns the density of subpaths from a light at infinity to points, over the cosine
/// there and the density of their direction.
HWY_INLINE VF DensityFromDisk(const Wave& wave, V3 at, V3 toward,
                              const GuideSquare& square) {
  if (!HasPlanes(wave) && GuideOf(wave) == nullptr) {
    const float radius = wave.lights->radius;
    return Splat(kInvPi / (radius * radius));
  }
  return OriginDensity(wave, square, PlaceOnDisk(wave, at, toward));
}

/// Returns the step from points to infinite lights.
HWY_INLINE LastStep StepToSky(const Wave& wave, V3 at, V3 toward) {
  const VF density = SkyDensity(wave, toward);
  return {hn::Mul(density, DensityFromDisk(wave, at, toward, SquareOfSky(wave, toward))),
          density, hn::Gt(density, hn::Zero(DF()))};
}

LANELIGHT_END_KERNELS

#endif

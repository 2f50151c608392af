#include "src/scene/compile/shape_records.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "src/base/core/error.h"
#include "src/scene/compile/world_frame.h"

namespace lanelight {
namespace {

// Beyond this stretch float32 cannot square what kernels square.
constexpr double kMaxStretch = 0x1p30;

// Returns the factor of widths: the cube root of the factor of volumes.
double ScaleOf(const Transform& transform) {
  const double scale = transform.UniformScale();
  return scale > 0 ? scale : std::cbrt(std::abs(transform.Determinant3()));
}

bool KeepsShapes(const Transform& transform) {
  return transform.UniformScale() > 0 && !transform.SwapsHandedness();
}

double LengthOfRow(const Transform& t, int row) {
  return std::hypot(t(row, 0), t(row, 1), t(row, 2));
}

// pbrt-v4 meets curves in the space of their object, where they are round.
CurveSpace SpaceOf(const Shape& shape, const Transform& transform) {
  CurveSpace space{};
  if (KeepsShapes(transform)) {
    for (int k = 0; k < 9; k += 4) {
      space.object_from_scene[k] = space.scene_from_object[k] = 1;
    }
    return space;
  }
  const double scale = ScaleOf(transform);
  const Transform inverse = transform.Inverse();
  double longest = 0;
  for (int row = 0; row < 3; ++row) {
    longest = std::max({longest, LengthOfRow(transform, row) / scale,
                        LengthOfRow(inverse, row) * scale});
    for (int column = 0; column < 3; ++column) {
      const int k = 3 * row + column;
      space.object_from_scene[k] = static_cast<float>(inverse(row, column) * scale);
      space.scene_from_object[k] = static_cast<float>(transform(row, column) / scale);
    }
  }
  if (!(longest <= kMaxStretch)) {
    throw InputError(shape.where,
                     "the transform of this curve flattens it; give directions scales "
                     "that differ by less than 1e9");
  }
  return space;
}

bool HasRibbon(const std::vector<Curve>& curves) {
  return std::ranges::any_of(curves,
                             [](const Curve& c) { return c.type == CurveType::kRibbon; });
}

// Below this angle (radians) spherical and linear interpolation of normals are equal.
constexpr double kMinAngle = 1e-3;

RibbonRecord RibbonOf(const PlacedShape& placed, const Curve& curve) {
  RibbonRecord record{};
  if (curve.type != CurveType::kRibbon) return record;
  Vec3d n[2];
  for (int end = 0; end < 2; ++end) {
    n[end] = KeepsShapes(placed.transform)
                 ? Normalize(placed.transform.Normal(curve.normal[end]))
                 : Normalize(curve.normal[end]);
    if (placed.flip) n[end] = -n[end];
    Store(n[end], record.normal[end]);
  }
  const double angle = std::atan2(Length(Cross(n[0], n[1])), Dot(n[0], n[1]));
  if (angle < kMinAngle) return record;
  record.angle = static_cast<float>(angle);
  record.inverse_sine = static_cast<float>(1 / std::sin(angle));
  return record;
}

// Stores the space of the `count` curves that are added next.
void AddSpaces(const CurveSpace& space, std::size_t count, Geometry& geometry) {
  const CurveSpace identity = SpaceOf({}, Transform());
  const bool same = std::memcmp(&space, &identity, sizeof(space)) == 0;
  if (same && geometry.curve_spaces.empty()) return;
  geometry.curve_spaces.resize(geometry.curves.size(), identity);
  geometry.curve_spaces.resize(geometry.curves.size() + count, space);
}

}  // namespace

Box CurveBox(const Shape& shape, const Transform& transform) {
  const Vec3d reach{LengthOfRow(transform, 0), LengthOfRow(transform, 1),
                    LengthOfRow(transform, 2)};
  Box box;
  for (const Curve& curve : *shape.curves) {
    const Vec3d r = 0.5 * std::max(curve.width[0], curve.width[1]) * reach;
    for (const Vec3d& p : curve.p) {
      const Vec3d at = transform.Point(p);
      box.Add(at - r);
      box.Add(at + r);
    }
  }
  return box;
}

void AddCurves(const PlacedShape& placed, const WorldFrame& frame, std::uint32_t material,
               Geometry& geometry) {
  const std::vector<Curve>& curves = *placed.shape->curves;
  if (curves.size() > kMaxCurves - geometry.curves.size()) {
    throw InputError(placed.shape->where,
                     fmt::format("too many curves; {} are supported in one scene, with "
                                 "those of each instance",
                                 kMaxCurves));
  }
  const Transform to_scene = frame.After(placed.transform);
  const double scale = ScaleOf(placed.transform) * frame.scale;
  const bool ribbons = !geometry.ribbons.empty() || HasRibbon(curves);
  if (ribbons) geometry.ribbons.resize(geometry.curves.size(), RibbonRecord{});
  AddSpaces(SpaceOf(*placed.shape, placed.transform), curves.size(), geometry);
  for (const Curve& curve : curves) {
    CurveRecord record;
    for (int k = 0; k < 4; ++k) Store(to_scene.Point(curve.p[k]), record.p[k]);
    for (int end = 0; end < 2; ++end) {
      record.width[end] = static_cast<float>(scale * curve.width[end]);
    }
    record.material = material;
    record.type = static_cast<std::uint32_t>(curve.type);
    geometry.curves.push_back(record);
    if (ribbons) geometry.ribbons.push_back(RibbonOf(placed, curve));
  }
}

}  // namespace lanelight

#include "src/compile/curves.h"

#include <algorithm>
#include <cmath>

#include "src/core/error.h"
#include "src/compile/store.h"

namespace lanelight {
namespace {

double ScaleOf(const Shape& shape, const Transform& transform) {
  const double scale = transform.UniformScale();
  if (scale > 0) return scale;
  throw InputError(shape.where,
                   "the transform stretches this curve more in one direction than in "
                   "another; supported are transforms that keep shapes: give its points "
                   "stretched");
}

bool HasRibbon(const std::vector<Curve>& curves) {
  return std::any_of(curves.begin(), curves.end(),
                     [](const Curve& c) { return c.type == CurveType::kRibbon; });
}

// Below this angle the sines of a turn are those of a line.
constexpr double kLeastTurn = 1e-3;

RibbonRecord RibbonOf(const PlacedShape& placed, const Curve& curve) {
  RibbonRecord record{};
  if (curve.type != CurveType::kRibbon) return record;
  Vec3d n[2];
  for (int end = 0; end < 2; ++end) {
    n[end] = Normalize(placed.transform.Normal(curve.normal[end]));
    if (placed.flip) n[end] = -n[end];
    Store(n[end], record.normal[end]);
  }
  const double angle = std::atan2(Length(Cross(n[0], n[1])), Dot(n[0], n[1]));
  if (angle < kLeastTurn) return record;
  record.angle = static_cast<float>(angle);
  record.inverse_sine = static_cast<float>(1 / std::sin(angle));
  return record;
}

}  // namespace

Box CurveBox(const Shape& shape, const Transform& transform) {
  const double scale = ScaleOf(shape, transform);
  Box box;
  for (const Curve& curve : *shape.curves) {
    const double r = 0.5 * scale * std::max(curve.width[0], curve.width[1]);
    for (const Vec3d& p : curve.p) {
      const Vec3d at = transform.Point(p);
      box.Add(at - Vec3d{r, r, r});
      box.Add(at + Vec3d{r, r, r});
    }
  }
  return box;
}

void AddCurves(const PlacedShape& placed, const Frame& frame, std::uint32_t material,
               Geometry& geometry) {
  const std::vector<Curve>& curves = *placed.shape->curves;
  if (curves.size() > kMostCurves - geometry.curves.size()) {
    throw InputError(placed.shape->where,
                     fmt::format("too many curves; {} are supported in one scene, with "
                                 "those of each instance",
                                 kMostCurves));
  }
  const Transform to_scene = frame.After(placed.transform);
  const double scale = ScaleOf(*placed.shape, placed.transform) * frame.scale;
  const bool ribbons = !geometry.ribbons.empty() || HasRibbon(curves);
  if (ribbons) geometry.ribbons.resize(geometry.curves.size(), RibbonRecord{});
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

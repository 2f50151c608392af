// The boxes of shapes, grown against rounding, to be sorted into a tree.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "src/base/core/parallel.h"
#include "src/scene/accel/builder.h"
#include "src/scene/geometry/geometry.h"

namespace lanelight {

/// Growth of boxes that covers every rounding of the slab test and of the shape tests: 32
/// unit roundoffs (2^-24) per unit of coordinate, of the shape here and of the ray's
/// origin in the kernels. The triangle test needs 20 of them
/// (kernels/intersect/triangle-inl.h), the slab test 5 (kernels/intersect/bvh-inl.h).
inline constexpr float kShapeSlack = 0x1p-19f;

inline float Reach(const AccelBox& box) {
  float reach = 0;
  for (int a = 0; a < 3; ++a) {
    reach = std::max({reach, std::abs(box.lo[a]), std::abs(box.hi[a])});
  }
  return reach;
}

/// The box of a shape, or of a part of it, grown for coordinates of the shape up to
/// `reach`: not those of the scene, so that a teapot in a stadium stays sharp.
inline AccelBox Grown(const AccelBox& box, float reach) {
  const float margin = kShapeSlack * reach;
  const Vec3f by{margin, margin, margin};
  return {box.lo - by, box.hi + by};
}

inline bool IsFinite(Vec3f v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
inline bool IsFinite(const AccelBox& b) { return IsFinite(b.lo) && IsFinite(b.hi); }

inline AccelBox BoxOf(const TriangleRecord& triangle) {
  AccelBox box;
  bool finite = true;
  for (const auto& p : triangle.p) {
    const Vec3f corner{p[0], p[1], p[2]};
    finite = finite && IsFinite(corner);
    box.Extend(corner);
  }
  if (!finite) box.lo.x = NAN;
  return box;
}

inline float TriangleArea(const TriangleRecord& triangle) {
  const auto corner = [&](int k) {
    const float* p = triangle.p[k];
    return Vec3f{p[0], p[1], p[2]};
  };
  return 0.5f * Length(Cross(corner(1) - corner(0), corner(2) - corner(0)));
}

/// Boxes of round shapes are rounded outwards, since centre plus radius may round
/// inwards.
inline AccelBox Around(const float* center, float radius) {
  AccelBox box;
  for (int a = 0; a < 3; ++a) {
    box.lo[a] = std::nextafter(center[a] - radius, -INFINITY);
    box.hi[a] = std::nextafter(center[a] + radius, INFINITY);
  }
  return box;
}
inline AccelBox BoxOf(const SphereRecord& s) { return Around(s.center, s.radius); }
inline AccelBox BoxOf(const DiskRecord& s) { return Around(s.center, s.radius); }

inline constexpr std::size_t kItemGrain = 4096;

/// Finite boxes of records [begin, end), grown. The first has id `first_id`.
template <typename Records>
std::vector<BuildItem> ItemsOf(const Records& records, std::uint32_t begin,
                               std::uint32_t end, std::uint32_t first_id) {
  std::vector<BuildItem> items(end - begin);
  ParallelForRange(items.size(), kItemGrain, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      const AccelBox box = BoxOf(records[begin + i]);
      items[i] = {Grown(box, Reach(box)), first_id + static_cast<std::uint32_t>(i)};
    }
  });
  std::erase_if(items, [](const BuildItem& item) { return !IsFinite(item.box); });
  return items;
}

}  // namespace lanelight

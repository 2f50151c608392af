#include "src/scene/prepare/medium_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "src/scene/geometry/geometry.h"

namespace lanelight {
namespace {

// Intersection tests of all calls: less than a second.
constexpr std::uint64_t kMaxTests = 50'000'000;
// Along no axis or diagonal, where rays would meet edges.
constexpr Vec3d kDirections[] = {{0.613, 0.507, 0.606},
                                 {-0.571, -0.653, 0.497},
                                 {-0.483, 0.669, -0.564},
                                 {0.701, -0.449, -0.554}};

Vec3d MapPoint(const float* m, Vec3d p) {
  Vec3d out;
  for (int r = 0; r < 3; ++r) {
    const float* row = m + 4 * r;
    out[r] = double(row[0]) * p.x + double(row[1]) * p.y + double(row[2]) * p.z +
             double(row[3]);
  }
  return out;
}

// Calls found(t) for the solutions of a t^2 + 2 b t + c = 0.
template <class Found>
void Solve(double a, double b, double c, const Found& found) {
  if (a == 0) {
    if (b != 0) found(-c / (2 * b));
    return;
  }
  const double discriminant = b * b - a * c;
  if (discriminant <= 0) return;
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  found(q / a);
  if (q != 0) found(c / q);
}

// Returns the normal of a triangle on the side that its vertex normals say, if any.
Vec3d NormalAt(const Geometry& g, std::uint32_t i, const double weights[3]) {
  const TriangleRecord& t = g.triangles[i];
  const Vec3d p0 = ToVec(t.p[0]);
  const Vec3d face = Cross(ToVec(t.p[1]) - p0, ToVec(t.p[2]) - p0);
  if (g.normals.empty()) return face;
  Vec3d n;
  for (std::size_t k = 0; k < 3; ++k) {
    n += ToVec(&g.normals[9 * std::size_t{i} + 3 * k]) * weights[k];
  }
  return Dot(n, face) < 0 ? -face : face;
}

}  // namespace

MediumMap::MediumMap(const CompiledScene& scene)
    : scene_(scene),
      triangles_(std::max<std::size_t>(scene.geometry.groups.size(), 1)),
      tests_left_(kMaxTests) {
  FindSurfaces();
  LookFromCamera();
}

void MediumMap::Bound(Vec3d low, Vec3d high) {
  const bool first = low_.x > high_.x;
  low_ = first ? low : Min(low_, low);
  high_ = first ? high : Max(high_, high);
}

void MediumMap::FindSurfaces() {
  const Geometry& g = scene_.geometry;
  const AlignedVector<std::int32_t>& sides = scene_.media.primitives;
  for (std::size_t group = 0; group < g.groups.size(); ++group) {
    for (std::uint32_t i = g.groups[group].begin; i < g.groups[group].end; ++i) {
      if (sides[i] < 0) continue;
      triangles_[group].push_back(i);
      if (group > 0) bounded_ = false;  // by how it is placed
      for (const float* p : g.triangles[i].p) Bound(ToVec(p), ToVec(p));
    }
  }
  for (std::uint32_t i = g.ranges.spheres; i < g.ranges.curves; ++i) {
    if (sides[i] < 0) continue;
    others_.push_back(i);
    if (i >= g.ranges.planes) {
      bounded_ = false;
    } else {
      const bool round = i < g.ranges.disks;
      const float* center = round ? g.spheres[i - g.ranges.spheres].center
                                  : g.disks[i - g.ranges.disks].center;
      const double r = round ? g.spheres[i - g.ranges.spheres].radius
                             : g.disks[i - g.ranges.disks].radius;
      Bound(ToVec(center) - Vec3d{r, r, r}, ToVec(center) + Vec3d{r, r, r});
    }
  }
}

template <class Found>
void MediumMap::CrossTriangles(const Ray& ray, std::size_t group,
                               const Found& found) const {
  const Geometry& g = scene_.geometry;
  for (const std::uint32_t i : triangles_[group]) {
    const TriangleRecord& t = g.triangles[i];
    const Vec3d p0 = ToVec(t.p[0]);
    const Vec3d e1 = ToVec(t.p[1]) - p0, e2 = ToVec(t.p[2]) - p0, s = ray.o - p0;
    const Vec3d q = Cross(ray.d, e2), r = Cross(s, e1);
    const double det = Dot(e1, q);
    if (det == 0) continue;
    const double b1 = Dot(s, q) / det, b2 = Dot(ray.d, r) / det;
    if (b1 < 0 || b2 < 0 || b1 + b2 > 1) continue;
    const double weights[3] = {1 - b1 - b2, b1, b2};
    found(i, Dot(e2, r) / det, NormalAt(g, i, weights));
  }
}

template <class Found>
void MediumMap::CrossRound(const Ray& ray, const Found& found) const {
  const Geometry& g = scene_.geometry;
  for (const std::uint32_t i : others_) {
    if (i < g.ranges.disks) {
      const SphereRecord& s = g.spheres[i - g.ranges.spheres];
      const Vec3d o = ray.o - ToVec(s.center);
      const double r = s.radius;
      Solve(Dot(ray.d, ray.d), Dot(o, ray.d), Dot(o, o) - r * r,
            [&](double t) { found(i, t, (o + ray.d * t) * double(s.normal_sign)); });
    } else if (i >= g.ranges.large_spheres) {
      const LargeSphereRecord& s = g.large_spheres[i - g.ranges.large_spheres];
      const Vec3d o = ray.o - ToVec(s.point), n = ToVec(s.normal);
      const double k = s.curvature;
      Solve(k * Dot(ray.d, ray.d), k * Dot(o, ray.d) + Dot(n, ray.d),
            k * Dot(o, o) + 2 * Dot(o, n), [&](double t) {
              found(i, t, ((o + ray.d * t) * k + n) * double(s.normal_sign));
            });
    }
  }
}

template <class Found>
void MediumMap::CrossFlat(const Ray& ray, const Found& found) const {
  const Geometry& g = scene_.geometry;
  const auto reach = [&](const float* point, const float* normal) {
    return Dot(ToVec(point) - ray.o, ToVec(normal)) / Dot(ray.d, ToVec(normal));
  };
  for (const std::uint32_t i : others_) {
    if (i >= g.ranges.disks && i < g.ranges.planes) {
      const DiskRecord& disk = g.disks[i - g.ranges.disks];
      const double t = reach(disk.center, disk.normal);
      const double r = Length(ray.o + ray.d * t - ToVec(disk.center));
      if (r >= double(disk.inner_radius) && r <= double(disk.radius)) {
        found(i, t, ToVec(disk.normal));
      }
    } else if (i >= g.ranges.planes && i < g.ranges.large_spheres) {
      const PlaneRecord& plane = g.planes[i - g.ranges.planes];
      found(i, reach(plane.point, plane.normal), ToVec(plane.normal));
    }
  }
}

std::vector<MediumMap::Crossing> MediumMap::Crossings(const Ray& ray) {
  const Geometry& g = scene_.geometry;
  std::vector<Crossing> out;
  const auto found_along = [&](Vec3d d) {
    return [&, d](std::uint32_t primitive, double t, Vec3d normal) {
      if (!(t > 0)) return;
      const auto index = std::size_t(scene_.media.primitives[primitive]);
      const MediumSides& sides = scene_.media.sides[index];
      const bool leaves = Dot(d, normal) > 0;
      out.push_back({t, leaves ? sides.inside : sides.outside,
                     leaves ? sides.outside : sides.inside});
    };
  };
  CrossTriangles(ray, 0, found_along(ray.d));
  CrossRound(ray, found_along(ray.d));
  CrossFlat(ray, found_along(ray.d));
  std::uint64_t tests = triangles_[0].size() + others_.size();
  for (std::size_t i = 0; i < g.instances.size(); ++i) {
    const float* map = g.instances[i].object_from_scene;
    const Vec3d o = MapPoint(map, ray.o), d = MapPoint(map, ray.o + ray.d) - o;
    CrossTriangles({o, d}, g.instance_group[i], found_along(d));
    tests += triangles_[g.instance_group[i]].size();
  }
  tests_left_ -= std::min(tests, tests_left_);
  std::ranges::sort(out, {}, &Crossing::t);
  return out;
}

bool MediumMap::Agree(std::int32_t here, const std::vector<Crossing>& all) {
  for (const Crossing& crossing : all) {
    if (crossing.before != here) return false;
    here = crossing.after;
  }
  return true;
}

void MediumMap::LookFromCamera() {
  const Vec3f& eye = scene_.view.camera.origin;
  for (const Vec3d& d : kDirections) {
    const std::vector<Crossing> all = Crossings({VecCast<double>(eye), d});
    consistent_ = consistent_ && Agree(scene_.media.camera, all);
    const std::int32_t last = all.empty() ? scene_.media.camera : all.back().after;
    if (&d == &kDirections[0]) outside_ = last;
    if (last != outside_) outside_ = kUnclear;
  }
}

std::int32_t MediumMap::At(Vec3d p) {
  if (bounded_ && (Min(p, low_) != low_ || Max(p, high_) != high_)) return outside_;
  std::optional<std::int32_t> medium;
  for (const Vec3d& d : kDirections) {
    if (tests_left_ == 0) return kUnclear;
    const std::vector<Crossing> all = Crossings({p, d});
    if (all.empty()) continue;
    if (!medium) medium = all[0].before;
    if (!Agree(*medium, all)) return kUnclear;
  }
  return medium.value_or(outside_);
}

}  // namespace lanelight

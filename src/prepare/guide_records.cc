#include "src/prepare/guide_records.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "src/core/check.h"
#include "src/prepare/guide_square.h"

namespace lanelight {
namespace {

std::uint16_t Fixed(double unit) {
  return static_cast<std::uint16_t>(std::clamp(unit * 65536, 0.0, 65535.0));
}

// What the planes say of one ray.
struct Ray {
  Vec3f from;
  std::uint32_t normal, toward;
  float pdf, sent, before;

  explicit Ray(const float* plane)
      : from{plane[0], plane[1], plane[2]},
        normal(std::bit_cast<std::uint32_t>(plane[3])),
        toward(std::bit_cast<std::uint32_t>(plane[4])),
        pdf(plane[5]),
        sent(plane[6]),
        before(plane[7]) {}
};

bool IsUsable(const Ray& ray, double radiance) {
  // Far too small throughputs make estimates of rounding errors.
  return std::isfinite(ray.from.x) && std::isfinite(ray.from.y) &&
         std::isfinite(ray.from.z) && std::isfinite(ray.pdf) && ray.sent > 1e-30f &&
         std::isfinite(radiance) && radiance < 1e30;
}

GuideRecord RecordOf(const Ray& ray, double radiance, const Guide& guide) {
  GuideRecord r;
  r.from = ray.from;
  r.normal = UnpackDirection(ray.normal);
  const GuideSquarePoint at = ToGuideSquare(VecCast<double>(r.normal),
                                            VecCast<double>(UnpackDirection(ray.toward)));
  const bool above = at.to_solid_angle > 0;
  const double pdf = double{ray.pdf};
  r.u = Fixed(at.u), r.v = Fixed(at.v);
  r.radiance = static_cast<float>(radiance);
  r.cosine = above ? static_cast<float>(at.cosine / std::numbers::pi / pdf) : 0;
  const std::uint32_t cell = GuideCellAt(guide, r.from, r.normal);
  const double c = double{guide.fraction[cell]};
  if (c == 0) return r;
  const double g =
      above ? double{GuideDensity(guide, cell, r.u, r.v)} * at.to_solid_angle / pdf : 0;
  // q = c g + (1 - c) p; rounding at the borders of cells must not make p negative.
  r.guide = static_cast<float>(std::min(g, 1 / c));
  r.material = static_cast<float>(std::max(0.0, 1 - c * g) / (1 - c));
  return r;
}

}  // namespace

Vec3f UnpackDirection(std::uint32_t packed) {
  const double u = double(packed & 0xffff) / 32767.5 - 1;
  const double v = double(packed >> 16) / 32767.5 - 1;
  Vec3d d{u, v, 1 - std::abs(u) - std::abs(v)};
  if (d.z < 0) {
    d.x = std::copysign(1 - std::abs(v), u);
    d.y = std::copysign(1 - std::abs(u), v);
  }
  return VecCast<float>(Normalize(d));
}

std::uint32_t GuideCellAt(const Guide& guide, Vec3f point, Vec3f normal) {
  const float values[] = {point.x, point.y, point.z, normal.x, normal.y, normal.z};
  std::uint32_t at = 0;
  for (;;) {
    const Guide::Node& node = guide.nodes[at];
    const std::uint32_t axis = node.next & 7, next = node.next >> 3;
    if (axis == Guide::Node::kLeaf) return next;
    at = next + (values[axis] < node.at ? 0u : 1u);
  }
}

float GuideDensity(const Guide& guide, std::uint32_t cell, std::uint16_t u,
                   std::uint16_t v) {
  static_assert(kGuideGrid == 16);
  const std::size_t square = (std::size_t{v} >> 12) * kGuideGrid + (std::size_t{u} >> 12);
  return guide.density[cell * kGuideSquares + square];
}

std::uint64_t ReadGuideRecords(std::span<const float> planes, const Guide& guide,
                               std::vector<GuideRecord>& records) {
  LL_CHECK_EQ(planes.size() % kGuidePlanes, std::size_t{0});
  std::uint64_t invalid = 0;
  for (std::size_t at = 0; at < planes.size(); at += kGuidePlanes) {
    const double end = double{planes[at + kGuidePlanes - 1]};
    for (std::size_t k = 0; k < kRecordedVertices; ++k) {
      const Ray ray(&planes[at + k * kGuideRayPlanes]);
      if (ray.pdf == 0) continue;
      // Differences of sums: never below zero but for rounding.
      const double radiance = (end - double{ray.before}) / double{ray.sent};
      const bool usable = IsUsable(ray, radiance);
      if (usable) records.push_back(RecordOf(ray, std::max(0.0, radiance), guide));
      invalid += usable ? 0 : 1;
    }
  }
  return invalid;
}

}  // namespace lanelight

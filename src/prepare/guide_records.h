// What a guide learns from: scattered rays of training passes, and what they have brought
// (kernels/guide/record.cc).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/core/vec.h"
#include "src/path/sample_planes.h"
#include "src/prepare/guide.h"

namespace lanelight {

/// A scattered ray, in the numbers that training needs. With q the density that chose its
/// direction, p that of the material, g that of the guide of the pass there:
struct GuideRecord {
  Vec3f from;          // where it starts
  Vec3f normal;        // there, on the side that the path came from
  std::uint16_t u, v;  // direction: point of the cell's square, in 2^-16
  float radiance;      // estimate of what arrives, >= 0, finite
  float cosine = 1;    // density of the cosine / q; 0: below the surface, no point
  float material = 1;  // p / q
  float guide = 0;     // g / q; 0: the pass knew of no guide there

  /// Its share of what arrives, as the material weighs it: p / q times the radiance. The
  /// sum over a square of directions estimates the integral of p L, up to a factor.
  double Mass() const { return double{radiance} * double{material}; }
};

/// Planes of PlaneGroup::kGuideRecord for one ray, and their number for a sample.
inline constexpr int kGuideRayPlanes = 8;
inline constexpr int kGuidePlanes = kGuideRayPlanes * kRecordedVertices + 1;
static_assert(NumPlanes(PlaneGroup::kGuideRecord) == kGuidePlanes);

/// The unit vector that the stage has packed into 32 bits, within 5e-5.
Vec3f UnpackDirection(std::uint32_t packed);

/// The cell of a point and a normal, as kernels find it.
std::uint32_t GuideCellAt(const Guide& guide, Vec3f point, Vec3f normal);

/// Density over [-1, 1]^2 at a point of a cell's square, in 2^-16.
float GuideDensity(const Guide& guide, std::uint32_t cell, std::uint16_t u,
                   std::uint16_t v);

/// Appends the rays of samples, kGuidePlanes values each, that `guide` (of which nothing
/// may be known) took part in. Leaves out what is not a ray: specular ones, and what is
/// not finite. Returns how many were left out for that last reason.
std::uint64_t ReadGuideRecords(std::span<const float> planes, const Guide& guide,
                               std::vector<GuideRecord>& records);

}  // namespace lanelight

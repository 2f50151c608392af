// Shapes as the kernels read them: float32 records in scene space, recentred and scaled
// by a power of two (p_scene = (p_world - center) * scale).
//
// Primitives are fixed-size records, because a shading kernel gathers many words of one
// primitive: a record is one or two cache lines, one array per word would be many.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "src/base/core/aligned.h"
#include "src/base/core/motion_record.h"
#include "src/base/core/vec.h"
#include "src/vocabulary/path/scene_parts.h"

namespace lanelight {

/// Triangle record: 12 words. Wound so that cross(p1-p0, p2-p0) is the surface normal
/// (ReverseOrientation and mirroring transforms are already applied; uv and normals are
/// permuted alike). Triangles of object definitions are in object space.
struct TriangleRecord {
  float p[3][3];
  std::uint32_t material;
  std::int32_t light;   // index into LightTable::lights, -1 = not emitting
  std::uint32_t flags;  // kAlphaTested, kMeshNormals, kRotatedTangents
};
static_assert(sizeof(TriangleRecord) == 48);
inline constexpr std::uint32_t kAlphaTested = 1;
/// The file gives normals, which change the axes of bumps (kernels/surface/bumps.cc).
inline constexpr std::uint32_t kMeshNormals = 2;
/// The mesh has TriangleMesh::rotates_tangents.
inline constexpr std::uint32_t kRotatedTangents = 4;

/// Sphere record: 16 words. `normal_sign` -1: normal points inward (ReverseOrientation).
struct SphereRecord {
  float center[3];
  float radius;
  std::uint32_t material;
  std::int32_t light;
  std::uint32_t flags;
  float normal_sign;
  float x_axis[3],
      z_axis[3];  // object axes in scene space, unit, for uv; y = cross(z, x)*
  float y_sign;   // *times y_sign (mirrored transforms)
  std::uint32_t pad;
};
static_assert(sizeof(SphereRecord) == 64);

/// Disk record: 16 words.
struct DiskRecord {
  float center[3];
  float radius;
  float normal[3];  // unit, on the emitting side
  float inner_radius;
  float u_axis[3];  // unit, object x; v axis = v_sign * cross(normal, u_axis)
  std::uint32_t material;
  std::int32_t light;
  std::uint32_t flags;
  float v_sign;
  std::uint32_t pad;
};
static_assert(sizeof(DiskRecord) == 64);

/// Infinite plane record: 16 words. uv = (dot(p - point, u_axis), dot(p - point,
/// v_axis)), axes scaled so that uv are object-space x and y.
struct PlaneRecord {
  float point[3];
  std::uint32_t material;
  float normal[3];
  std::int32_t light;  // always -1: an infinite plane cannot emit
  float u_axis[3];
  std::uint32_t flags;
  float v_axis[3];
  std::uint32_t pad;
};
static_assert(sizeof(PlaneRecord) == 64);

/// Sphere that is much larger than its distance from the camera: 20 words. The points q,
/// relative to `point` on the sphere, with curvature |q|^2 + 2 q . normal = 0: a form
/// that is exact about `point`, however large the radius. `normal` points away from the
/// centre; the others are as in SphereRecord.
struct LargeSphereRecord {
  float point[3];
  std::uint32_t material;
  float normal[3];
  float curvature;  // 1 / radius
  float x_axis[3];
  float normal_sign;
  float z_axis[3];
  float y_sign;
  std::int32_t light;  // always -1
  std::uint32_t flags;
  std::uint32_t pad[2];
};
static_assert(sizeof(LargeSphereRecord) == 80);

/// Cubic Bezier curve: 16 words. Emits nothing.
struct CurveRecord {
  float p[4][3];
  float width[2];  // at both ends, not negative
  std::uint32_t material;
  std::uint32_t type;  // CurveType
};
static_assert(sizeof(CurveRecord) == 64);

/// A ribbon's unit normals at both ends, their angle, and 1 / its sine; the angle is 0 if
/// they are equal. Zeros for other curves.
struct RibbonRecord {
  float normal[2][3];
  float angle, inverse_sine;
};
static_assert(sizeof(RibbonRecord) == 32);

/// Space of the intersection test of a curve: that of its object, stretched or mirrored
/// in the scene. 3x3 maps of directions, row by row, with determinants of 1 or -1;
/// identities for curves whose transform keeps shapes. Widths and ribbon normals are in
/// this space.
struct CurveSpace {
  float object_from_scene[9];
  float scene_from_object[9];
  float pad[2];
};
static_assert(sizeof(CurveSpace) == 80);

/// Instance record: 24 words, row-major 3x4 affine maps.
struct InstanceRecord {
  float object_from_scene[12];
  float scene_from_object[12];
};

struct Geometry {
  PrimitiveRanges ranges;
  AlignedVector<TriangleRecord> triangles;
  AlignedVector<float>
      normals;  // 9 per triangle (3 vertices); empty without kVertexNormals.
                // Unit; triangles without normals hold their face normal.
  bool rotated_tangents = false;  // some triangles are kRotatedTangents
  AlignedVector<float> uvs;       // 6 per triangle; empty if not needed
  AlignedVector<SphereRecord> spheres;
  AlignedVector<DiskRecord> disks;
  AlignedVector<PlaneRecord> planes;
  AlignedVector<LargeSphereRecord> large_spheres;
  AlignedVector<CurveRecord> curves;
  AlignedVector<RibbonRecord> ribbons;     // one for each curve; empty without ribbons
  AlignedVector<CurveSpace> curve_spaces;  // one for each; empty if all are identities
  AlignedVector<InstanceRecord> instances;
  /// Motions of the first instances; `instances` holds their maps at shutter opening.
  /// Empty if none moves.
  AlignedVector<MotionRecord> motions;
  /// Triangle ranges that form one acceleration structure each: [0] is the world (may be
  /// empty), the others are object definitions.
  struct TriangleGroup {
    std::uint32_t begin = 0, end = 0;
  };
  std::vector<TriangleGroup> groups;
  std::vector<std::uint32_t> instance_group;  // group of each instance
  Vec3f bounds_min, bounds_max;               // of everything finite, scene space
};

/// Returns in `weight` the weights of the two end normals at u in [0, 1] along a ribbon,
/// for a constant angular velocity.
inline void RibbonWeights(const RibbonRecord& ribbon, float u, float weight[2]) {
  weight[0] = 1 - u;
  weight[1] = u;
  if (ribbon.angle == 0) return;
  for (int k = 0; k < 2; ++k) {
    weight[k] = std::sin(weight[k] * ribbon.angle) * ribbon.inverse_sine;
  }
}

/// Returns in `n` the normal at u, of unit length up to rounding.
inline void RibbonNormal(const RibbonRecord& ribbon, float u, float n[3]) {
  float weight[2];
  RibbonWeights(ribbon, u, weight);
  for (int a = 0; a < 3; ++a) {
    n[a] = weight[0] * ribbon.normal[0][a] + weight[1] * ribbon.normal[1][a];
  }
}

}  // namespace lanelight

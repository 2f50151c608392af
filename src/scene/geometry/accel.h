// Acceleration structures over the triangles, spheres and disks of a scene, as the
// kernels in kernels/intersect/ read them. Built once by BuildAccel.
//
// Acceleration structures by kind of shape:
//   triangles   8-wide BVH, leaves of up to 16 triangles over up to 16 shared vertices (8
//               over 8 where vectors have no more lanes), or of up to 8 with corners of
//               their own; where boxes are mostly empty (long thin triangles), triangles
//               are cut
//   instances   one BVH per object and one over the instances
//   spheres, disks   BVH likewise; at most kFewRound: no tree, a vector of rays against
//               each record in turn; planes always so, since they are infinite
//   curves      BVH of their pieces (src/scene/accel/curve_pieces.h)
// A vector of rays is traced on world triangles in one of three ways:
//   frustum   similar rays (kPacketSpread): camera rays are 1.1x to 1.2x faster than in a
//             stream, mirror bounces 1.5x slower
//   in turn   at most kFewTriangles: 21 Mray/s for bounces on 36 to 48 triangles, against
//             6 to 8 Mray/s ray by ray; both are equal near 150 triangles
//   stream    otherwise (kernels/intersect/stream-inl.h): the tops of the trees in
//   vectors
//             of rays, the rest as interleaved single rays
// The hit is the same in all (kernels/intersect/triangle-inl.h). Figures: `./run bench
// intersect`, one thread, AVX-512.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/base/core/aligned.h"
#include "src/base/core/vec.h"
#include "src/vocabulary/path/scene_kinds.h"

namespace lanelight {

/// Children of a node, and shapes of a leaf of spheres or disks.
inline constexpr int kBvhWidth = 8;
/// Child references: with this bit a leaf (the rest is the index of its block, or of an
/// instance in the top level), without it the index of a node. Among leaves of triangles
/// those with kSeparateBit, too, are SeparateLeaf. Indices of leaves count in units of
/// LeafUnit.
inline constexpr std::uint32_t kLeafBit = 0x80000000u, kSeparateBit = 0x40000000u;
inline constexpr std::uint32_t kRefIndex = kSeparateBit - 1;
/// Reference of a tree without shapes and of unused children.
inline constexpr std::uint32_t kEmptyRef = 0xffffffffu;
/// Largest number of entries of a traversal stack; BuildAccel checks it.
inline constexpr int kTraversalStack = 512;

inline constexpr std::uint32_t kFewTriangles = 128;
inline constexpr std::uint32_t kFewRound = 16;
/// Rays of a vector are traced together if their unit directions agree in sign and differ
/// by at most this per axis. Their origins may differ by at most kPacketExtent times the
/// reach of the scene.
inline constexpr float kPacketSpread = 0.05f;
inline constexpr float kPacketExtent = 0.01f;
/// `inst` of a hit on a triangle of the world, and of any sphere, disk or plane.
inline constexpr std::uint32_t kWorldInstance = 0xffffffffu;

/// Inner node: bounds of 8 children in SoA. Unused children have inverted infinite bounds
/// and are never hit.
struct alignas(64) WideNode {
  float bounds[3][2][kBvhWidth];  // [axis][0 = lower, 1 = upper][child]
  std::uint32_t child[kBvhWidth];
  // Shadow rays visit slots k ^ (octant & shadow_octants) ^ shadow_first, k = 0, 1, ...:
  // one of the two is 0. See SetBlockerOrder.
  std::uint32_t shadow_octants, shadow_first;
  std::uint32_t pad[kBvhWidth - 2];
};
static_assert(sizeof(WideNode) == 256);

/// Leaf of up to n triangles over up to n distinct vertices, triangles ascending by id.
/// A vertex is stored and transformed once however many triangles share it: scanned
/// meshes need about 30 bytes per triangle instead of the 40 of separate corners.
/// Unused lanes have three equal corners (never hit).
template <int n>
struct alignas(n * sizeof(float)) SharedLeaf {
  float vertex[3][n];         // [axis][vertex]
  std::uint8_t corner[3][n];  // which vertex: [corner][lane]
  std::uint32_t prim[n];
  std::uint8_t count, vertices;  // used lanes of corner and prim, and of vertex
  std::uint16_t used;            // the first `count` bits

  static constexpr int kLanes = n, kVertexLanes = n;
  /// Returns the row of `vertex` that holds corner k of a triangle.
  std::uint32_t VertexOf(int k, std::uint32_t lane) const { return corner[k][lane]; }
};
using TriangleLeaf = SharedLeaf<kLeafTriangles>;
using SmallLeaf = SharedLeaf<kLeafTriangles / 2>;
static_assert(sizeof(TriangleLeaf) == 320 && sizeof(SmallLeaf) == 160);

/// Leaf of up to 8 triangles with corners of their own, ascending by id: where a
/// TriangleLeaf would hold no more, because triangles share few vertices. Unused lanes
/// have corners that are NaN (never hit) and prim kEmptyRef.
struct alignas(64) SeparateLeaf {
  static constexpr int kLanes = 8, kVertexLanes = 3 * kLanes;
  float vertex[3][kVertexLanes];  // [axis][8 * corner + lane]
  std::uint32_t prim[kLanes];

  std::uint32_t VertexOf(int k, std::uint32_t lane) const {
    return static_cast<std::uint32_t>(k) * kLanes + lane;
  }
};
static_assert(sizeof(SeparateLeaf) == 320);

/// One leaf of triangles, or two small ones.
union TriangleBlock {
  TriangleLeaf shared;
  SmallLeaf small[2];
  SeparateLeaf separate;
};
static_assert(sizeof(TriangleBlock) == 320);

/// Leaf of up to 8 spheres, ascending by id. Unused lanes have radius -1 (never hit).
struct alignas(64) SphereBlock {
  float center[3][kBvhWidth];
  float radius[kBvhWidth];
  std::uint32_t prim[kBvhWidth];
};

/// Leaf of up to 8 disks, ascending by id. Unused lanes have radius -1 (never hit).
struct alignas(64) DiskBlock {
  float center[3][kBvhWidth];
  float normal[3][kBvhWidth];
  float radius[kBvhWidth], inner_radius[kBvhWidth];
  std::uint32_t prim[kBvhWidth];
};

/// Leaf of up to 8 pieces of curves, each a cubic Bezier curve of its own. Piece k of the
/// 2^d equal ones of curve `prim` has part = d << 24 | k. Unused lanes have points that
/// are NaN (never hit).
struct alignas(64) CurveBlock {
  float p[4][3][kBvhWidth];  // [point][axis][lane]
  float radius[2][kBvhWidth];
  std::uint32_t part[kBvhWidth];
  std::uint32_t prim[kBvhWidth];
};
static_assert(sizeof(CurveBlock) == 512);

/// One tree. The boxes of shapes are grown in proportion to their own coordinates to
/// cover rounding; the traversal adds the part of the ray (kernels/intersect/bvh-inl.h).
/// `reach` is the largest |coordinate| of the bounds.
struct Bvh {
  std::uint32_t root = kEmptyRef;
  float reach = 0;
  float margin = 0, slack = 0;  // growth of all boxes, and per unit of |origin|
  int depth = 0;                // nodes on the longest path
};

/// Triangles with their distinct vertices, for testing many rays against each.
struct FewTriangles {
  struct Triangle {
    std::uint32_t vertex[3];  // indices of vertices
    std::uint32_t prim;
  };
  AlignedVector<Vec3f> vertices;
  std::vector<Triangle> triangles;
  float reach = 0;
};

struct Accel {
  BuildQuality quality = BuildQuality::kHigh;
  SharedArray<WideNode> nodes;  // of all trees

  FewTriangles few;  // for incoherent rays, used instead of groups[0] if not empty
  int leaf_triangles = kLeafTriangles;  // of a shared leaf: as TriangleLeaf or SmallLeaf
  SharedArray<TriangleBlock> triangle_blocks;
  std::vector<Bvh> groups;  // as Geometry::groups
  Bvh top;                  // over instances; leaf references hold instance indices

  Bvh spheres, disks;  // empty if few: then the kernels loop over the records
  SharedArray<SphereBlock> sphere_blocks;
  SharedArray<DiskBlock> disk_blocks;
  Bvh curves;  // of pieces of curves, however few there are
  SharedArray<CurveBlock> curve_blocks;

  std::size_t Bytes() const;
};

/// Returns the bytes from one index of a leaf of triangles to the next.
inline constexpr std::size_t LeafUnit(int leaf_triangles) {
  return leaf_triangles == SmallLeaf::kLanes ? sizeof(SmallLeaf) : sizeof(TriangleBlock);
}

}  // namespace lanelight

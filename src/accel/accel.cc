#include "src/accel/accel.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <tuple>

#include "src/accel/builder.h"
#include "src/accel/grow.h"
#include "src/core/check.h"
#include "src/core/parallel.h"
#include "src/scene/compiled.h"

namespace lanelight {
namespace {

constexpr std::size_t kGrain = 4096;

bool IsFinite(Vec3f v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
bool IsFinite(const AccelBox& b) { return IsFinite(b.lo) && IsFinite(b.hi); }

Vec3f Load(const float* p) { return {p[0], p[1], p[2]}; }

AccelBox BoxOf(const TriangleRecord& triangle) {
  AccelBox box;
  bool finite = true;
  for (const auto& p : triangle.p) {
    finite = finite && IsFinite(Load(p));
    box.Extend(Load(p));
  }
  if (!finite) box.lo.x = NAN;
  return box;
}

// Boxes of round shapes are rounded outwards, since centre plus radius may round inwards.
AccelBox Around(const float* center, float radius) {
  AccelBox box;
  for (int a = 0; a < 3; ++a) {
    box.lo[a] = std::nextafter(center[a] - radius, -INFINITY);
    box.hi[a] = std::nextafter(center[a] + radius, INFINITY);
  }
  return box;
}
AccelBox BoxOf(const SphereRecord& s) { return Around(s.center, s.radius); }
AccelBox BoxOf(const DiskRecord& s) { return Around(s.center, s.radius); }

// Finite boxes of records [begin, end), grown.
template <typename Records>
std::vector<BuildItem> ItemsOf(const Records& records, std::uint32_t begin,
                               std::uint32_t end, std::uint32_t first_id) {
  std::vector<BuildItem> items(end - begin);
  ParallelForRange(items.size(), kGrain, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      const AccelBox box = BoxOf(records[begin + i]);
      items[i] = {Grown(box, Reach(box)), first_id + static_cast<std::uint32_t>(i)};
    }
  });
  std::erase_if(items, [](const BuildItem& item) { return !IsFinite(item.box); });
  return items;
}

void SetLane(SphereBlock& block, int lane, const SphereRecord& r) {
  for (int a = 0; a < 3; ++a) block.center[a][lane] = r.center[a];
  block.radius[lane] = r.radius;
}
void ClearLane(SphereBlock& block, int lane) {
  for (int a = 0; a < 3; ++a) block.center[a][lane] = block.center[a][0];
  block.radius[lane] = -1;
}
void SetLane(DiskBlock& block, int lane, const DiskRecord& r) {
  for (int a = 0; a < 3; ++a) {
    block.center[a][lane] = r.center[a];
    block.normal[a][lane] = r.normal[a];
  }
  block.radius[lane] = r.radius;
  block.inner_radius[lane] = r.inner_radius;
}
void ClearLane(DiskBlock& block, int lane) {
  for (int a = 0; a < 3; ++a) {
    block.center[a][lane] = block.center[a][0];
    block.normal[a][lane] = block.normal[a][0];
  }
  block.radius[lane] = -1;
  block.inner_radius[lane] = 0;
}

// A number that equal vertices have in common (0 and -0 count as different).
std::uint32_t HashOf(const float p[3]) {
  std::uint32_t bits[3];
  std::memcpy(bits, p, sizeof(bits));
  const std::uint32_t hash =
      bits[0] * 0x9e3779b1u + bits[1] * 0x85ebca6bu + bits[2] * 0xc2b2ae35u;
  return hash ^ hash >> 15;
}

// The distinct vertices of a leaf, in order of appearance; `corner` as in TriangleLeaf.
// False if there are more than kLeafVertices.
class LeafVertices {
 public:
  bool Add(const TriangleRecord& triangle, std::uint8_t corner[3]) {
    for (int k = 0; k < 3; ++k) {
      const int i = Find(triangle.p[k]);
      if (i == kLeafVertices) return false;
      corner[k] = static_cast<std::uint8_t>(i);
    }
    return true;
  }
  int count() const { return count_; }
  float at(int axis, int i) const { return p_[i][axis]; }

 private:
  static constexpr std::uint32_t kSlots = 64;

  int Find(const float p[3]) {
    std::uint32_t at = HashOf(p) * 0x2c1b3c6du / (0xffffffffu / kSlots + 1);
    for (; slot_[at] != 0; at = (at + 1) % kSlots) {
      const int i = slot_[at] - 1;
      if (std::memcmp(p_[i], p, sizeof(p_[i])) == 0) return i;
    }
    if (count_ == kLeafVertices) return kLeafVertices;
    std::memcpy(p_[count_], p, sizeof(p_[count_]));
    slot_[at] = static_cast<std::uint8_t>(count_ + 1);
    return count_++;
  }

  float p_[kLeafVertices][3];
  std::uint8_t slot_[kSlots] = {};  // by hash: index of a vertex + 1, 0 = none
  int count_ = 0;
};

bool FitsLeaf(const BuildItem* items, std::uint32_t count,
              const AlignedVector<TriangleRecord>& records) {
  LeafVertices vertices;
  std::uint8_t corner[3];
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!vertices.Add(records[items[i].id], corner)) return false;
  }
  return true;
}

// How many triangles a leaf holds if they share vertices as these do: its lanes or its
// vertices run out. Vertices are told apart by a hash.
std::uint32_t TypicalLeaf(const BuildItem* items, std::uint32_t count,
                          const AlignedVector<TriangleRecord>& records) {
  constexpr std::uint32_t kSlots = 512, kMost = kSlots / 6;
  std::uint32_t slots[kSlots] = {};
  std::uint32_t vertices = 0;
  count = std::min(count, kMost);
  for (std::uint32_t i = 0; i < count; ++i) {
    for (const auto& p : records[items[i].id].p) {
      const std::uint32_t hash = HashOf(p) | 1;  // 0 is a free slot
      std::uint32_t at = hash * 0x2c1b3c6du / (0xffffffffu / kSlots + 1);
      while (slots[at] != 0 && slots[at] != hash) at = (at + 1) % kSlots;
      vertices += slots[at] == 0;
      slots[at] = hash;
    }
  }
  return std::min<std::uint32_t>(kLeafTriangles, kLeafVertices * count / vertices);
}

void FillLeaf(TriangleLeaf& leaf, const BuildItem* items, std::uint32_t count,
              const AlignedVector<TriangleRecord>& records, std::uint32_t) {
  LeafVertices vertices;
  for (std::uint32_t lane = 0; lane < kLeafTriangles; ++lane) {
    std::uint8_t corner[3] = {0, 0, 0};
    if (lane < count) LL_CHECK(vertices.Add(records[items[lane].id], corner));
    for (int k = 0; k < 3; ++k) leaf.corner[k][lane] = corner[k];
    leaf.prim[lane] = lane < count ? items[lane].id : kEmptyRef;
  }
  for (int a = 0; a < 3; ++a) {
    for (int i = 0; i < kLeafVertices; ++i) {
      leaf.vertex[a][i] = vertices.at(a, i < vertices.count() ? i : 0);
    }
  }
  leaf.count = count;
  leaf.used = (1u << count) - 1;
  leaf.vertices = static_cast<std::uint32_t>(vertices.count());
}

template <typename Block, typename Records>
void FillLeaf(Block& block, const BuildItem* items, std::uint32_t count,
              const Records& records, std::uint32_t first_id) {
  for (std::uint32_t lane = 0; lane < kBvhWidth; ++lane) {
    block.prim[lane] = lane < count ? items[lane].id : kEmptyRef;
    if (lane < count) {
      SetLane(block, lane, records[items[lane].id - first_id]);
    } else {
      ClearLane(block, lane);
    }
  }
}

// Builds the tree over `items` and appends its leaves to `blocks`. Record i has id
// first_id + i.
template <typename Records, typename Block>
Bvh BuildShapes(std::vector<BuildItem> items, const Records& records,
                std::uint32_t first_id, const LeafLimit& limit,
                AlignedVector<WideNode>& nodes, AlignedVector<Block>& blocks) {
  const auto first_node = nodes.size();
  const auto first_block = static_cast<std::uint32_t>(blocks.size());
  BuiltTree tree = BuildTree(items, limit, nodes);
  tree.bvh.slack = kShapeSlack;
  blocks.resize(first_block + tree.leaves.size());
  ParallelForRange(tree.leaves.size(), kGrain / 8, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      const LeafRange leaf = tree.leaves[i];
      std::sort(items.begin() + leaf.begin, items.begin() + leaf.end,
                [](const BuildItem& a, const BuildItem& b) { return a.id < b.id; });
      FillLeaf(blocks[first_block + i], &items[leaf.begin], leaf.end - leaf.begin,
               records, first_id);
    }
  });
  // Leaf references count from this tree's first block so far.
  const auto shift = [&](std::uint32_t& ref) {
    if (ref != kEmptyRef && (ref & kLeafBit)) ref += first_block;
  };
  shift(tree.bvh.root);
  for (std::size_t n = first_node; n < nodes.size(); ++n) {
    for (std::uint32_t& child : nodes[n].child) shift(child);
  }
  return tree.bvh;
}

FewTriangles MakeFew(const Geometry& geometry, Geometry::TriangleGroup group) {
  FewTriangles few;
  std::map<std::tuple<float, float, float>, std::uint32_t> index;
  for (std::uint32_t id = group.begin; id < group.end; ++id) {
    const TriangleRecord& record = geometry.triangles[id];
    if (!IsFinite(BoxOf(record))) continue;
    FewTriangles::Triangle triangle{{}, id};
    for (int k = 0; k < 3; ++k) {
      const float* p = record.p[k];
      const auto next = static_cast<std::uint32_t>(few.vertices.size());
      const auto [it, inserted] = index.try_emplace({p[0], p[1], p[2]}, next);
      if (inserted) few.vertices.push_back(Load(p));
      triangle.vertex[k] = it->second;
      for (int a = 0; a < 3; ++a) few.reach = std::max(few.reach, std::abs(p[a]));
    }
    few.triangles.push_back(triangle);
  }
  return few;
}

// Largest sum of |entries| of a row of the linear part of a 3x4 map.
float RowNorm(const float* m) {
  float norm = 0;
  for (int r = 0; r < 3; ++r) {
    norm = std::max(norm,
                    std::abs(m[4 * r]) + std::abs(m[4 * r + 1]) + std::abs(m[4 * r + 2]));
  }
  return norm;
}

// Box of a transformed box, rounded outwards.
AccelBox Transformed(const float* m, const AccelBox& box) {
  AccelBox result;
  for (int r = 0; r < 3; ++r) {
    double lo = m[4 * r + 3], hi = lo;
    for (int c = 0; c < 3; ++c) {
      const double a = double{m[4 * r + c]} * box.lo[c];
      const double b = double{m[4 * r + c]} * box.hi[c];
      lo += std::min(a, b);
      hi += std::max(a, b);
    }
    result.lo[r] = std::nextafter(static_cast<float>(lo), -INFINITY);
    result.hi[r] = std::nextafter(static_cast<float>(hi), INFINITY);
  }
  return result;
}

// The tree over instances. A hit is found in object space, along a ray that was rounded
// when it was transformed; seen from the scene it may lie outside the instance's box by
//   |S| (4u (|M| (|o| + t) + |m|) + kShapeSlack (reach_g + |M| |o| + |m|)),
// S, M the linear parts of the maps to scene and object, m the translation of M, u =
// 2^-24. The slack of the top level covers that, with norms for the matrices.
Bvh BuildTop(const Geometry& geometry, const std::vector<AccelBox>& group_boxes,
             const std::vector<Bvh>& groups, AlignedVector<WideNode>& nodes) {
  std::vector<BuildItem> items;
  float linear = 1, constant = 0;
  for (std::uint32_t i = 0; i < geometry.instances.size(); ++i) {
    const std::uint32_t group = geometry.instance_group[i];
    if (groups[group].root == kEmptyRef) continue;
    const InstanceRecord& record = geometry.instances[i];
    BuildItem item{Transformed(record.scene_from_object, group_boxes[group]), i};
    if (!IsFinite(item.box)) continue;
    items.push_back(item);
    const float* m = record.object_from_scene;
    const float translation = std::max({std::abs(m[3]), std::abs(m[7]), std::abs(m[11])});
    const float to_scene = RowNorm(record.scene_from_object);
    linear = std::max(linear, to_scene * RowNorm(m));
    constant = std::max(constant, to_scene * (groups[group].reach + translation));
  }
  Bvh top =
      BuildTree(items, {.items = 0, .fits = {}, .typical = {}, .triangles = nullptr},
                nodes)
          .bvh;
  if (top.reach > 0) top.slack = 2 * kShapeSlack * (2 * linear + constant / top.reach);
  top.margin = top.slack * top.reach;
  return top;
}

void BuildTriangles(const Geometry& geometry, const AccelOptions& options, Accel& accel) {
  std::vector<AccelBox> boxes;
  const LeafLimit limit{kLeafTriangles,
                        [&](const BuildItem* items, std::uint32_t count) {
                          return FitsLeaf(items, count, geometry.triangles);
                        },
                        [&](const BuildItem* items, std::uint32_t count) {
                          return TypicalLeaf(items, count, geometry.triangles);
                        },
                        geometry.triangles.data()};
  for (const Geometry::TriangleGroup& group : geometry.groups) {
    const bool few = boxes.empty() && geometry.instances.empty() &&
                     group.end - group.begin <= options.few_triangles;
    boxes.emplace_back();
    if (few) accel.few = MakeFew(geometry, group);
    auto items = ItemsOf(geometry.triangles, group.begin, group.end, group.begin);
    for (const BuildItem& item : items) boxes.back().Extend(item.box);
    accel.groups.push_back(BuildShapes(std::move(items), geometry.triangles, 0, limit,
                                       accel.nodes, accel.triangle_leaves));
  }
  accel.top = BuildTop(geometry, boxes, accel.groups, accel.nodes);
}

template <typename T>
std::size_t BytesOf(const T& v) {
  return v.size() * sizeof(v[0]);
}

}  // namespace

Accel BuildAccel(const Geometry& geometry) {
  return BuildAccel(geometry, AccelOptions());
}

Accel BuildAccel(const Geometry& geometry, const AccelOptions& options) {
  LL_CHECK_LE(options.few_triangles, kFewTriangles);  // kernels size their scratch by it
  Accel accel;
  BuildTriangles(geometry, options, accel);
  const auto spheres = static_cast<std::uint32_t>(geometry.spheres.size());
  if (spheres > options.few_round) {
    const std::uint32_t first = geometry.ranges.spheres;
    accel.spheres =
        BuildShapes(ItemsOf(geometry.spheres, 0, spheres, first), geometry.spheres, first,
                    LeafLimit(), accel.nodes, accel.sphere_blocks);
  }
  const auto disks = static_cast<std::uint32_t>(geometry.disks.size());
  if (disks > options.few_round) {
    const std::uint32_t first = geometry.ranges.disks;
    accel.disks = BuildShapes(ItemsOf(geometry.disks, 0, disks, first), geometry.disks,
                              first, LeafLimit(), accel.nodes, accel.disk_blocks);
  }
  return accel;
}

std::size_t Accel::Bytes() const {
  return BytesOf(nodes) + BytesOf(few.vertices) + BytesOf(few.triangles) +
         BytesOf(triangle_leaves) + BytesOf(groups) + BytesOf(sphere_blocks) +
         BytesOf(disk_blocks);
}

}  // namespace lanelight

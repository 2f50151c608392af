#include "src/scene/compile/geometry.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "src/base/core/check.h"
#include "src/base/core/error.h"
#include "src/base/core/parallel.h"
#include "src/scene/compile/shape_records.h"
#include "src/scene/compile/world_frame.h"

namespace lanelight {
namespace {

struct Job {
  const PlacedShape* placed;
  const WorldFrame* frame;
  MeshRange* range;
};

std::size_t NumTriangles(const PlacedShape& placed) {
  return placed.mesh->indices.size() / 3;
}

std::uint32_t MaterialOf(const PlacedShape& placed,
                         const std::vector<std::int32_t>& material_index) {
  const std::int32_t m =
      material_index.at(static_cast<std::size_t>(placed.shape->material));
  LL_CHECK_GE(m, 0);
  return static_cast<std::uint32_t>(m);
}

// World meshes first, then object by object.
std::vector<Job> ListJobs(const Placement& placement, CompiledGeometry& out) {
  out.meshes.resize(placement.meshes.size());
  out.object_meshes.resize(placement.objects.size());
  std::vector<Job> jobs;
  for (std::size_t i = 0; i < placement.meshes.size(); ++i) {
    jobs.push_back({&placement.meshes[i], &placement.frame, &out.meshes[i]});
  }
  for (std::size_t o = 0; o < placement.objects.size(); ++o) {
    const PlacedObject& object = placement.objects[o];
    out.object_meshes[o].resize(object.meshes.size());
    for (std::size_t i = 0; i < object.meshes.size(); ++i) {
      jobs.push_back({&object.meshes[i], &object.frame, &out.object_meshes[o][i]});
    }
  }
  return jobs;
}

void AssignRanges(const std::vector<Job>& jobs) {
  // Primitive ids and gather offsets (12 words per triangle) are 32-bit.
  constexpr std::size_t kMaxTriangles = (std::size_t{1} << 31) / 12;
  std::size_t at = 0;
  for (const Job& job : jobs) {
    const std::size_t n = NumTriangles(*job.placed);
    if (n > kMaxTriangles - at) {
      throw InputError(job.placed->shape->where,
                       fmt::format("too many triangles; {} are supported in one scene",
                                   kMaxTriangles));
    }
    job.range->begin = static_cast<std::uint32_t>(at);
    job.range->end = static_cast<std::uint32_t>(at += n);
    if (job.placed->area_light != kNone) job.range->areas.resize(n);
  }
}

void CompileMeshes(const std::vector<Job>& jobs,
                   const std::vector<std::int32_t>& material_index, bool keep_uvs,
                   CompiledGeometry& out) {
  const std::size_t n = jobs.empty() ? 0 : jobs.back().range->end;
  const bool normals = std::ranges::any_of(
      jobs, [](const Job& job) { return !job.placed->mesh->normals.empty(); });
  Geometry& g = out.geometry;
  g.triangles.resize(n);
  if (normals) g.normals.resize(9 * n);
  if (keep_uvs) g.uvs.resize(6 * n);
  std::atomic<bool> has_normals{false};
  ParallelFor(jobs.size(), [&](std::size_t i) {
    const Job& job = jobs[i];
    const std::size_t begin = job.range->begin;
    MeshOutput mesh;
    mesh.triangles = g.triangles.data() + begin;
    mesh.normals = normals ? g.normals.data() + 9 * begin : nullptr;
    mesh.uvs = keep_uvs ? g.uvs.data() + 6 * begin : nullptr;
    mesh.areas = job.range->areas.empty() ? nullptr : job.range->areas.data();
    if (CompileMesh(*job.placed, *job.frame, MaterialOf(*job.placed, material_index),
                    mesh)) {
      has_normals.store(true, std::memory_order_relaxed);
    }
  });
  if (!has_normals.load()) g.normals = {};
  g.rotated_tangents = std::ranges::any_of(
      jobs, [](const Job& job) { return job.placed->mesh->rotates_tangents; });
}

void SetFaceAreas(const Job& job, const Geometry& g) {
  MeshRange& range = *job.range;
  const bool round = job.placed->shape->kind != ShapeKind::kMesh;
  const std::vector<bool>& continues = job.placed->mesh->continues;
  range.face_areas.resize(range.areas.size());
  for (std::size_t first = 0, end = 0; first < range.areas.size(); first = end) {
    double sum = 0;
    do {
      if (g.triangles[range.begin + end].material != kDegenerate) sum += range.areas[end];
      ++end;
    } while (end < range.areas.size() &&
             (round || (!continues.empty() && continues[end])));
    std::fill(range.face_areas.begin() + static_cast<std::ptrdiff_t>(first),
              range.face_areas.begin() + static_cast<std::ptrdiff_t>(end), sum);
  }
}

template <int kWords>
void Move(AlignedVector<float>& array, std::size_t from, std::size_t to) {
  if (array.empty()) return;
  std::copy_n(array.begin() + static_cast<std::ptrdiff_t>(from * kWords), kWords,
              array.begin() + static_cast<std::ptrdiff_t>(to * kWords));
}

// Closes the gaps that degenerate triangles leave, in order.
void RemoveDegenerate(const std::vector<Job>& jobs, Geometry& g) {
  std::size_t to = 0;
  for (const Job& job : jobs) {
    MeshRange& range = *job.range;
    const std::uint32_t begin = range.begin, end = range.end;
    range.begin = static_cast<std::uint32_t>(to);
    for (std::uint32_t from = begin; from < end; ++from) {
      if (g.triangles[from].material == kDegenerate) continue;
      if (from != to) {
        g.triangles[to] = g.triangles[from];
        Move<9>(g.normals, from, to);
        Move<6>(g.uvs, from, to);
      }
      if (!range.areas.empty()) {
        range.areas[to - range.begin] = range.areas[from - begin];
        range.face_areas[to - range.begin] = range.face_areas[from - begin];
      }
      ++to;
    }
    range.end = static_cast<std::uint32_t>(to);
    range.dropped = (end - begin) - (range.end - range.begin);
    range.areas.resize(range.areas.empty() ? 0 : range.end - range.begin);
    range.face_areas.resize(range.areas.size());
  }
  g.triangles.resize(to);
  if (!g.normals.empty()) g.normals.resize(9 * to);
  if (!g.uvs.empty()) g.uvs.resize(6 * to);
}

void MakeGroups(const CompiledGeometry& out, Geometry& g) {
  std::uint32_t begin = 0;
  const auto close = [&](const std::vector<MeshRange>& meshes) {
    const std::uint32_t end = meshes.empty() ? begin : meshes.back().end;
    g.groups.push_back({begin, end});
    begin = end;
  };
  close(out.meshes);
  for (const auto& meshes : out.object_meshes) close(meshes);
}

void MakeInstances(const Placement& placement, Geometry& g) {
  for (const PlacedInstance& instance : placement.instances) {
    const WorldFrame& object = placement.objects[instance.object].frame;
    const Transform scene_from_object =
        placement.frame.After(instance.world_from_object * object.Inverse());
    if (instance.end) {
      const Motion motion(instance.world_from_object, *instance.end);
      g.motions.push_back(RecordOf(InFrames(motion, placement.frame, object)));
    }
    InstanceRecord record;
    Store(scene_from_object, record.scene_from_object);
    Store(scene_from_object.Inverse(), record.object_from_scene);
    g.instances.push_back(record);
    g.instance_group.push_back(static_cast<std::uint32_t>(instance.object) + 1);
  }
}

void MakeQuadrics(const Placement& placement,
                  const std::vector<std::int32_t>& material_index, bool keep_uv,
                  Geometry& g) {
  const WorldFrame& frame = placement.frame;
  for (const PlacedShape& p : placement.spheres) {
    g.spheres.push_back(CompileSphere(p, frame, MaterialOf(p, material_index)));
  }
  for (const PlacedShape& p : placement.disks) {
    g.disks.push_back(CompileDisk(p, frame, MaterialOf(p, material_index)));
  }
  for (const PlacedShape& p : placement.planes) {
    g.planes.push_back(CompilePlane(p, frame, MaterialOf(p, material_index), keep_uv));
  }
  for (const PlacedShape& p : placement.large_spheres) {
    g.large_spheres.push_back(
        CompileLargeSphere(p, frame, placement.eye, MaterialOf(p, material_index)));
  }
  for (const PlacedShape& p : placement.curves) {
    AddCurves(p, frame, MaterialOf(p, material_index), g);
  }
  const auto count = [](const auto& v) { return static_cast<std::uint32_t>(v.size()); };
  g.ranges.spheres = count(g.triangles);
  g.ranges.disks = g.ranges.spheres + count(g.spheres);
  g.ranges.planes = g.ranges.disks + count(g.disks);
  g.ranges.large_spheres = g.ranges.planes + count(g.planes);
  g.ranges.curves = g.ranges.large_spheres + count(g.large_spheres);
  g.ranges.end = g.ranges.curves + count(g.curves);
}

// Makes bounds one ulp wider than in double precision, so that rounded positions lie
// inside.
void MakeBounds(const Placement& placement, Geometry& g) {
  const Vec3d lo = placement.frame.Point(placement.bounds.min);
  const Vec3d hi = placement.frame.Point(placement.bounds.max);
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    g.bounds_min[axis] = std::nextafter(static_cast<float>(lo[axis]), -kInfinity);
    g.bounds_max[axis] = std::nextafter(static_cast<float>(hi[axis]), kInfinity);
  }
}

}  // namespace

CompiledGeometry CompileGeometry(const Placement& placement,
                                 const std::vector<std::int32_t>& material_index,
                                 bool keep_uvs) {
  CompiledGeometry out;
  const std::vector<Job> jobs = ListJobs(placement, out);
  AssignRanges(jobs);
  CompileMeshes(jobs, material_index, keep_uvs, out);
  for (const Job& job : jobs) SetFaceAreas(job, out.geometry);
  RemoveDegenerate(jobs, out.geometry);
  MakeGroups(out, out.geometry);
  MakeInstances(placement, out.geometry);
  MakeQuadrics(placement, material_index, keep_uvs, out.geometry);
  MakeBounds(placement, out.geometry);
  return out;
}

}  // namespace lanelight

#include "src/scene/compile/shape_records.h"

#include <atomic>
#include <array>
#include <cmath>
#include <limits>

#include "src/base/core/check.h"
#include "src/base/core/parallel.h"

namespace lanelight {
namespace {

// Vertex normals this close to the face normal are face normals: files hold six digits,
// of which the sides of thin slabs lose two or three.
constexpr double kSameNormal = 5e-4;
constexpr std::size_t kGrain = 4096;

struct Corner {
  Vec3d p, n;  // n: unit, or zero
  std::array<double, 2> uv;
};
using Corners = std::array<Corner, 3>;

// Area that the kernels can work with: nonzero after rounding, and its square a normal
// float, since they normalise the cross product.
bool HasArea(const TriangleRecord& r) {
  const auto p = [&](int k) { return Vec3d{r.p[k][0], r.p[k][1], r.p[k][2]}; };
  const Vec3d cross = Cross(p(1) - p(0), p(2) - p(0));
  return IsFinite(cross) && Dot(cross, cross) >= std::numeric_limits<float>::min();
}

class MeshCompiler {
 public:
  MeshCompiler(const PlacedShape& placed, const WorldFrame& frame, std::uint32_t material,
               const MeshOutput& out)
      : mesh_(*placed.mesh),
        t_(frame.After(placed.transform)),
        out_(out),
        reverse_(placed.shape->reverse_orientation),
        turned_(reverse_ != t_.SwapsHandedness()) {
    model_.material = material;
    model_.light = -1;
    // Round shapes that have become triangles have dp/dv of their own, as in pbrt.
    const bool shape_normals =
        placed.shape->kind == ShapeKind::kMesh && !mesh_.normals.empty();
    const std::uint32_t normals =
        mesh_.rotates_tangents ? kRotatedTangents : kMeshNormals;
    model_.flags =
        (IsAlphaTested(placed) ? kAlphaTested : 0) | (shape_normals ? normals : 0);
  }

  /// Returns true if the triangle has vertex normals of its own.
  bool Compile(std::size_t i) const {
    Corners c = {Fetch(i, 0), Fetch(i, 1), Fetch(i, 2)};
    Vec3d cross = Cross(c[1].p - c[0].p, c[2].p - c[0].p);
    const double side = Dot(c[0].n + c[1].n + c[2].n, cross);
    if (side != 0 ? side < 0 : turned_) {
      std::swap(c[1], c[2]);
      cross = -cross;
    }
    TriangleRecord record = model_;
    for (std::size_t k = 0; k < 3; ++k) {
      for (int axis = 0; axis < 3; ++axis) {
        record.p[k][axis] = static_cast<float>(c[k].p[axis]);
      }
    }
    const bool keep = HasArea(record);
    if (!keep) record.material = kDegenerate;
    out_.triangles[i] = record;
    if (out_.areas) out_.areas[i] = Length(cross) / 2;
    if (out_.uvs) {
      for (std::size_t k = 0; k < 3; ++k) {
        out_.uvs[6 * i + 2 * k] = static_cast<float>(c[k].uv[0]);
        out_.uvs[6 * i + 2 * k + 1] = static_cast<float>(c[k].uv[1]);
      }
    }
    return StoreNormals(i, c, Normalize(cross)) && keep;
  }

 private:
  Corner Fetch(std::size_t triangle, int k) const {
    // The texture coordinates that pbrt gives to meshes without any.
    static constexpr std::array<double, 2> kUv[3] = {{0, 0}, {1, 0}, {1, 1}};
    const std::uint32_t i = mesh_.indices[3 * triangle + static_cast<std::size_t>(k)];
    Corner corner{t_.Point(mesh_.positions[i]), {}, kUv[k]};
    if (!mesh_.uvs.empty()) corner.uv = mesh_.uvs[i];
    if (!mesh_.normals.empty()) {
      const Vec3d n = Normalize(t_.Normal(Normalize(mesh_.normals[i])));
      if (IsFinite(n)) corner.n = reverse_ ? -n : n;
    }
    return corner;
  }

  bool StoreNormals(std::size_t i, const Corners& c, Vec3d face) const {
    if (!out_.normals) return false;
    bool differs = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const bool has_normal = c[k].n != Vec3d{};
      const Vec3d n = has_normal ? c[k].n : face;
      differs |= Length(n - face) > kSameNormal;
      for (int axis = 0; axis < 3; ++axis) {
        out_.normals[9 * i + 3 * k + static_cast<std::size_t>(axis)] =
            static_cast<float>(n[axis]);
      }
    }
    return differs;
  }

  const TriangleMesh& mesh_;
  const Transform t_;
  const MeshOutput out_;
  const bool reverse_, turned_;
  TriangleRecord model_{};
};

}  // namespace

bool CompileMesh(const PlacedShape& placed, const WorldFrame& frame,
                 std::uint32_t material, const MeshOutput& out) {
  const TriangleMesh& mesh = *placed.mesh;
  LL_CHECK(mesh.normals.empty() || mesh.normals.size() == mesh.positions.size());
  LL_CHECK(mesh.uvs.empty() || mesh.uvs.size() == mesh.positions.size());
  LL_CHECK_EQ(mesh.indices.size() % 3, 0u);
  const MeshCompiler compiler(placed, frame, material, out);
  std::atomic<bool> has_normals{false};
  ParallelForRange(mesh.indices.size() / 3, kGrain,
                   [&](std::size_t begin, std::size_t end) {
                     bool any = false;
                     for (std::size_t i = begin; i < end; ++i) any |= compiler.Compile(i);
                     if (any) has_normals.store(true, std::memory_order_relaxed);
                   });
  return has_normals.load();
}

}  // namespace lanelight

#include "src/scene/parse/displace.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "src/base/core/error.h"

namespace lanelight {
namespace {

// Unit means of the normals of the faces around each vertex; zero without faces.
std::vector<Vec3d> VertexNormals(const TriangleMesh& mesh) {
  std::vector<Vec3d> normals(mesh.positions.size());
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const std::uint32_t* v = &mesh.indices[i];
    const Vec3d p = mesh.positions[v[0]];
    const Vec3d face =
        Normalize(Cross(mesh.positions[v[1]] - p, mesh.positions[v[2]] - p));
    for (int k = 0; k < 3; ++k) normals[v[k]] += face;
  }
  for (Vec3d& n : normals) n = Normalize(n);
  return normals;
}

class Refiner {
 public:
  Refiner(TriangleMesh& mesh, const Transform& world_from_object, double edge_length)
      : mesh_(mesh), world_from_object_(world_from_object), edge_length_(edge_length) {}

  void Run() {
    Check(MinFaces());
    const std::vector<std::uint32_t> faces = std::move(mesh_.indices);
    mesh_.indices.clear();
    for (std::size_t i = 0; i < faces.size(); i += 3) {
      open_.push_back({faces[i], faces[i + 1], faces[i + 2]});
      while (!open_.empty()) Step();
    }
  }

 private:
  using Face = std::array<std::uint32_t, 3>;

  double Side(std::uint32_t a, std::uint32_t b) const {
    return Length(world_from_object_.Vector(mesh_.positions[b] - mesh_.positions[a]));
  }

  void Step() {
    const Face f = open_.back();
    open_.pop_back();
    const std::array<double, 3> sides = {Side(f[0], f[1]), Side(f[1], f[2]),
                                         Side(f[2], f[0])};
    const auto longest = std::max_element(sides.begin(), sides.end());
    if (!(*longest >= edge_length_)) {
      mesh_.indices.insert(mesh_.indices.end(), f.begin(), f.end());
      return;
    }
    Check(static_cast<double>(open_.size() + mesh_.indices.size() / 3));
    const auto k = static_cast<std::size_t>(longest - sides.begin());
    const std::uint32_t a = f[k], b = f[(k + 1) % 3], c = f[(k + 2) % 3];
    const std::uint32_t middle = Middle(a, b);
    open_.push_back({middle, b, c});
    open_.push_back({a, middle, c});
  }

  static void Check(double faces) {
    if (faces <= kMaxDisplacedTriangles) return;
    throw InputError(
        "displacement makes more than {} triangles of this mesh; a larger \"edgelength\" "
        "makes fewer",
        kMaxDisplacedTriangles);
  }

  // Of triangles with sides up to the length, the equilateral one is largest.
  double MinFaces() const {
    double area = 0;
    for (std::size_t i = 0; i < mesh_.indices.size(); i += 3) {
      const auto p = [&](std::size_t k) {
        return world_from_object_.Vector(mesh_.positions[mesh_.indices[i + k]]);
      };
      area += Length(Cross(p(1) - p(0), p(2) - p(0))) / 2;
    }
    return area / (std::sqrt(3.0) / 4 * edge_length_ * edge_length_);
  }

  // Both faces of a side share its middle.
  std::uint32_t Middle(std::uint32_t a, std::uint32_t b) {
    const std::uint64_t key = (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
    const auto next = static_cast<std::uint32_t>(mesh_.positions.size());
    const auto [it, is_new] = middles_.emplace(key, next);
    if (!is_new) return it->second;
    mesh_.positions.push_back((mesh_.positions[a] + mesh_.positions[b]) * 0.5);
    mesh_.normals.push_back(Normalize(mesh_.normals[a] + mesh_.normals[b]));
    const auto &uv_a = mesh_.uvs[a], &uv_b = mesh_.uvs[b];
    mesh_.uvs.push_back({(uv_a[0] + uv_b[0]) / 2, (uv_a[1] + uv_b[1]) / 2});
    return next;
  }

  TriangleMesh& mesh_;
  const Transform& world_from_object_;
  double edge_length_;
  std::vector<Face> open_;
  std::unordered_map<std::uint64_t, std::uint32_t> middles_;
};

}  // namespace

TriangleMesh Displace(const TriangleMesh& mesh, const Transform& world_from_object,
                      double edge_length, const HeightTexture& height) {
  TriangleMesh out = mesh;
  out.continues.clear();  // of triangles alone, as pbrt's
  if (out.normals.empty()) out.normals = VertexNormals(out);
  Refiner(out, world_from_object, edge_length).Run();
  for (std::size_t i = 0; i < out.positions.size(); ++i) {
    out.positions[i] += out.normals[i] * height.At(out.uvs[i][0], out.uvs[i][1]);
  }
  out.normals = VertexNormals(out);
  return out;
}

}  // namespace lanelight

#include "src/scene/parse/loop_subdivision.h"

#include <cmath>
#include <numbers>

#include "src/scene/parse/mesh_edges.h"

namespace lanelight {
namespace {

// Weight of each neighbour of an interior vertex.
double NeighbourWeight(std::size_t valence) {
  return valence == 3 ? 3.0 / 16 : 3 / (8.0 * static_cast<double>(valence));
}

// The same for the limit after infinitely many levels.
double LimitWeight(std::size_t valence) {
  return 1 / (static_cast<double>(valence) + 3 / (8 * NeighbourWeight(valence)));
}

struct Neighbours {
  Vec3d sum, boundary_sum;  // over all; over the two along the boundary
  std::size_t count = 0;
  bool is_boundary = false;
};

std::vector<Neighbours> FindNeighbours(const TriangleMesh& mesh, const MeshEdges& edges) {
  std::vector<Neighbours> all(mesh.positions.size());
  for (const MeshEdge& edge : edges.edges) {
    for (int end = 0; end < 2; ++end) {
      Neighbours& at = all[edge.ends[end]];
      const Vec3d other = mesh.positions[edge.ends[1 - end]];
      at.sum += other;
      ++at.count;
      if (edge.faces > 1) continue;
      at.boundary_sum += other;
      at.is_boundary = true;
    }
  }
  return all;
}

Vec3d Weighted(Vec3d p, double weight, Vec3d sum, double count) {
  return (1 - count * weight) * p + weight * sum;
}

Vec3d Moved(Vec3d p, const Neighbours& around) {
  if (around.is_boundary) return Weighted(p, 1.0 / 8, around.boundary_sum, 2);
  if (around.count == 0) return p;  // of no face
  return Weighted(p, NeighbourWeight(around.count), around.sum,
                  static_cast<double>(around.count));
}

// pbrt-v4 takes 1/5 along boundaries, where the limit of a cubic B-spline has 1/6.
Vec3d Limit(Vec3d p, const Neighbours& around) {
  if (around.is_boundary) return Weighted(p, 1.0 / 5, around.boundary_sum, 2);
  if (around.count == 0) return p;
  return Weighted(p, LimitWeight(around.count), around.sum,
                  static_cast<double>(around.count));
}

Vec3d MiddleOf(const TriangleMesh& mesh, const MeshEdge& edge) {
  const auto sum = [&](const std::uint32_t pair[2]) {
    return mesh.positions[pair[0]] + mesh.positions[pair[1]];
  };
  if (edge.faces == 1) return sum(edge.ends) * 0.5;
  return sum(edge.ends) * (3.0 / 8) + sum(edge.opposite) * (1.0 / 8);
}

TriangleMesh Subdivide(const TriangleMesh& mesh) {
  const MeshEdges edges = FindEdges(mesh);
  const std::vector<Neighbours> around = FindNeighbours(mesh, edges);
  TriangleMesh out;
  out.positions.reserve(mesh.positions.size() + edges.edges.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    out.positions.push_back(Moved(mesh.positions[i], around[i]));
  }
  for (const MeshEdge& edge : edges.edges) out.positions.push_back(MiddleOf(mesh, edge));
  const auto old = static_cast<std::uint32_t>(mesh.positions.size());
  out.indices.reserve(4 * mesh.indices.size());
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const std::uint32_t *v = &mesh.indices[i], *e = &edges.of_side[i];
    const std::uint32_t e0 = old + e[0], e1 = old + e[1], e2 = old + e[2];
    // Corners stand in pbrt's order, which default surface coordinates depend on.
    out.indices.insert(out.indices.end(),
                       {v[0], e0, e2, e0, v[1], e1, e2, e1, v[2], e0, e1, e2});
  }
  return out;
}

// Tangent across the boundary, into the surface (Hoppe et al. 1994). `ring` runs from one
// end of the boundary to the other.
Vec3d AcrossBoundary(Vec3d p, const std::vector<Vec3d>& ring) {
  const std::size_t n = ring.size();
  if (n == 2) return ring[0] + ring[1] - 2 * p;
  if (n == 3) return ring[1] - p;
  if (n == 4) return 2 * (ring[1] + ring[2]) - ring[0] - ring[3] - 2 * p;
  const double angle = std::numbers::pi / static_cast<double>(n - 1);
  Vec3d sum = std::sin(angle) * (ring[0] + ring[n - 1]);
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const double weight =
        (2 * std::cos(angle) - 2) * std::sin(static_cast<double>(k) * angle);
    sum += weight * ring[k];
  }
  return -sum;
}

Vec3d NormalAt(Vec3d p, const std::vector<Vec3d>& ring, bool is_boundary) {
  if (ring.empty()) return {};
  if (is_boundary) {
    return Normalize(Cross(ring.back() - ring.front(), AcrossBoundary(p, ring)));
  }
  Vec3d s, t;
  const double angle = 2 * std::numbers::pi / static_cast<double>(ring.size());
  for (std::size_t k = 0; k < ring.size(); ++k) {
    s += std::cos(static_cast<double>(k) * angle) * ring[k];
    t += std::sin(static_cast<double>(k) * angle) * ring[k];
  }
  return Normalize(Cross(t, s));
}

}  // namespace

std::string SubdivisionProblem(const TriangleMesh& control) {
  const std::string problem = FindEdges(control).problem;
  return problem.empty() ? VertexRings(control).problem() : problem;
}

TriangleMesh LoopSubdivide(const TriangleMesh& control, int levels) {
  TriangleMesh mesh;
  mesh.positions = control.positions;
  mesh.indices = control.indices;
  for (int level = 0; level < levels; ++level) mesh = Subdivide(mesh);
  const std::vector<Neighbours> around = FindNeighbours(mesh, FindEdges(mesh));
  const VertexRings rings(mesh);
  std::vector<Vec3d> limits, ring;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3d p = mesh.positions[i];
    ring.clear();
    for (std::uint32_t k : rings.Around(static_cast<std::uint32_t>(i))) {
      ring.push_back(mesh.positions[k]);
    }
    limits.push_back(Limit(p, around[i]));
    mesh.normals.push_back(NormalAt(p, ring, around[i].is_boundary));
  }
  mesh.positions = std::move(limits);
  return mesh;
}

}  // namespace lanelight

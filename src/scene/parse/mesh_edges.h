// Edges of a mesh of triangles, and the ordered neighbours of its vertices.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "src/scene/description/description.h"

namespace lanelight {

struct MeshEdge {
  std::uint32_t ends[2];      // in the direction of the first face
  std::uint32_t opposite[2];  // third corners of its faces
  int faces = 1;              // 1 on the boundary, else 2
};

struct MeshEdges {
  std::vector<MeshEdge> edges;
  /// For corner k of a face, at 3 * face + k: the edge to the next corner.
  std::vector<std::uint32_t> of_side;
  /// Why these edges are not those of a surface, in words; "" if they are.
  std::string problem;
};

MeshEdges FindEdges(const TriangleMesh& mesh);

/// The neighbours of each vertex of a mesh, in order around it.
class VertexRings {
 public:
  /// Keeps a reference to the mesh, whose edges have no problem (FindEdges).
  explicit VertexRings(const TriangleMesh& mesh);

  /// In the direction in which the faces run; on a boundary from one end to the other.
  /// Empty for a vertex of no face.
  std::vector<std::uint32_t> Around(std::uint32_t vertex) const;

  /// Which vertex joins more than one fan of faces, in words; "" if none does.
  std::string problem() const;

 private:
  using Link = std::pair<std::uint32_t, std::uint32_t>;  // next and previous corner

  // The faces of vertex i give links_[first_[i]] to links_[first_[i + 1] - 1].
  std::vector<std::size_t> first_;
  std::vector<Link> links_;
};

}  // namespace lanelight

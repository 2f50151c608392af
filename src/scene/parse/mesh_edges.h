// The edges of a mesh of triangles.
#pragma once

#include <string>
#include <vector>

#include "src/scene/description/description.h"

namespace lanelight {

struct MeshEdge {
  std::uint32_t ends[2];      // in the direction of the first face
  std::uint32_t opposite[2];  // third corners of its faces
  int faces = 1;              // 1: on the boundary; 2
};

struct MeshEdges {
  std::vector<MeshEdge> edges;
  /// For corner k of a face, at 3 * face + k: the edge to the next corner.
  std::vector<std::uint32_t> of_side;
  /// Why these edges are not those of a surface, in words; "" if they are.
  std::string problem;
};

MeshEdges FindEdges(const TriangleMesh& mesh);

}  // namespace lanelight

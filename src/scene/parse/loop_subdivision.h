// Smooth surfaces from meshes of triangles (Loop 1987, "Smooth subdivision surfaces based
// on triangles", with Warren's weights; boundaries after Hoppe et al. 1994).
#pragma once

#include <string>

#include "src/scene/description/description.h"

namespace lanelight {

/// What keeps the mesh from being subdivided, in words, or "": every edge must be of one
/// or two faces that run the same way round, every vertex of one fan of faces, every face
/// of three vertices.
std::string SubdivisionProblem(const TriangleMesh& control);

/// The mesh subdivided `levels` times, each of which makes four triangles of one.
/// Vertices are then where infinitely many levels would bring them, with the normals of
/// the surface there. As in pbrt-v4, normals point to the side from which the faces run
/// clockwise. `control` has no problem; only its positions and indices count.
TriangleMesh LoopSubdivide(const TriangleMesh& control, int levels);

}  // namespace lanelight

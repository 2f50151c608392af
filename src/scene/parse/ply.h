// PLY meshes: ASCII and binary in both byte orders.
//
// Read: element "vertex" with x y z, optionally nx ny nz and one of (u v), (s t),
// (texture_u texture_v), (texture_s texture_t); element "face" with the list
// "vertex_indices" or "vertex_index" of 3 or 4 corners; other faces are left out, as in
// pbrt. Properties may have any of the eight types; other properties and elements are
// skipped.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "src/scene/description/description.h"

namespace lanelight {

struct PlyMesh {
  TriangleMesh mesh;  // quads are split in two; without uvs in the file, meshes that have
                      // quads get pbrt's default: the corners of the unit square
  std::size_t bent_quads = 0;  // quads that are not flat, where the split shows
  // Counts of repairs: vertices, vertices, triangles, faces.
  std::size_t bad_normals = 0, bad_uvs = 0, lost_triangles = 0, other_faces = 0;
};

/// Parses the content of a PLY file called `name`. Throws InputError with name and line
/// (header, ASCII) or byte offset (binary): malformed or truncated data, counts beyond
/// what the file can hold, indices out of range, no face that can be used.
PlyMesh ParsePly(std::string_view bytes, const std::string& name);

/// Normals that are not finite become zero: there the faces' own normals count
/// (src/scene/compile/shape_records.h). Surface coordinates that are not finite become
/// (0, 0). Triangles with a corner that is nowhere are left out. Counts all that in
/// `ply`.
void RepairPly(PlyMesh* ply);

/// One sentence for each kind of thing that was repaired, left out or approximated in the
/// file `path`.
std::vector<std::string> PlyNotes(const PlyMesh& ply, const std::string& path);

}  // namespace lanelight

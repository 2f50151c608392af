// What a few bad numbers among millions cost a mesh, instead of the scene.
#pragma once

#include <string>
#include <vector>

#include "src/scene/parse/ply.h"

namespace lanelight {

/// Normals that are not finite become zero: there the faces' own normals count
/// (src/scene/compile/shape_records.h). Surface coordinates that are not finite become
/// (0, 0). Triangles with a corner that is nowhere are left out. Counts all that in
/// `ply`.
void RepairPly(PlyMesh* ply);

/// One sentence for each kind of thing that was repaired, left out or approximated in the
/// file `path`.
std::vector<std::string> PlyNotes(const PlyMesh& ply, const std::string& path);

}  // namespace lanelight

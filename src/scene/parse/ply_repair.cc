#include "src/scene/parse/ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/base/core/suggest.h"

namespace lanelight {
namespace {

bool IsFinite(Vec3d v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool IsFinite(const std::array<double, 2>& uv) {
  return std::isfinite(uv[0]) && std::isfinite(uv[1]);
}

// Sets values that are not finite to zero; returns their number.
template <typename T>
std::size_t ZeroNonFinite(std::vector<T>* values) {
  std::size_t bad = 0;
  for (T& value : *values) {
    if (IsFinite(value)) continue;
    value = T{};
    ++bad;
  }
  return bad;
}

// Removes triangles with corners that are not finite; returns their number.
std::size_t DropNonFiniteTriangles(TriangleMesh* mesh) {
  std::vector<std::uint32_t>& indices = mesh->indices;
  std::vector<bool>& continues = mesh->continues;
  const std::size_t before = indices.size();
  std::size_t to = 0;
  bool alone = true;  // the face of the triangle has no other so far
  for (std::size_t i = 0; i + 2 < before; i += 3) {
    const bool is_somewhere = std::all_of(
        &indices[i], &indices[i] + 3,
        [&](std::uint32_t vertex) { return IsFinite(mesh->positions[vertex]); });
    if (!continues.empty() && !continues[i / 3]) alone = true;
    if (!is_somewhere) continue;
    std::copy_n(&indices[i], 3, &indices[to]);
    if (!continues.empty()) continues[to / 3] = !alone;
    alone = false;
    to += 3;
  }
  indices.resize(to);
  if (!continues.empty()) continues.resize(to / 3);
  return (before - to) / 3;
}

}  // namespace

void RepairPly(PlyMesh* ply) {
  ply->bad_normals = ZeroNonFinite(&ply->mesh.normals);
  ply->bad_uvs = ZeroNonFinite(&ply->mesh.uvs);
  ply->lost_triangles = DropNonFiniteTriangles(&ply->mesh);
}

std::vector<std::string> PlyNotes(const PlyMesh& ply, const std::string& path) {
  std::vector<std::string> notes;
  const auto add = [&](std::size_t count, const char* text) {
    if (count == 0) return;
    notes.push_back(fmt::format(fmt::runtime(text), count, Quoted(path)));
  };
  add(ply.bent_quads, "{} quads of {} are not flat; each becomes two triangles");
  add(ply.bad_normals,
      "{} vertices of {} have normals that are not finite; the normals of their faces "
      "are used there");
  add(ply.bad_uvs,
      "{} vertices of {} have texture coordinates that are not finite; they count as (0, "
      "0)");
  add(ply.lost_triangles,
      "left out {} triangles of {} with corners whose coordinates are not finite");
  add(ply.other_faces,
      "left out {} faces of {} that have neither 3 nor 4 corners, as pbrt does");
  return notes;
}

}  // namespace lanelight

// Meshes whose vertices stand in the scene file.
#include <limits>

#include "src/parse/interpret.h"
#include "src/parse/quad.h"

namespace lanelight {
namespace {

std::vector<Vec3d> Triples(const Param* param) {
  std::vector<Vec3d> out;
  if (param == nullptr) return out;
  const std::vector<double>& n = param->numbers;
  out.reserve(n.size() / 3);
  for (std::size_t i = 0; i < n.size(); i += 3) out.push_back({n[i], n[i + 1], n[i + 2]});
  return out;
}

void CheckCount(const ParamSet& params, const Param* param, std::size_t found,
                std::size_t vertices) {
  if (param == nullptr || found == vertices) return;
  params.Fail(*param, fmt::format("{} values for {} vertices", found, vertices));
}

// P, N, uv and indices with `corners` indices per face.
TriangleMesh ReadVertices(ParamSet& params, std::size_t corners) {
  TriangleMesh mesh;
  const Param* p = params.Find("P", {ParamType::kPoint3});
  if (p == nullptr)
    throw InputError(params.where(), params.object() + " has no \"point3 P\"");
  mesh.positions = Triples(p);
  const Param* n = params.Find("N", {ParamType::kNormal});
  mesh.normals = Triples(n);
  CheckCount(params, n, mesh.normals.size(), mesh.positions.size());
  if (const Param* uv = params.Find("uv", {ParamType::kPoint2})) {
    for (std::size_t i = 0; i < uv->numbers.size(); i += 2) {
      mesh.uvs.push_back({uv->numbers[i], uv->numbers[i + 1]});
    }
    CheckCount(params, uv, mesh.uvs.size(), mesh.positions.size());
  }
  const Param* indices = params.Find("indices", {ParamType::kInteger});
  if (indices == nullptr) {
    if (mesh.positions.size() != corners) {
      throw InputError(
          params.where(),
          fmt::format("{} has {} vertices and no \"integer indices\"; without "
                      "them it takes {} vertices",
                      params.object(), mesh.positions.size(), corners));
    }
    for (std::uint32_t i = 0; i < corners; ++i) mesh.indices.push_back(i);
    return mesh;
  }
  if (indices->numbers.size() % corners != 0) {
    params.Fail(*indices, fmt::format("{} indices; they come in groups of {}",
                                      indices->numbers.size(), corners));
  }
  mesh.indices.reserve(indices->numbers.size());
  for (std::size_t i = 0; i < indices->numbers.size(); ++i) {
    const double index = indices->numbers[i];
    if (index < 0 || index >= static_cast<double>(mesh.positions.size())) {
      params.Fail(*indices,
                  fmt::format("index {} (number {}) is not one of the {} vertices", index,
                              i + 1, mesh.positions.size()));
    }
    mesh.indices.push_back(static_cast<std::uint32_t>(index));
  }
  return mesh;
}

// Two triangles for the patch with corners p00, p10, p01, p11; vertices are not shared,
// so that a patch without uvs can have pbrt's default: the corners of the unit square.
void AddPatch(const ParamSet& params, const TriangleMesh& in, std::size_t first,
              TriangleMesh* out) {
  constexpr int kRing[4] = {0, 1, 3, 2};
  constexpr std::array<double, 2> kDefaultUv[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const auto base = static_cast<std::uint32_t>(out->positions.size());
  std::array<Vec3d, 4> ring;
  for (int i = 0; i < 4; ++i) {
    const std::uint32_t vertex = in.indices[first + kRing[i]];
    ring[i] = in.positions[vertex];
    out->positions.push_back(ring[i]);
    if (!in.normals.empty()) out->normals.push_back(in.normals[vertex]);
    out->uvs.push_back(in.uvs.empty() ? kDefaultUv[i] : in.uvs[vertex]);
  }
  const QuadSplit split = SplitQuad(ring);
  if (!split.is_flat || !split.is_simple) {
    throw InputError(
        params.where(),
        fmt::format("patch {} of {} {}; flat patches without crossing edges are "
                    "supported",
                    first / 4, params.object(),
                    split.is_flat ? "crosses itself" : "is not flat"));
  }
  for (int corner : split.corners) {
    out->indices.push_back(base + static_cast<std::uint32_t>(corner));
  }
}

}  // namespace

std::shared_ptr<const TriangleMesh> InterpretTriangleMesh(ParamSet& params) {
  auto mesh = std::make_shared<TriangleMesh>(ReadVertices(params, 3));
  params.Ignore("S", "tangents follow from the uvs");
  params.Ignore("faceIndices", "only ptex textures need it");
  return mesh;
}

std::shared_ptr<const TriangleMesh> InterpretBilinearMesh(ParamSet& params) {
  const TriangleMesh in = ReadVertices(params, 4);
  auto mesh = std::make_shared<TriangleMesh>();
  for (std::size_t i = 0; i < in.indices.size(); i += 4)
    AddPatch(params, in, i, mesh.get());
  params.Ignore("emissionfilename", "patches do not sample an image");
  params.Ignore("faceIndices", "only ptex textures need it");
  return mesh;
}

}  // namespace lanelight

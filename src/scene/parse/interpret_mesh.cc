#include <fmt/format.h>

#include <cmath>

#include "src/scene/parse/bilinear_patch.h"
#include "src/scene/parse/interpret.h"
#include "src/scene/parse/loop_subdivision.h"

namespace lanelight {
namespace {

// Discards values with a warning unless there is one for each vertex, as pbrt-v4.
template <typename T>
void KeepOneEach(const ParamSet& params, const Param& param, std::size_t vertices,
                 std::vector<T>& values) {
  if (values.size() == vertices) return;
  params.Warn(param, fmt::format("{} values for {} vertices; discarded", values.size(),
                                 vertices));
  values.clear();
}

void ReadAttributes(ParamSet& params, TriangleMesh& mesh) {
  if (const Param* n = params.Find("N", {ParamType::kNormal})) {
    mesh.normals = Triples(*n);
    KeepOneEach(params, *n, mesh.positions.size(), mesh.normals);
  }
  if (const Param* uv = params.Find("uv", {ParamType::kPoint2})) {
    for (std::size_t i = 0; i < uv->numbers.size(); i += 2) {
      mesh.uvs.push_back({uv->numbers[i], uv->numbers[i + 1]});
    }
    KeepOneEach(params, *uv, mesh.positions.size(), mesh.uvs);
  }
}

TriangleMesh ReadFaces(ParamSet& params, std::size_t corners) {
  TriangleMesh mesh;
  mesh.positions = Triples(params.Need("P", ParamType::kPoint3));
  const Param* indices = params.Find("indices", {ParamType::kInteger});
  if (indices == nullptr) {
    if (mesh.positions.size() != corners) {
      throw InputError(params.where(),
                       "{} has {} vertices and no \"integer indices\"; without them it "
                       "takes {} vertices",
                       params.object(), mesh.positions.size(), corners);
    }
    for (std::uint32_t i = 0; i < corners; ++i) mesh.indices.push_back(i);
    return mesh;
  }
  const std::size_t num_indices = indices->numbers.size(), excess = num_indices % corners;
  if (num_indices < corners) {
    params.Fail(*indices, "{} indices; a face takes {}", num_indices, corners);
  }
  if (excess != 0) {
    params.Warn(
        *indices,
        fmt::format("{} indices; they come in groups of {}; the last {} discarded",
                    num_indices, corners, excess));
  }
  mesh.indices.reserve(num_indices - excess);
  for (std::size_t i = 0; i < num_indices - excess; ++i) {
    const double index = indices->numbers[i];
    if (index < 0 || index >= static_cast<double>(mesh.positions.size())) {
      params.Fail(*indices, "index {} (number {}) is not one of the {} vertices", index,
                  i + 1, mesh.positions.size());
    }
    mesh.indices.push_back(static_cast<std::uint32_t>(index));
  }
  return mesh;
}

BilinearPatch PatchOf(const TriangleMesh& in, std::size_t first) {
  BilinearPatch patch;
  if (!in.normals.empty()) patch.n.emplace();
  for (std::size_t k = 0; k < 4; ++k) {
    const std::uint32_t vertex = in.indices[first + k];
    patch.p[k] = in.positions[vertex];
    if (patch.n) (*patch.n)[k] = in.normals[vertex];
    if (!in.uvs.empty()) patch.uv[k] = in.uvs[vertex];
  }
  return patch;
}

// Limits the memory that a mistyped level can take.
constexpr double kMaxTriangles = 1e8;

int SubdivisionLevels(ParamSet& params, std::size_t faces) {
  constexpr int kMaxLevels = 12;
  const int levels = params.Integer("levels", 3, {0, kMaxLevels});
  const double triangles = std::ldexp(static_cast<double>(faces), 2 * levels);
  if (triangles <= kMaxTriangles) return levels;
  params.Fail(*params.Find("levels", {}),
              "{} levels make {:g} triangles of {}; at most {:g} are supported", levels,
              triangles, faces, kMaxTriangles);
}

}  // namespace

std::shared_ptr<const TriangleMesh> InterpretTriangleMesh(ParamSet& params) {
  auto mesh = std::make_shared<TriangleMesh>(ReadFaces(params, 3));
  ReadAttributes(params, *mesh);
  params.Ignore("S", "tangents follow from the uvs");
  params.Ignore("faceIndices", "only ptex textures need it");
  return mesh;
}

std::shared_ptr<const TriangleMesh> InterpretBilinearMesh(ParamSet& params) {
  TriangleMesh in = ReadFaces(params, 4);
  ReadAttributes(params, in);
  auto mesh = std::make_shared<TriangleMesh>();
  for (std::size_t i = 0; i < in.indices.size(); i += 4) {
    AddPatch(PatchOf(in, i), mesh.get());
  }
  params.Ignore("emissionfilename", "patches do not sample an image", true);
  params.Ignore("faceIndices", "only ptex textures need it");
  return mesh;
}

std::shared_ptr<const TriangleMesh> InterpretLoopSubdivision(ParamSet& params) {
  const TriangleMesh control = ReadFaces(params, 3);
  const int levels = SubdivisionLevels(params, control.indices.size() / 3);
  params.Choice<bool>("scheme", {{"loop", true}}, "loop");
  const std::string problem = SubdivisionProblem(control);
  if (!problem.empty()) {
    throw InputError(params.where(), "{} cannot be subdivided: {}", params.object(),
                     problem);
  }
  return std::make_shared<TriangleMesh>(LoopSubdivide(control, levels));
}

}  // namespace lanelight

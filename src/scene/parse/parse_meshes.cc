// Mesh files, after the text: every file once, all in parallel.
#include <fmt/format.h>

#include <optional>

#include "src/base/core/error_text.h"
#include "src/base/core/parallel.h"
#include "src/base/core/suggest.h"
#include "src/scene/parse/displace.h"
#include "src/scene/parse/parse_state.h"
#include "src/scene/parse/ply_repair.h"

namespace lanelight {
namespace {

struct LoadedMesh {
  const MeshRequest* first = nullptr;  // who asked for it first
  std::shared_ptr<const TriangleMesh> mesh;
  std::vector<std::string> notes;
};

// Errors inside the file are reported at the scene's line, with the place in the file.
PlyMesh Parse(const std::string& bytes, const MeshRequest& request) {
  try {
    return ParsePly(bytes, request.path);
  } catch (const InputError& error) {
    std::string message = error.what();
    const std::string_view label = ": error: ";
    const std::size_t at = message.find(label);
    if (at != message.npos) message.replace(at, label.size(), ": ");
    throw InputError(request.where, message);
  }
}

void Load(const ParseState& state, LoadedMesh* out) {
  const MeshRequest& request = *out->first;
  PlyMesh ply =
      Parse(ReadSceneFile(state, request.path, request.where, "the mesh file"), request);
  out->notes = PlyNotes(ply, request.path);
  out->mesh = std::make_shared<const TriangleMesh>(std::move(ply.mesh));
}

void DisplaceMesh(ParseState& state, const MeshRequest& request, Shape* shape) {
  const std::vector<Texture>& textures = state.scene.textures;
  const std::string problem = HeightTexture::Problem(textures, request.displacement);
  if (!problem.empty()) {
    state.scene.notes.push_back(
        {request.where, "this mesh is not displaced: " + problem, true});
    return;
  }
  if (shape->mesh->uvs.empty()) {
    throw InputError(
        request.where,
        fmt::format("{} has no texture coordinates, which displacement needs",
                    Quoted(request.path)));
  }
  const HeightTexture height(textures, request.displacement);
  try {
    shape->mesh = std::make_shared<const TriangleMesh>(
        Displace(*shape->mesh, request.world_from_object, request.edge_length, height));
  } catch (const InputError& error) {
    throw InputError(request.where, WithoutPrefix(error));
  }
}

}  // namespace

void LoadMeshes(ParseState& state) {
  std::map<std::string, std::size_t> position;
  std::vector<LoadedMesh> files;
  for (const MeshRequest& request : state.meshes) {
    if (position.emplace(request.path, files.size()).second) {
      files.push_back({&request, nullptr, {}});
    }
  }
  // Errors are collected, so that the first one in the scene is reported on every run.
  std::vector<std::optional<InputError>> failures(files.size());
  ParallelFor(files.size(), [&](std::size_t i) {
    try {
      Load(state, &files[i]);
    } catch (const InputError& error) {
      failures[i] = error;
    }
  });
  for (const auto& failure : failures) {
    if (failure) throw *failure;
  }
  for (const LoadedMesh& file : files) {
    for (const std::string& note : file.notes) state.AddNote(file.first->where, note);
  }
  for (const MeshRequest& request : state.meshes) {
    std::vector<Shape>& shapes = request.object == kNone
                                     ? state.scene.shapes
                                     : state.scene.objects[request.object].shapes;
    Shape& shape = shapes[request.shape];
    shape.mesh = files[position[request.path]].mesh;
    if (request.displacement != kNone) DisplaceMesh(state, request, &shape);
  }
}

}  // namespace lanelight

#include "src/scene/parse/parse.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <utility>

#include "src/base/core/error.h"
#include "src/base/core/parallel.h"
#include "src/base/core/suggest.h"
#include "src/scene/parse/displace.h"
#include "src/scene/parse/motion.h"
#include "src/scene/parse/parse_state.h"
#include "src/scene/parse/ply.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

// Sends camera rays through the centres of pixels and lens, as pbrt's disablepixeljitter:
// the box is smaller than the resolution of film coordinates in float32.
void UsePixelCenters(SceneDescription& scene) {
  scene.filter = {};
  scene.filter.kind = FilterKind::kBox;
  scene.filter.x_radius = scene.filter.y_radius = 1e-6;
  scene.camera.lens_radius = 0;
}

struct LoadedMesh {
  const MeshRequest* first = nullptr;  // the first request for it
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
    return state.AddImageNote(request.where,
                              "this mesh is rendered without displacement: " + problem);
  }
  if (shape->mesh->uvs.empty()) {
    throw InputError(request.where,
                     "{} has no texture coordinates, which displacement needs",
                     Quoted(request.path));
  }
  const HeightTexture height(textures, request.displacement);
  try {
    shape->mesh = std::make_shared<const TriangleMesh>(
        Displace(*shape->mesh, request.world_from_object, request.edge_length, height));
  } catch (const InputError& error) {
    throw InputError(request.where, WithoutPrefix(error));
  }
}

// Reads every requested mesh, each file once, in parallel.
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

// Runs after the last directive: checks that all scopes are closed, and completes what
// depends on several directives.
SceneDescription Finish(ParseState& state, const SourceLocation& end) {
  if (!state.scopes.empty()) {
    const Scope& scope = state.scopes.back();
    throw InputError(scope.where, "this {} has no matching end", BeginName(scope.kind));
  }
  if (!state.in_world) {
    throw InputError(end, "the file ends without WorldBegin, so it describes no scene");
  }
  RequireAllResolved(state);
  RequireSlotsDefined(state);
  PlaceMovingShapes(state);
  state.scene.film.imaging_ratio =
      (state.shutter_close - state.shutter_open) * state.iso / 100;
  if (state.pixel_centers) UsePixelCenters(state.scene);
  state.scene.integrator.force_diffuse = state.force_diffuse;
  const Integrator& integrator = state.scene.integrator;
  ApplyStrategy(integrator.strategy, integrator.strategy_where, state.scene.strategy);
  LoadMeshes(state);
  FitMotionsToShutter(state);
  return std::move(state.scene);
}

}  // namespace

SceneDescription ParseScene(const std::string& path, const ParseOptions& options) {
  ParseState state;
  state.options = options;
  state.scene.path = path;
  const SourceLocation whole{std::make_shared<const std::string>(path), 0, 0};
  RunFile(state, path, whole);
  return Finish(state, whole);
}

SceneDescription ParseSceneText(std::string_view text, const std::string& name,
                                const std::string& directory,
                                const ParseOptions& options) {
  ParseState state;
  state.options = options;
  state.scene.path = (fs::path(directory) / name).string();
  const auto shared_name = std::make_shared<const std::string>(name);
  state.open_files.push_back(std::make_shared<const SourceFile>(
      SourceFile{"", directory, shared_name, std::string(text)}));
  RunDirectives(state);
  return Finish(state, {shared_name, 0, 0});
}

}  // namespace lanelight

#include "src/scene/parse/parse.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "src/scene/parse/motion.h"
#include "src/scene/parse/parse_state.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

// Camera rays through the centres of pixels and lens, as pbrt's disablepixeljitter: a box
// that is as good as a point, since film coordinates in float32 are no finer.
void UsePixelCenters(SceneDescription& scene) {
  scene.filter = {};
  scene.filter.kind = FilterKind::kBox;
  scene.filter.x_radius = scene.filter.y_radius = 1e-6;
  scene.camera.lens_radius = 0;
}

// After the last directive: everything must be closed, and the scene is completed with
// what depends on several directives.
SceneDescription Finish(ParseState& state, const SourceLocation& end) {
  if (!state.scopes.empty()) {
    const Scope& scope = state.scopes.back();
    const char* name =
        scope.kind == ScopeKind::kAttribute ? "AttributeBegin" : "ObjectBegin";
    throw InputError(scope.where, fmt::format("this {} has no matching end", name));
  }
  if (!state.in_world) {
    throw InputError(end, "the file ends without WorldBegin, so it describes no scene");
  }
  RequireNothingWaits(state);
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

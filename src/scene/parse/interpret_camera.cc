#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "src/base/core/suggest.h"
#include "src/scene/parse/interpret.h"
#include "src/scene/parse/lex.h"
#include "src/scene/parse/motion.h"

namespace lanelight {
namespace {

void ReadWindow(ParamSet& params, Camera* camera) {
  camera->frame_aspect = params.Float("frameaspectratio", 0, {1e-6, 1e6});
  const Param* window = params.Find("screenwindow", {ParamType::kFloat});
  if (window == nullptr) return;
  const std::vector<double>& n = window->numbers;
  if (n.size() != 4) params.Fail(*window, "{} numbers; it takes 4", n.size());
  if (!(n[0] < n[1] && n[2] < n[3])) {
    params.Fail(*window,
                "the window is empty; it takes x0 x1 y0 y1 with x0 < x1, y0 < y1");
  }
  std::copy(n.begin(), n.end(), camera->screen_window);
}

void ReadShutter(ParseState& state, ParamSet& params) {
  const double open = params.Float("shutteropen", 0);
  const double close = params.Float("shutterclose", 1);
  if (!(close > open) || !std::isfinite(close - open)) {
    throw InputError(params.where(), "the shutter closes at {} but opens at {}", close,
                     open);
  }
  state.shutter_open = open;
  state.shutter_close = close;
}

std::vector<double> ReadLensFile(const ParseState& state, ParamSet& params,
                                 const Param& file, const std::string& path) {
  std::vector<double> numbers = ReadNumberFile(state, path, file.where, "the lens file");
  if (numbers.empty() || numbers.size() % 4 != 0) {
    params.Fail(file,
                "the file {} has {} numbers; it takes rows of four: radius, thickness, "
                "eta, diameter",
                Quoted(path), numbers.size());
  }
  return numbers;
}

void CheckLenses(ParseState& state, ParamSet& params, const Param& file,
                 const Camera& camera) {
  for (std::size_t i = 0; i < camera.lens.size(); i += 4) {
    const double* row = &camera.lens[i];
    if (row[1] < 0 || row[2] < 0 || !(row[3] > 0)) {
      params.Fail(file,
                  "row {} of the lens file: thickness and eta must not be negative, the "
                  "diameter above 0",
                  i / 4 + 1);
    }
    if (row[0] == 0 && camera.aperture_diameter > row[3]) {
      state.AddNote(
          params.where(),
          "aperturediameter {} is larger than the stop of the lenses, which has {}",
          camera.aperture_diameter, row[3]);
    }
  }
}

void ReadRealistic(ParseState& state, ParamSet& params, Camera& camera) {
  const NamedFile file = RequireFile(state, params, "lensfile");
  camera.aperture_diameter = params.Float("aperturediameter", 1, {1e-6, kHuge});
  camera.focal_distance = params.Float("focusdistance", 10, {1e-30, kHuge});
  camera.aperture = params.String("aperture", "");
  static constexpr std::string_view kShapes[] = {"", "gaussian", "square", "pentagon",
                                                 "star"};
  if (std::find(std::begin(kShapes), std::end(kShapes), camera.aperture) ==
      std::end(kShapes)) {
    camera.aperture = ResolvePath(state, camera.aperture);
  }
  camera.lens = ReadLensFile(state, params, *file.param, file.path);
  CheckLenses(state, params, *file.param, camera);
}

// Images all directions: it has no lens and uses the whole film.
void ReadSpherical(ParseState&, ParamSet& params, Camera& camera) {
  static constexpr std::pair<const char*, SphericalMapping> kMappings[] = {
      {"equalarea", SphericalMapping::kEqualArea},
      {"equirectangular", SphericalMapping::kEquirectangular}};
  if (const Param* mapping = params.Find("mapping", {ParamType::kString})) {
    camera.mapping =
        Lookup(kMappings, params.String("mapping", ""), mapping->where, "mapping");
  }
  for (const char* name :
       {"lensradius", "focaldistance", "frameaspectratio", "screenwindow"}) {
    params.Ignore(name, "a spherical camera has neither lens nor window");
  }
}

void ReadOrthographic(ParseState&, ParamSet& params, Camera& camera) {
  camera.lens_radius = params.Float("lensradius", 0, kNotNegative);
  camera.focal_distance = params.Float("focaldistance", 1e6, {1e-30, kHuge});
  ReadWindow(params, &camera);
}

void ReadPerspective(ParseState& state, ParamSet& params, Camera& camera) {
  camera.fov = params.Float("fov", 90, {1e-6, 179.999});
  ReadOrthographic(state, params, camera);
}

struct CameraType {
  CameraKind kind;
  void (*read)(ParseState&, ParamSet&, Camera&);
};
constexpr std::pair<const char*, CameraType> kCameraTypes[] = {
    {"perspective", {CameraKind::kPerspective, ReadPerspective}},
    {"orthographic", {CameraKind::kOrthographic, ReadOrthographic}},
    {"spherical", {CameraKind::kSpherical, ReadSpherical}},
    {"realistic", {CameraKind::kRealistic, ReadRealistic}}};

}  // namespace

void InterpretCamera(ParseState& state, const std::string& type, ParamSet& params) {
  Camera camera;
  camera.where = params.where();
  camera.film_diagonal = state.scene.camera.film_diagonal;  // of the Film before
  camera.world_from_camera = state.graphics.ctm.Inverse();
  camera.medium = state.graphics.media.outside;
  const Transform end = state.graphics.ctm_end.Inverse();
  camera.end = EndOf(camera.world_from_camera, end, params.where());
  state.coordinate_systems["camera"] = {camera.world_from_camera, end};
  const auto& [kind, read] = Lookup(kCameraTypes, type, params.where(), "camera");
  camera.kind = kind;
  read(state, params, camera);
  ReadShutter(state, params);
  params.CheckAllUsed();
  state.scene.camera = camera;
}

void InterpretFilter(ParseState& state, const std::string& type, ParamSet& params) {
  struct Type {
    FilterKind kind;
    double radius;
  };
  static constexpr std::pair<const char*, Type> kTypes[] = {
      {"box", {FilterKind::kBox, 0.5}},
      {"triangle", {FilterKind::kTriangle, 2}},
      {"gaussian", {FilterKind::kGaussian, 1.5}},
      {"mitchell", {FilterKind::kMitchell, 2}},
      {"sinc", {FilterKind::kLanczos, 4}}};
  constexpr Limits kLimits = {1e-3, 100};
  const auto& [kind, radius] = Lookup(kTypes, type, params.where(), "pixel filter");
  Filter filter;
  filter.kind = kind;
  filter.x_radius = params.Float("xradius", radius, kLimits);
  filter.y_radius = params.Float("yradius", radius, kLimits);
  if (kind == FilterKind::kGaussian) filter.sigma = params.Float("sigma", 0.5, kLimits);
  if (kind == FilterKind::kMitchell) {
    filter.b = params.Float("B", filter.b, {-10, 10});
    filter.c = params.Float("C", filter.c, {-10, 10});
  }
  if (kind == FilterKind::kLanczos) filter.tau = params.Float("tau", 3, kLimits);
  params.CheckAllUsed();
  state.scene.filter = filter;
}

}  // namespace lanelight

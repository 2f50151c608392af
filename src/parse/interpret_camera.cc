// Camera and pixel filter.
#include <cmath>
#include <limits>

#include "src/parse/interpret.h"
#include "src/core/suggest.h"

namespace lanelight {
namespace {

constexpr double kHuge = 1e30;  // of lengths that have no natural limit

}  // namespace

const Param* NumberArray(ParamSet& params, std::string_view name, ParamType type,
                         std::size_t count) {
  const Param* param = params.Find(name, {type});
  if (param != nullptr && param->numbers.size() != count) {
    params.Fail(*param,
                fmt::format("{} numbers; it takes {}", param->numbers.size(), count));
  }
  return param;
}

namespace {

void ReadWindow(ParamSet& params, Camera* camera) {
  camera->frame_aspect = params.Float("frameaspectratio", 0, 1e-6, 1e6);
  const Param* window = NumberArray(params, "screenwindow", ParamType::kFloat, 4);
  if (window == nullptr) return;
  const std::vector<double>& n = window->numbers;
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
    throw InputError(
        params.where(),
        fmt::format("the shutter closes at {} but opens at {}", close, open));
  }
  state.exposure_seconds = close - open;
}

}  // namespace

void InterpretCamera(ParseState& state, const std::string& type, ParamSet& params) {
  Camera camera;
  camera.where = params.where();
  camera.world_from_camera = state.graphics.ctm.Inverse();
  state.coordinate_systems["camera"] = camera.world_from_camera;
  if (type == "perspective") {
    camera.kind = CameraKind::kPerspective;
    camera.fov = params.Float("fov", 90, 1e-6, 179.999);
  } else if (type == "orthographic") {
    camera.kind = CameraKind::kOrthographic;
  } else {
    ThrowUnknown(params.where(), "camera", type, {"perspective", "orthographic"});
  }
  camera.lens_radius = params.Float("lensradius", 0, 0, kHuge);
  camera.focal_distance = params.Float("focaldistance", 1e6, 1e-30, kHuge);
  ReadWindow(params, &camera);
  ReadShutter(state, params);
  params.CheckAllUsed();
  state.scene.camera = camera;
}

void InterpretFilter(ParseState& state, const std::string& type, ParamSet& params) {
  struct Kind {
    const char* name;
    FilterKind kind;
    double radius;
  };
  static constexpr Kind kKinds[] = {{"box", FilterKind::kBox, 0.5},
                                    {"triangle", FilterKind::kTriangle, 2},
                                    {"gaussian", FilterKind::kGaussian, 1.5},
                                    {"mitchell", FilterKind::kMitchell, 2},
                                    {"sinc", FilterKind::kLanczos, 4}};
  std::vector<std::string> names;
  for (const Kind& kind : kKinds) names.emplace_back(kind.name);
  const auto it = std::find(names.begin(), names.end(), type);
  if (it == names.end()) ThrowUnknown(params.where(), "pixel filter", type, names);
  const Kind& kind = kKinds[it - names.begin()];
  Filter filter;
  filter.kind = kind.kind;
  filter.x_radius = params.Float("xradius", kind.radius, 1e-3, 100);
  filter.y_radius = params.Float("yradius", kind.radius, 1e-3, 100);
  if (kind.kind == FilterKind::kGaussian)
    filter.sigma = params.Float("sigma", 0.5, 1e-3, 100);
  if (kind.kind == FilterKind::kMitchell) {
    filter.b = params.Float("B", filter.b, -10, 10);
    filter.c = params.Float("C", filter.c, -10, 10);
  }
  if (kind.kind == FilterKind::kLanczos) filter.tau = params.Float("tau", 3, 1e-3, 100);
  params.CheckAllUsed();
  state.scene.filter = filter;
}

}  // namespace lanelight

// Camera, film and pixel filter.
#include <cmath>
#include <limits>

#include "src/parse/interpret.h"
#include "src/core/suggest.h"

namespace lanelight {
namespace {

constexpr double kHuge = 1e30;       // of lengths that have no natural limit
constexpr int kLargestSide = 65536;  // pixels
constexpr double kMostPixels = 1 << 30;

// "float name" with exactly `count` numbers, or null.
const Param* NumberArray(ParamSet& params, std::string_view name, ParamType type,
                         std::size_t count) {
  const Param* param = params.Find(name, {type});
  if (param != nullptr && param->numbers.size() != count) {
    params.Fail(*param,
                fmt::format("{} numbers; it takes {}", param->numbers.size(), count));
  }
  return param;
}

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

// cropwindow: part of the image, 0 to 1; pixels x0 <= x < x1 as ceil(x0 * width).
void ReadCrop(ParamSet& params, Film* film) {
  const Param* part = NumberArray(params, "cropwindow", ParamType::kFloat, 4);
  const Param* pixels = NumberArray(params, "pixelbounds", ParamType::kInteger, 4);
  if (part == nullptr && pixels == nullptr) return;
  if (part != nullptr && pixels != nullptr) {
    params.Fail(*part, "cropwindow and pixelbounds exclude each other");
  }
  const Param& param = part != nullptr ? *part : *pixels;
  int crop[4];
  for (int i = 0; i < 4; ++i) {
    const int side = i < 2 ? film->width : film->height;
    const double low = 0, high = part != nullptr ? 1 : side;
    const double value = param.numbers[i];
    if (value < low || value > high) {
      params.Fail(param,
                  fmt::format("the value {} is outside {} to {}", value, low, high));
    }
    crop[i] = static_cast<int>(part != nullptr ? std::ceil(value * side) : value);
  }
  if (crop[0] >= crop[1] || crop[2] >= crop[3]) {
    params.Fail(param, "no pixel is left; it takes x0 x1 y0 y1 with x0 < x1, y0 < y1");
  }
  std::copy(crop, crop + 4, film->crop);
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

void InterpretFilm(ParseState& state, const std::string& type, ParamSet& params) {
  if (type == "gbuffer") {
    state.AddNote(params.where(), "film \"gbuffer\" is taken as \"rgb\"");
    params.Ignore("coordinatesystem", "--aov chooses what is written");
  } else if (type != "rgb") {
    ThrowUnknown(params.where(), "film", type, {"rgb", "gbuffer"});
  }
  Film film;
  film.width = params.Integer("xresolution", 1280, 1, kLargestSide);
  film.height = params.Integer("yresolution", 720, 1, kLargestSide);
  if (static_cast<double>(film.width) * film.height > kMostPixels) {
    throw InputError(params.where(),
                     fmt::format("{} x {} pixels; at most {} are supported", film.width,
                                 film.height, kMostPixels));
  }
  film.filename = params.String("filename", film.filename);
  ReadCrop(params, &film);
  state.iso = params.Float("iso", 100, 1e-6, 1e9);
  params.Ignore("savefp16", "--depth chooses half or float");
  params.Ignore("diagonal", "only the realistic camera needs it");
  params.Ignore("sensor", "the film records linear sRGB directly");
  params.Ignore("whitebalance", "the film records linear sRGB directly");
  params.Ignore("maxcomponentvalue", "samples are not clamped");
  params.CheckAllUsed();
  if (state.graphics.color_space != "srgb") {
    state.AddNote(params.where(),
                  "the image is written in linear sRGB, not in the film's "
                  "color space " +
                      Quoted(state.graphics.color_space));
  }
  state.scene.film = film;
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

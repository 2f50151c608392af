// Film: size, crop window, and response to light.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/base/core/suggest.h"
#include "src/base/image/color_spaces.h"
#include "src/base/image/wavelengths.h"
#include "src/scene/parse/interpret.h"
#include "src/scene/parse/names.h"

namespace lanelight {
namespace {

constexpr int kLargestSide = 65536;  // pixels
constexpr double kMaxPixels = 1 << 30;

const std::vector<std::string> kCameras = {
    "canon_eos_100d", "canon_eos_1dx_mkii", "canon_eos_200d",     "canon_eos_200d_mkii",
    "canon_eos_5d",   "canon_eos_5d_mkii",  "canon_eos_5d_mkiii", "canon_eos_5d_mkiv",
    "canon_eos_5ds",  "canon_eos_m",        "hasselblad_l1d_20c", "nikon_d810",
    "nikon_d850",     "sony_ilce_6400",     "sony_ilce_7m3",      "sony_ilce_7rm3",
    "sony_ilce_9"};

// Returns four numbers, or null; pbrt-v4 ignores other counts.
const Param* Window(ParamSet& params, std::string_view name, ParamType type) {
  const Param* param = params.Find(name, {type});
  if (param == nullptr || param->numbers.size() == 4) return param;
  params.Warn(
      *param,
      fmt::format(
          "{} numbers; it takes 4 (x0 x1 y0 y1); the window is ignored, as in pbrt-v4",
          param->numbers.size()));
  return nullptr;
}

// cropwindow: part of the image, 0 to 1; pixels x0 <= x < x1 as ceil(x0 * width). Numbers
// of an axis may stand in either order.
void ReadCrop(ParamSet& params, Film* film) {
  const Param* part = Window(params, "cropwindow", ParamType::kFloat);
  const Param* pixels = Window(params, "pixelbounds", ParamType::kInteger);
  if (part == nullptr && pixels == nullptr) return;
  if (part != nullptr && pixels != nullptr) {
    params.Warn(*pixels, "cropwindow is used instead, as in pbrt-v4");
  }
  const Param& param = part != nullptr ? *part : *pixels;
  int crop[4];
  bool outside = false;
  for (int i = 0; i < 4; ++i) {
    const int side = i < 2 ? film->width : film->height;
    const double max_coordinate = part != nullptr ? 1 : side;
    const double value = std::clamp(param.numbers[i], 0.0, max_coordinate);
    outside = outside || value != param.numbers[i];
    crop[i] = static_cast<int>(part != nullptr ? std::ceil(value * side) : value);
  }
  if (outside) params.Warn(param, "the window goes beyond the image, and is clamped");
  for (int i = 0; i < 4; i += 2) {
    if (crop[i] > crop[i + 1]) std::swap(crop[i], crop[i + 1]);
  }
  if (crop[0] == crop[1] || crop[2] == crop[3]) {
    params.Fail(param, "no pixel is left; it takes x0 x1 y0 y1 with x0 < x1, y0 < y1");
  }
  std::copy(crop, crop + 4, film->crop);
}

// Approximates pbrt-v4's sensors by the CIE 1931 observer with the Bradford transform. A
// named camera balances at 6500 K by default; its response curves are not in this
// project.
void ReadSensor(ParseState& state, ParamSet& params, Film* film) {
  const std::string sensor = params.String("sensor", "cie1931");
  double kelvin = params.Float("whitebalance", 0);
  const Param* balance = params.Find("whitebalance", {});
  if (kelvin != 0 && !(kelvin >= kMinWhiteKelvin && kelvin <= kMaxWhiteKelvin)) {
    params.Fail(*balance,
                "the temperature {} is not 0 (none) and outside {} to {} kelvin", kelvin,
                kMinWhiteKelvin, kMaxWhiteKelvin);
  }
  if (sensor != "cie1931") {
    const SourceLocation& where = params.Find("sensor", {})->where;
    if (std::find(kCameras.begin(), kCameras.end(), sensor) == kCameras.end()) {
      std::vector<std::string> known = kCameras;
      known.insert(known.begin(), "cie1931");
      ThrowUnknown(where, "sensor", sensor, known);
    }
    state.AddNote(where,
                  "sensor {} is taken as \"cie1931\" with the white balance of the "
                  "camera: greys are the same, saturated colours differ a little",
                  Quoted(sensor));
    if (kelvin == 0) kelvin = 6500;
  }
  film->color_space = state.graphics.color_space;
  film->response.matrix = FilmMatrix(FindColorSpace(film->color_space), kelvin);
  film->response.max_component =
      params.Float("maxcomponentvalue", film->response.max_component, {1e-30, 1e30});
}

void ReadGbuffer(ParseState&, ParamSet& params, Film* film) {
  film->gbuffer = params.Choice<Gbuffer>(
      "coordinatesystem", {{"camera", Gbuffer::kCamera}, {"world", Gbuffer::kWorld}});
}

void ReadSpectral(ParseState& state, ParamSet& params, Film* film) {
  constexpr int kMaxBuckets = 1024;
  constexpr double kMinBucketWidth = 0.01;  // nm: names of channels have three digits
  SpectralBuckets& buckets = film->buckets;
  buckets.count = params.Integer("nbuckets", 16, {1, kMaxBuckets});
  const Limits range = {kFirstNm, kLastNm};
  buckets.first = params.Float("lambdamin", kFirstNm, range);
  buckets.last = params.Float("lambdamax", kLastNm, range);
  if (buckets.last - buckets.first < kMinBucketWidth * buckets.count) {
    throw InputError(
        params.where(),
        "{} buckets from \"lambdamin\" {} to \"lambdamax\" {} nm are narrower than {} nm",
        buckets.count, buckets.first, buckets.last, kMinBucketWidth);
  }
  // The first and the last bin are the wide ones.
  const auto& edge = CarriedWavelengths().edge;
  const double low = edge[1], high = edge[kWavelengthBins - 1];
  if (buckets.first >= low && buckets.last <= high) return;
  state.AddNote(params.where(),
                "film \"spectral\": paths carry {} to {} nm, and one bin each covers all "
                "below {:.0f} and all above {:.0f} nm. Buckets outside are zero; a "
                "bucket partly outside is the mean of its part inside",
                kFirstCarriedNm, kLastCarriedNm, low, high);
}

}  // namespace

void InterpretFilm(ParseState& state, const std::string& type, ParamSet& params) {
  static constexpr std::pair<const char*, void (*)(ParseState&, ParamSet&, Film*)>
      kTypes[] = {{"rgb", [](ParseState&, ParamSet&, Film*) {}},
                  {"gbuffer", ReadGbuffer},
                  {"spectral", ReadSpectral}};
  Film film;
  Lookup(kTypes, type, params.where(), "film")(state, params, &film);
  film.width = params.Integer("xresolution", 1280, {1, kLargestSide});
  film.height = params.Integer("yresolution", 720, {1, kLargestSide});
  if (static_cast<double>(film.width) * film.height > kMaxPixels) {
    throw InputError(params.where(), "{} x {} pixels; at most {} are supported",
                     film.width, film.height, kMaxPixels);
  }
  film.filename = params.String("filename", film.filename);
  ReadCrop(params, &film);
  state.iso = params.Float("iso", 100, {1e-6, 1e9});
  params.Ignore("savefp16", "--depth chooses half or float");
  state.scene.camera.film_diagonal = params.Float("diagonal", 35, {1e-3, 1e6});
  ReadSensor(state, params, &film);
  params.CheckAllUsed();
  state.scene.film = film;
}

}  // namespace lanelight

// Lights. Every scale of the file ends up in the emission, so nothing later needs to know
// how it was stated (formulas: pbrt-v4's light descriptions).
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "src/base/core/pi.h"
#include "src/base/core/suggest.h"
#include "src/scene/parse/interpret.h"
#include "src/scene/parse/motion.h"

namespace lanelight {
namespace {

constexpr Rgb kWhite = {1, 1, 1};

// Returns the colour of a light, by default the illuminant of the color space.
Rgb LightColor(ParseState& state, ParamSet& params, const char* name,
               OwnSpectrum* spectrum, SpectrumUse use = SpectrumUse::kIlluminant) {
  const Rgb absent = ToSrgb(state.graphics.color_space, kWhite, use);
  const Rgb color = PlainColor(state, params, name, absent, use);
  const Param* given = params.Find(name, {});
  if (given != nullptr) *spectrum = SpectrumOf(state, params, *given, use);
  return color;
}

// 1 - cos, without cancellation for small angles.
double Versine(double degrees) {
  const double sine = std::sin(degrees * (kPi / 360));
  return 2 * sine * sine;
}

// A target such as "power"; 0 or less means not given, as in pbrt.
double Target(ParamSet& params, const char* name) {
  return params.Float(name, -1, {-kHuge, kHuge});  // negative: not set, as in pbrt-v4
}

void ReadDirection(ParamSet& params, Light* light) {
  light->from = params.Point3("from", {0, 0, 0});
  light->to = params.Point3("to", {0, 0, 1});
  const Vec3d d = light->to - light->from;
  const double length = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
  if (!(length > 0) || !std::isfinite(length)) {
    throw InputError(params.where(), params.object() +
                                         " has no direction: \"from\" and "
                                         "\"to\" are the same point");
  }
}

void ReadPoint(ParseState& state, ParamSet& params, Light* light) {
  light->from = params.Point3("from", {0, 0, 0});
  const double scale = params.Float("scale", 1, kNotNegative);
  const double power = Target(params, "power");
  const Rgb intensity = LightColor(state, params, "I", &light->spectrum);
  light->emission = intensity * (power > 0 ? scale * power / (4 * kPi) : scale);
}

void ReadSpot(ParseState& state, ParamSet& params, Light* light) {
  ReadDirection(params, light);
  light->cone_angle = params.Float("coneangle", 30, {1e-6, 180});
  light->cone_delta = params.Float("conedeltaangle", 5, {0, 180});
  // The falloff of pbrt-v4 begins at the cosine of their difference, of either sign.
  const double begins = std::abs(light->cone_angle - light->cone_delta);
  if (begins > light->cone_angle) {
    throw InputError(params.where(),
                     fmt::format("conedeltaangle {} of the spot light is more than twice "
                                 "its coneangle {}",
                                 light->cone_delta, light->cone_angle));
  }
  if (light->cone_delta > light->cone_angle) {
    light->cone_delta = light->cone_angle - begins;
    state.AddWarning(params.where(),
                     fmt::format("conedeltaangle of the spot light is larger than its "
                                 "coneangle; {} counts, as in pbrt-v4",
                                 light->cone_delta));
  }
  double scale = params.Float("scale", 1, kNotNegative);
  const double power = Target(params, "power");
  if (power > 0) {
    // Power of a cone of unit intensity whose edge falls off smoothly: the full inner cap
    // and, by symmetry of the smoothstep in cos, half of the outer ring.
    const double outer = Versine(light->cone_angle);
    const double inner = Versine(light->cone_angle - light->cone_delta);
    scale *= power / (kPi * (inner + outer));
  }
  light->emission = LightColor(state, params, "I", &light->spectrum) * scale;
}

void ReadDistant(ParseState& state, ParamSet& params, Light* light) {
  ReadDirection(params, light);
  const double scale = params.Float("scale", 1, kNotNegative);
  const double illuminance = Target(params, "illuminance");
  light->emission = LightColor(state, params, "L", &light->spectrum) *
                    (illuminance > 0 ? scale * illuminance : scale);
}

// Corners in the world, whatever the light's transform is.
void ReadPortal(ParamSet& params, Light* light) {
  const Param* portal = params.Find("portal", {ParamType::kPoint3});
  if (portal == nullptr || portal->numbers.empty()) return;
  if (portal->numbers.size() != 12) {
    params.Fail(*portal,
                fmt::format("{} numbers; it takes four points", portal->numbers.size()));
  }
  for (std::size_t i = 0; i < 12; i += 3) {
    light->portal.push_back(
        {portal->numbers[i], portal->numbers[i + 1], portal->numbers[i + 2]});
  }
}

// Without an image. What falls on a facing surface: pi times the radiance. With a portal
// pbrt-v4 makes an image of one pixel: from a spectrum as it stands, which nothing
// normalises, and as if all of the sky shone from the zenith.
Rgb ConstantSky(ParseState& state, ParamSet& params, Light* light) {
  const bool portal = !light->portal.empty();
  const double illuminance = Target(params, "illuminance");
  const SpectrumUse use = portal ? SpectrumUse::kRadiance : SpectrumUse::kIlluminant;
  const Rgb radiance = LightColor(state, params, "L", &light->spectrum, use);
  if (!(illuminance > 0) || radiance == Rgb{}) return radiance;
  return radiance * (illuminance / (portal ? 2 * kPi * Luminance(radiance) : kPi));
}

// An image instead of the colour L, if there is one: of any kind of light that has both.
template <typename T>
bool ReadEmissionImage(ParseState& state, ParamSet& params, T* light) {
  const NamedFile file = FileOf(state, params, "filename");
  if (!file) return false;
  if (params.Find("L", {}) != nullptr) {
    params.Fail(*file.param, "\"filename\" and \"L\" exclude each other");
  }
  light->image_path = file.path;
  light->where = file.param->where;  // what a missing image is reported at
  return true;
}

void ReadInfinite(ParseState& state, ParamSet& params, Light* light) {
  ReadPortal(params, light);
  const double scale = params.Float("scale", 1, kNotNegative);
  if (!ReadEmissionImage(state, params, light)) {
    light->emission = ConstantSky(state, params, light) * scale;
    return;
  }
  light->image_scale = scale;
  const double illuminance = Target(params, "illuminance");
  light->illuminance = illuminance > 0 ? illuminance : -1;
  light->emission = kWhite;
}

std::string ImageFile(ParseState& state, ParamSet& params, Light* light) {
  const Param* file = params.Find("filename", {ParamType::kString});
  const std::string name = params.String("filename", "");
  if (file == nullptr || name.empty()) {
    throw InputError(params.where(),
                     params.object() + " needs an image, \"string filename\"");
  }
  light->where = file->where;  // what a missing image is reported at
  return ResolvePath(state, name);
}

// The power depends on the image.
void ReadGoniometric(ParseState& state, ParamSet& params, Light* light) {
  light->emission = LightColor(state, params, "I", &light->spectrum) *
                    params.Float("scale", 1, kNotNegative);
  light->power = Target(params, "power");
  light->image_path = ImageFile(state, params, light);
}

void ReadProjection(ParseState& state, ParamSet& params, Light* light) {
  light->emission = kWhite * params.Float("scale", 1, kNotNegative);
  light->power = Target(params, "power");
  light->fov = params.Float("fov", 90, {1e-6, 179.999});
  light->image_path = ImageFile(state, params, light);
}

struct LightType {
  LightKind kind;
  void (*read)(ParseState&, ParamSet&, Light*);
};
constexpr std::pair<const char*, LightType> kLights[] = {
    {"point", {LightKind::kPoint, ReadPoint}},
    {"spot", {LightKind::kSpot, ReadSpot}},
    {"distant", {LightKind::kDistant, ReadDistant}},
    {"infinite", {LightKind::kInfinite, ReadInfinite}},
    {"goniometric", {LightKind::kGoniometric, ReadGoniometric}},
    {"projection", {LightKind::kProjection, ReadProjection}}};

void CheckEmission(const ParamSet& params, Rgb emission) {
  if (!std::isfinite(emission.x + emission.y + emission.z)) {
    throw InputError(params.where(), "the emission of this light overflows");
  }
}

}  // namespace

void InterpretLight(ParseState& state, const std::string& type, ParamSet& params) {
  const auto& [kind, read] = Lookup(kLights, type, params.where(), "light");
  Light light;
  light.kind = kind;
  light.where = params.where();
  light.world_from_light = state.graphics.ctm;
  NoteStill(state, light.where, "light");
  read(state, params, &light);
  params.CheckAllUsed();
  CheckEmission(params, light.emission);
  state.scene.lights.push_back(std::move(light));
}

Index InterpretAreaLight(ParseState& state, const std::string& type, ParamSet& params) {
  if (type != "diffuse") ThrowUnknown(params.where(), "area light", type, {"diffuse"});
  AreaLight light;
  light.where = params.where();
  light.radiance = LightColor(state, params, "L", &light.spectrum);
  light.scale = params.Float("scale", 1, kNotNegative);
  light.power = Target(params, "power");
  if (light.power <= 0) light.power = -1;
  light.two_sided = params.Bool("twosided", false);
  if (ReadEmissionImage(state, params, &light)) light.radiance = kWhite;
  params.CheckAllUsed();
  CheckEmission(params, light.radiance * light.scale);
  state.scene.area_lights.push_back(light);
  return static_cast<Index>(state.scene.area_lights.size()) - 1;
}

}  // namespace lanelight

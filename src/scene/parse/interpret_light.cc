// Lights. All scales of the file become part of the emission (formulas: pbrt-v4).
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

// Colour of a light; by default the illuminant of the color space.
Rgb LightColor(ParseState& state, ParamSet& params, const char* name,
               OwnSpectrum* spectrum, SpectrumUse use = SpectrumUse::kIlluminant) {
  const Rgb absent = ToSrgb(state.graphics.color_space, kWhite, use);
  const Rgb color = PlainColor(state, params, name, absent, use);
  const Param* value_param = params.Find(name, {});
  if (value_param != nullptr) *spectrum = SpectrumOf(state, params, *value_param, use);
  return color;
}

// 1 - cos, without cancellation for small angles.
double Versine(double degrees) {
  const double sine = std::sin(degrees * (kPi / 360));
  return 2 * sine * sine;
}

// A target such as "power"; 0 or less means not given, as in pbrt-v4.
double Target(ParamSet& params, const char* name) {
  return params.Float(name, -1, Limits());
}

void ReadDirection(ParamSet& params, Light* light) {
  light->from = params.Point3("from", {0, 0, 0});
  light->to = params.Point3("to", {0, 0, 1});
  const double length = LargestComponent(light->to - light->from);
  if (!(length > 0) || !std::isfinite(length)) {
    throw InputError(
        params.where(),
        params.object() + " has no direction: \"from\" and \"to\" are the same point");
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
    throw InputError(
        params.where(),
        "conedeltaangle {} of the spot light is more than twice its coneangle {}",
        light->cone_delta, light->cone_angle);
  }
  if (light->cone_delta > light->cone_angle) {
    light->cone_delta = light->cone_angle - begins;
    state.AddWarning(params.where(),
                     "conedeltaangle of the spot light is larger than its coneangle; {} "
                     "is used, as in pbrt-v4",
                     light->cone_delta);
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

// The corners are in world space and ignore the light's transform.
void ReadPortal(ParamSet& params, Light* light) {
  const Param* portal = params.Find("portal", {ParamType::kPoint3});
  if (portal == nullptr) return;
  light->portal = Triples(*portal);
  if (light->portal.size() != 4) {
    params.Fail(*portal, "{} numbers; it takes four points", portal->numbers.size());
  }
}

// Radiance of a sky without an image; its illuminance is pi times that. With a portal,
// pbrt-v4 makes an image of one pixel from the spectrum, without normalising it, and
// computes its illuminance as if all light came from the zenith.
Rgb ConstantSky(ParseState& state, ParamSet& params, Light* light) {
  const bool portal = !light->portal.empty();
  const double illuminance = Target(params, "illuminance");
  const SpectrumUse use = portal ? SpectrumUse::kRadiance : SpectrumUse::kIlluminant;
  const Rgb radiance = LightColor(state, params, "L", &light->spectrum, use);
  if (!(illuminance > 0) || radiance == Rgb{}) return radiance;
  return radiance * (illuminance / (portal ? 2 * kPi * Luminance(radiance) : kPi));
}

// Reads the image that a light can have instead of the colour L. False without one.
template <typename T>
bool ReadEmissionImage(ParseState& state, ParamSet& params, T* light) {
  const NamedFile file = FileOf(state, params, "filename");
  if (!file) return false;
  if (params.Has("L")) {
    params.Fail(*file.param, "\"filename\" and \"L\" exclude each other");
  }
  light->image_path = file.path;
  light->where = file.param->where;  // where a missing image is reported
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

// The image decides on the factor that gives the light its power.
void ReadImageLight(ParseState& state, ParamSet& params, Light* light) {
  light->power = Target(params, "power");
  const NamedFile file = RequireFile(state, params, "filename");
  light->where = file.param->where;  // where a missing image is reported
  light->image_path = file.path;
}

void ReadGoniometric(ParseState& state, ParamSet& params, Light* light) {
  light->emission = LightColor(state, params, "I", &light->spectrum) *
                    params.Float("scale", 1, kNotNegative);
  ReadImageLight(state, params, light);
}

void ReadProjection(ParseState& state, ParamSet& params, Light* light) {
  light->emission = kWhite * params.Float("scale", 1, kNotNegative);
  light->fov = params.Float("fov", 90, {1e-6, 179.999});
  ReadImageLight(state, params, light);
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
  if (std::isfinite(emission.x + emission.y + emission.z)) return;
  throw InputError(params.where(), "the emission of this light overflows");
}

}  // namespace

void InterpretLight(ParseState& state, const std::string& type, ParamSet& params) {
  const auto& [kind, read] = Lookup(kLights, type, params.where(), "light");
  Light light;
  light.kind = kind;
  light.where = params.where();
  light.world_from_light = state.graphics.ctm;
  NoteIgnoredMotion(state, light.where, "light");
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
  return Append(state.scene.area_lights, std::move(light));
}

}  // namespace lanelight

#include <fmt/format.h>

#include <algorithm>

#include "src/base/core/error.h"
#include "src/base/image/spectrum.h"
#include "src/scene/parse/interpret.h"

namespace lanelight {
namespace {

constexpr int kLongestSide = 4096;  // voxels

std::size_t ReadVoxels(ParamSet& params, Medium* medium) {
  static constexpr const char* kSides[] = {"nx", "ny", "nz"};
  std::size_t voxels = 1;
  for (int a = 0; a < 3; ++a) {
    medium->grid_size[a] = params.Integer(kSides[a], 1, {1, kLongestSide});
    voxels *= static_cast<std::size_t>(medium->grid_size[a]);
  }
  return voxels;
}

// Returns `count` numbers per voxel, none negative; null without the parameter.
const Param* Samples(ParamSet& params, std::string_view name, ParamType type,
                     std::size_t voxels, std::size_t count) {
  const Param* param = params.Find(name, {type});
  if (param == nullptr) return nullptr;
  if (param->numbers.size() != voxels * count) {
    params.Fail(*param, "{} values; nx * ny * nz voxels need {}",
                param->numbers.size() / count, voxels);
  }
  for (const double v : param->numbers) {
    if (v < 0) params.Fail(*param, "the value {} is negative", v);
  }
  return param;
}

// Returns one number for all voxels, or 1 after reading one for each. By default pbrt-v4
// has a grid of one voxel, outside of which the scale is 0: the scale is 1 at the centre
// of the box and falls linearly to 1/2 at each side.
double ReadEmissionScale(ParamSet& params, std::size_t voxels, Medium* medium) {
  const Param* param = params.Find("Lescale", {ParamType::kFloat});
  if (param == nullptr) {
    medium->emission_grid = {1};
    return 1;
  }
  if (param->numbers.size() == 1 && voxels > 1) {
    return params.Float("Lescale", 1, kNotNegative);
  }
  Samples(params, "Lescale", ParamType::kFloat, voxels, 1);
  medium->emission_grid.assign(param->numbers.begin(), param->numbers.end());
  return 1;
}

void ReadColors(const ParamSet& params, const Param& param, Medium* medium) {
  for (std::size_t i = 0; i < param.numbers.size(); i += 3) {
    Rgb color = {param.numbers[i], param.numbers[i + 1], param.numbers[i + 2]};
    try {
      color = ToSrgb(param.color_space, color, SpectrumUse::kIlluminant);
    } catch (const InputError& error) {
      params.Fail(param, WithoutPrefix(error));
    }
    for (int c = 0; c < 3; ++c) {
      medium->emission_grid.push_back(static_cast<float>(std::max(color[c], 0.0)));
    }
  }
}

}  // namespace

void ReadBox(ParamSet& params, Medium* medium) {
  medium->box_min = params.Point3("p0", {0, 0, 0});
  medium->box_max = params.Point3("p1", {1, 1, 1});
  const Vec3d size = medium->box_max - medium->box_min;
  if (!(size.x > 0 && size.y > 0 && size.z > 0)) {
    throw InputError(
        params.where(),
        params.object() +
            " has an empty box: every coordinate of \"p1\" must be above that of \"p0\"");
  }
}

void ReadSigmas(ParseState& state, ParamSet& params, double scale, Medium* medium) {
  const auto sigma = [&](const char* name) {
    return PlainColor(state, params, name, {1, 1, 1}, SpectrumUse::kUnbounded) * scale;
  };
  medium->sigma_a = sigma("sigma_a");
  medium->sigma_s = sigma("sigma_s");
}

void ReadEmission(ParseState& state, ParamSet& params, double scale, Medium* medium) {
  medium->emission =
      PlainColor(state, params, "Le", {0, 0, 0}, SpectrumUse::kIlluminant) * scale;
  const Param* value_param = params.Find("Le", {});
  if (value_param != nullptr)
    medium->emission_spectrum =
        SpectrumOf(state, params, *value_param, SpectrumUse::kIlluminant);
}

void ReadTemperatureScale(ParamSet& params, Medium* medium) {
  const double cutoff = params.Float("temperaturecutoff", 0);
  medium->temperature_offset = params.Float("temperatureoffset", cutoff);
  medium->temperature_scale = params.Float("temperaturescale", 1, kNotNegative);
}

void ReadUniformGrid(ParseState& state, ParamSet& params, Medium* medium) {
  const std::size_t voxels = ReadVoxels(params, medium);
  ReadBox(params, medium);
  const Param* density = Samples(params, "density", ParamType::kFloat, voxels, 1);
  if (density == nullptr) params.Need("density", ParamType::kFloat);
  medium->grid.assign(density->numbers.begin(), density->numbers.end());
  ReadSigmas(state, params, params.Float("scale", 1, kNotNegative), medium);
  ReadTemperatureScale(params, medium);
  const double scale = ReadEmissionScale(params, voxels, medium);
  ReadEmission(state, params, scale, medium);
  const Param* t = Samples(params, "temperature", ParamType::kFloat, voxels, 1);
  if (t == nullptr) return;
  if (params.Has("Le")) {
    params.Fail(*t, "\"temperature\" and \"Le\" exclude each other");
  }
  medium->temperature.assign(t->numbers.begin(), t->numbers.end());
  medium->emission = Rgb{1, 1, 1} * scale;
}

void ReadRgbGrid(ParseState&, ParamSet& params, Medium* medium) {
  const std::size_t voxels = ReadVoxels(params, medium);
  ReadBox(params, medium);
  const Param* a = Samples(params, "sigma_a", ParamType::kRgb, voxels, 3);
  const Param* s = Samples(params, "sigma_s", ParamType::kRgb, voxels, 3);
  if (a == nullptr && s == nullptr) {
    throw InputError(
        params.where(),
        params.object() + " has neither \"rgb sigma_a\" nor \"rgb sigma_s\"");
  }
  const double scale = params.Float("scale", 1, kNotNegative);
  const auto value = [&](const Param* of, std::size_t i) {
    return static_cast<float>(scale * (of == nullptr ? 1 : of->numbers[i]));
  };
  medium->grid.reserve(6 * voxels);
  for (std::size_t v = 0; v < voxels; ++v) {
    for (const Param* of : {a, s}) {
      for (std::size_t c = 0; c < 3; ++c) medium->grid.push_back(value(of, 3 * v + c));
    }
  }
  const double emission_scale = params.Float("Lescale", 1, kNotNegative);
  const Param* le = Samples(params, "Le", ParamType::kRgb, voxels, 3);
  if (le == nullptr) return;
  if (a == nullptr) params.Fail(*le, "\"Le\" needs \"rgb sigma_a\" beside it");
  ReadColors(params, *le, medium);
  // pbrt does not normalise these illuminants, unlike others.
  medium->emission = Rgb{1, 1, 1} * (emission_scale * kPhotometricIntegral);
}

}  // namespace lanelight

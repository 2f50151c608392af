#include "src/scene/parse/version3.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "src/base/core/source_location.h"
#include "src/base/core/suggest.h"

namespace lanelight {
namespace {

struct OldName {
  std::string_view kind, name;
};

// Source: the user manual of pbrt-v3, "pbrt-v3 Input File Format".
constexpr OldName kOldNames[] = {
    {"directive", "WorldEnd"},
    {"directive", "SurfaceIntegrator"},
    {"directive", "VolumeIntegrator"},
    {"directive", "Volume"},
    {"directive", "Renderer"},
    {"film", "image"},
    {"integrator", "directlighting"},
    {"integrator", "whitted"},
    {"material", "matte"},
    {"material", "plastic"},
    {"material", "uber"},
    {"material", "substrate"},
    {"material", "translucent"},
    {"material", "metal"},
    {"material", "glass"},
    {"material", "mirror"},
    {"material", "fourier"},
    {"material", "kdsubsurface"},
    {"material", "disney"},
    {"sampler", "02sequence"},
    {"sampler", "lowdiscrepancy"},
    {"sampler", "maxmindist"},
    {"sampler", "random"},
    {"parameter type", "color"},
    {"parameter type", "point"},
    {"parameter type", "vector"},
    {"parameter type", "xyz"},
};

}  // namespace

void CheckVersion3(const SourceLocation& where, std::string_view kind,
                   std::string_view name) {
  const bool old =
      std::any_of(std::begin(kOldNames), std::end(kOldNames),
                  [&](const OldName& o) { return o.kind == kind && o.name == name; });
  if (!old) return;
  throw InputError(
      where,
      fmt::format("{} {} is pbrt-v3 syntax: convert the file with `pbrt --upgrade`", kind,
                  Quoted(name)));
}

}  // namespace lanelight

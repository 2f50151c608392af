#include "src/scene/parse/names.h"

#include <utf8proc.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <memory>

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

std::string NormalizedName(std::string_view name) {
  if (std::all_of(name.begin(), name.end(), IsAscii)) return std::string(name);
  constexpr auto kComposed =
      static_cast<utf8proc_option_t>(UTF8PROC_STABLE | UTF8PROC_COMPOSE);
  utf8proc_uint8_t* result = nullptr;
  const utf8proc_ssize_t size =
      utf8proc_map(reinterpret_cast<const utf8proc_uint8_t*>(name.data()),
                   static_cast<utf8proc_ssize_t>(name.size()), &result, kComposed);
  const std::unique_ptr<utf8proc_uint8_t, decltype(&std::free)> owner(result, &std::free);
  if (size < 0) return std::string(name);
  return {reinterpret_cast<const char*>(result), static_cast<std::size_t>(size)};
}

void CheckVersion3(const SourceLocation& where, std::string_view kind,
                   std::string_view name) {
  const bool old =
      std::any_of(std::begin(kOldNames), std::end(kOldNames),
                  [&](const OldName& o) { return o.kind == kind && o.name == name; });
  if (!old) return;
  throw InputError(where,
                   "{} {} is pbrt-v3 syntax: convert the file with `pbrt --upgrade`",
                   kind, Quoted(name));
}

}  // namespace lanelight

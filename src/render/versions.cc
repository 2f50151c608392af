#include <OpenEXRConfig.h>

#include "kernels/simd/target.h"
#include "src/core/parallel.h"
#include "src/render/report.h"

namespace lanelight {
namespace {

std::string CompilerVersion() {
#ifdef __clang__
  return fmt::format("clang {}.{}.{}", __clang_major__, __clang_minor__,
                     __clang_patchlevel__);
#else
  return fmt::format("gcc {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#endif
}

}  // namespace

std::vector<std::pair<std::string, std::string>> LibraryVersions() {
  return {{"lanelight", LANELIGHT_VERSION},
          {"compiler", CompilerVersion()},
          {"highway", HighwayVersion()},
          {"onetbb", TbbVersion()},
          {"openexr", OPENEXR_VERSION_STRING},
          {"fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100,
                              FMT_VERSION % 100)},
          {"nlohmann_json",
           fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR,
                       NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)}};
}

}  // namespace lanelight

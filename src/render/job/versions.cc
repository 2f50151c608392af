#include <OpenEXRConfig.h>

#include "kernels/simd/target.h"
#include "src/base/core/parallel.h"
#include "src/base/core/version.h"
#include "src/render/job/report.h"

namespace lanelight {

std::vector<std::pair<std::string, std::string>> LibraryVersions() {
  return {{"lanelight", Version()},
          {"commit", Commit()},
          {"compiler", Compiler()},
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

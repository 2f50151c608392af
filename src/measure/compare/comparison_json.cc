#include <cmath>
#include <nlohmann/json.hpp>

#include "src/base/stat/values.h"
#include "src/measure/compare/comparison.h"

namespace lanelight {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FlipSummary, mean, first_quartile, median,
                                   third_quartile, max)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FlipExposures, start, stop, count)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ErrorTile, x, y, width, height, relmse, share)

namespace {

nlohmann::json FlipJson(const std::optional<FlipMaps>& flip) {
  if (!flip) return nullptr;
  nlohmann::json out = {{"pixels_per_degree", flip->pixels_per_degree},
                        {"ldr", flip->ldr_summary},
                        {"hdr", nullptr},
                        {"exposures", nullptr}};
  if (flip->hdr.empty()) return out;
  out["hdr"] = flip->hdr_summary;
  out["exposures"] = flip->exposures;
  return out;
}

nlohmann::json AgreementJson(const Agreement& a) {
  nlohmann::json tiles = TilesJson(a.layout, a.z);
  tiles["failed"] = a.failed;
  return {{"verdict", Name(a.verdict)},
          {"why", a.why},
          {"doubt", a.doubt},
          {"text", AgreementText(a)},
          {"p", NumberJson(a.p)},
          {"false_alarm", a.level},
          {"tests", a.tests},
          {"untested", a.untested},
          {"image_differs", a.image_failed},
          {"detectable", NumberJson(a.detectable)},
          {"tiles", tiles}};
}

}  // namespace

nlohmann::json ToJson(const ImageComparison& c) {
  nlohmann::json out = ToJson(c.metrics);
  out.update({{"test", c.test},
              {"reference", c.reference},
              {"verdict", c.verdict},
              {"agreement", AgreementJson(c.agreement)},
              {"flip", FlipJson(c.flip)},
              {"worst_tiles", c.worst}});
  return out;
}

}  // namespace lanelight

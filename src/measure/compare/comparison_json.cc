#include <cmath>
#include <nlohmann/json.hpp>

#include "src/base/stat/values.h"
#include "src/measure/compare/comparison.h"

namespace lanelight {
namespace {

nlohmann::json FlipJson(const FlipSummary& s) {
  return {{"mean", s.mean},
          {"first_quartile", s.first_quartile},
          {"median", s.median},
          {"third_quartile", s.third_quartile},
          {"max", s.max}};
}

nlohmann::json FlipJson(const std::optional<FlipMaps>& flip) {
  if (!flip) return nullptr;
  nlohmann::json out = {{"pixels_per_degree", flip->pixels_per_degree},
                        {"ldr", FlipJson(flip->ldr_summary)},
                        {"hdr", nullptr},
                        {"exposures", nullptr}};
  if (flip->hdr.empty()) return out;
  out["hdr"] = FlipJson(flip->hdr_summary);
  out["exposures"] = {{"start", flip->exposures.start},
                      {"stop", flip->exposures.stop},
                      {"count", flip->exposures.count}};
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

nlohmann::json WorstJson(const std::vector<ErrorTile>& tiles) {
  nlohmann::json out = nlohmann::json::array();
  for (const ErrorTile& t : tiles) {
    out.push_back({{"x", t.x},
                   {"y", t.y},
                   {"width", t.width},
                   {"height", t.height},
                   {"relmse", t.relmse},
                   {"share", t.share}});
  }
  return out;
}

}  // namespace

nlohmann::json ToJson(const ImageComparison& c) {
  nlohmann::json out = ToJson(c.metrics);
  out.update({{"test", c.test},
              {"reference", c.reference},
              {"verdict", c.verdict},
              {"agreement", AgreementJson(c.agreement)},
              {"flip", FlipJson(c.flip)},
              {"worst_tiles", WorstJson(c.worst)}});
  return out;
}

}  // namespace lanelight

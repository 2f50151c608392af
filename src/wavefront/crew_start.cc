#include "src/wavefront/crew_start.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <nlohmann/json.hpp>

namespace lanelight {
namespace {

using Json = nlohmann::json;

}  // namespace

// CBOR keeps every bit of a double, of infinities too.
std::string ToBytes(const CrewStart& start) {
  Json tiles = Json::array(), tables = Json::array();
  for (const PixelRect& t : start.tiles) tiles.push_back({t.x0, t.y0, t.x1, t.y1});
  for (const TrainedTable& t : start.tables) {
    tables.push_back({{"name", t.name}, {"values", t.values}});
  }
  const Json json = {{"tiles", tiles},
                     {"planned_samples", start.planned_samples},
                     {"restored", start.restored},
                     {"trained", start.trained},
                     {"changes", start.changes},
                     {"tables", tables}};
  std::string bytes;
  Json::to_cbor(json, bytes);
  return bytes;
}

CrewStart CrewStartFromBytes(const std::string& bytes) {
  const Json json = Json::from_cbor(bytes);
  CrewStart start;
  for (const Json& t : json.at("tiles")) {
    start.tiles.push_back(
        {t.at(0).get<int>(), t.at(1).get<int>(), t.at(2).get<int>(), t.at(3).get<int>()});
  }
  start.planned_samples = json.at("planned_samples");
  start.restored = json.at("restored");
  start.trained = json.at("trained");
  start.changes = json.at("changes");
  for (const Json& t : json.at("tables")) {
    start.tables.push_back({t.at("name"), "", t.at("values")});
  }
  return start;
}

std::string Fingerprint(const TrainingOutcome& training,
                        const std::vector<TrainedTable>& tables) {
  std::string text = fmt::format("changes '{}'", training.changes);
  for (const TrainedTable& t : tables) {
    const auto hash = XXH3_64bits(t.values.data(), t.values.size() * sizeof(double));
    text += fmt::format("; {} {:016x}", t.name, hash);
  }
  return text;
}

}  // namespace lanelight

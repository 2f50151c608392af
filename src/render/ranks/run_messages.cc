#include "src/render/ranks/run_messages.h"

#include <nlohmann/json.hpp>

namespace lanelight {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PixelRect, x0, y0, x1, y1)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(TrainedTable, name, values)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RunStart, tiles, have_samples, planned_training)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RunTraining, trained, changes, tables)

namespace {

// CBOR keeps every bit of a double, of infinities too.
std::string Cbor(const nlohmann::json& json) {
  std::string bytes;
  nlohmann::json::to_cbor(json, bytes);
  return bytes;
}

}  // namespace

std::string ToBytes(const RunStart& start) { return Cbor(start); }

std::string ToBytes(const RunTraining& training) { return Cbor(training); }

RunStart RunStartFromBytes(const std::string& bytes) {
  return nlohmann::json::from_cbor(bytes);
}

RunTraining RunTrainingFromBytes(const std::string& bytes) {
  return nlohmann::json::from_cbor(bytes);
}

}  // namespace lanelight

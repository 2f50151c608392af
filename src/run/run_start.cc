#include "src/run/run_start.h"

#include <nlohmann/json.hpp>

namespace lanelight {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PixelRect, x0, y0, x1, y1)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(TrainedTable, name, values)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RunStart, tiles, have_samples, trained, changes,
                                   tables)

// CBOR keeps every bit of a double, of infinities too.
std::string ToBytes(const RunStart& start) {
  std::string bytes;
  nlohmann::json::to_cbor(nlohmann::json(start), bytes);
  return bytes;
}

RunStart RunStartFromBytes(const std::string& bytes) {
  return nlohmann::json::from_cbor(bytes);
}

}  // namespace lanelight

#include "src/measure/study/measurement.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "src/base/stat/values.h"
#include "src/render/job/machine_json.h"

namespace lanelight {
namespace {

nlohmann::json Value(std::uint64_t v) { return v; }
nlohmann::json Value(double v) { return NumberJson(v); }

std::string Text(std::uint64_t v) { return std::to_string(v); }
std::string Text(double v) { return std::isfinite(v) ? fmt::format("{}", v) : ""; }

template <class T>
void Read(const nlohmann::json& json, const char* name, T& value) {
  const auto found = json.find(name);
  if (found != json.end() && !found->is_null()) value = found->get<T>();
}

}  // namespace

nlohmann::json ToJson(const Measurement& m) {
  nlohmann::json out;
#define X(type, name) out[#name] = Value(m.name);
  LANELIGHT_MEASUREMENT(X)
#undef X
  out["machine"] = ToJson(m.machine);
  return out;
}

Measurement MeasurementFromJson(const nlohmann::json& json) {
  Measurement m;
  m.machine = MachineFromJson(json.value("machine", nlohmann::json()));
#define X(type, name) Read(json, #name, m.name);
  LANELIGHT_MEASUREMENT(X)
#undef X
  return m;
}

std::string CsvHeader() {
  std::string text;
#define X(type, name) text += (text.empty() ? "" : ",") + std::string(#name);
  LANELIGHT_MEASUREMENT(X)
#undef X
  return text;
}

std::string CsvRow(const Measurement& m) {
  std::string text;
  bool first = true;
#define X(type, name) text += (std::exchange(first, false) ? "" : ",") + Text(m.name);
  LANELIGHT_MEASUREMENT(X)
#undef X
  return text;
}

}  // namespace lanelight

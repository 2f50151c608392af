#include "src/measure/stress/stress_json.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "src/base/core/error.h"
#include "src/base/core/json_text.h"
#include "src/base/core/parallel.h"
#include "src/base/core/version.h"
#include "src/base/image/atomic_file.h"
#include "src/base/stat/values.h"
#include "src/measure/report/page.h"
#include "src/measure/stress/efficiency.h"
#include "src/render/job/machine_json.h"

namespace lanelight::stress {
namespace {

using Json = nlohmann::json;

Json VerdictJson(const PointVerdict& v) {
  return {{"good", v.good()},
          {"fault", Name(v.fault)},
          {"why", v.why},
          {"z", NumberJson(v.z)},
          {"allowance", NumberJson(v.allowance)},
          {"detectable", NumberJson(v.detectable)},
          {"weak", v.weak}};
}

Json PointJson(const JudgedPoint& judged) {
  const Point& p = judged.point;
  return {{"target", judged.target},
          {"parameter", NumberJson(p.parameter)},
          {"series", p.series},
          {"promised", judged.promised},
          {"expected", NumberJson(p.expected)},
          {"measured", NumberJson(p.measured)},
          {"standard_error", NumberJson(p.standard_error)},
          {"degrees_of_freedom", NumberJson(p.degrees_of_freedom)},
          {"tolerance", NumberJson(p.tolerance)},
          {"scale", NumberJson(ScaleOf(p))},
          {"invalid", p.invalid},
          {"samples", p.samples},
          {"rays", p.rays},
          {"lanes_used", p.lanes_used},
          {"lane_slots", p.lane_slots},
          {"seconds", NumberJson(p.seconds)},
          {"total_seconds", NumberJson(judged.total_seconds)},
          {"refused", p.refused},
          {"not_measured", p.not_measured},
          {"crash", judged.crash},
          {"verdict", VerdictJson(judged.verdict)}};
}

Json PointsJson(const CaseResult& result, bool strategies) {
  Json points = Json::array();
  for (const JudgedPoint& judged : result.points) {
    Json point = PointJson(judged);
    if (strategies) {
      point["efficiency"] = IntervalJson(RelativeEfficiency(result, judged));
    }
    points.push_back(std::move(point));
  }
  return points;
}

Json AxisJson(const Axis& axis) {
  return {{"name", axis.name},
          {"unit", axis.unit},
          {"logarithmic", axis.logarithmic},
          {"promised_low", NumberJson(axis.promised_low)},
          {"promised_high", NumberJson(axis.promised_high)}};
}

Json BreakJson(const BreakPlace& place) {
  return {{"target", place.target},     {"series", place.series},
          {"above", place.above},       {"parameter", NumberJson(place.parameter)},
          {"fault", Name(place.fault)}, {"why", place.why}};
}

Json CaseJson(const CaseResult& result) {
  const Case& about = result.about;
  const bool strategies = ComparesStrategies(result);
  Json json = {{"name", about.name},
               {"group", about.group},
               {"extreme", about.extreme},
               {"must", about.must},
               {"source", about.source},
               {"truth", Name(about.truth)},
               {"axis", AxisJson(about.axis)},
               {"outcome", Name(result.outcome)},
               {"why", result.why},
               {"promised", result.promised},
               {"failed", result.failed},
               {"weak", result.weak},
               {"not_measured", result.not_measured},
               {"detectable", NumberJson(result.detectable)},
               {"worst", result.worst < 0 ? Json() : Json(result.worst)},
               {"strategies", strategies},
               {"baseline", strategies ? Json(BaselineOf(result)) : Json()},
               {"breaks", Json::array()},
               {"points", PointsJson(result, strategies)}};
  for (const BreakPlace& place : result.breaks) {
    json["breaks"].push_back(BreakJson(place));
  }
  return json;
}

}  // namespace

Json ToJson(const SuiteResult& result) {
  const SuiteOptions& options = result.options;
  Json json = {{"schema", 2},
               {"kind", "lanelight-stress"},
               {"version", FullVersion()},
               {"machine", lanelight::ToJson(result.machine)},
               {"settings",
                {{"full", options.effort.full},
                 {"seed", options.effort.seed},
                 {"targets", options.targets},
                 {"threads", ThreadCount(options.threads)}}},
               {"false_alarm", options.false_alarm},
               {"level", result.level},
               {"power", kPower},
               {"weak_from", kWeakFrom},
               {"promised", result.promised},
               {"interrupted", result.interrupted},
               {"seconds", result.seconds},
               {"cpu_seconds", result.cpu_seconds},
               {"sentence", Sentence(result)},
               {"outcomes", Json::object()},
               {"cases", Json::array()}};
  for (const Outcome outcome :
       {Outcome::kGood, Outcome::kWeak, Outcome::kFailed, Outcome::kUnfinished}) {
    json["outcomes"][Name(outcome)] = result.Count(outcome);
  }
  for (const CaseResult& one : result.cases) json["cases"].push_back(CaseJson(one));
  return json;
}

void MakeResultsFolder(const std::string& dir) {
  std::error_code error;
  std::filesystem::create_directories(dir, error);
  if (error) throw InputError(dir + ": cannot create the directory: " + error.message());
  if (access(dir.c_str(), W_OK) == 0) return;
  throw InputError(dir + ": cannot write to the directory: " + std::strerror(errno));
}

void WriteResults(const SuiteResult& result, const std::string& dir) {
  MakeResultsFolder(dir);
  const Json json = ToJson(result);
  WriteFileAtomically(dir + "/stress.json", DumpJson(json, 1) + "\n");
  WriteFileAtomically(dir + "/report.html", ReportPage(PageKind::kStress, json));
}

}  // namespace lanelight::stress

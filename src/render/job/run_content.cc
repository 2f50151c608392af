#include "src/render/job/checkpoint.h"

#include "src/base/core/json_text.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;

// Calls with_member(name, member) for each number of a report; Counts may be const.
template <class Counts, class Do>
void ForEachCount(Counts& counts, const Do& with_member) {
  with_member("samples", counts.samples);
  with_member("rays_closest", counts.rays_closest);
  with_member("rays_shadow", counts.rays_shadow);
  with_member("nan", counts.health.nan);
  with_member("infinite", counts.health.infinite);
  with_member("negative", counts.health.negative);
  with_member("seconds", counts.seconds);
  with_member("cpu_seconds", counts.cpu_seconds);
}

template <class Training, class Do>
void ForEachOutcome(Training& training, const Do& with_member) {
  with_member("note", training.note);
  with_member("samples", training.samples);
  with_member("rays", training.rays);
  with_member("seconds", training.seconds);
  with_member("cpu_seconds", training.cpu_seconds);
  with_member("changes", training.changes);
}

auto To(Json& json) {
  return [&json](const char* name, const auto& value) { json[name] = value; };
}
auto From(const Json& json) {
  return [&json](const char* name, auto& value) { json.at(name).get_to(value); };
}

Json TrainingJson(const RunRecord& run) {
  if (!run.trained) return nullptr;
  Json json = {{"tables", Json::object()}};
  ForEachOutcome(run.training, To(json));
  json["gain"] = run.training.gain;
  json["filtered_gain"] = run.training.filtered_gain;
  for (const TrainedTable& table : run.tables) json["tables"][table.name] = table.meaning;
  return json;
}

}  // namespace

StateContent ContentOf(const Json& identity, Json about, Films& films,
                       const RunRecord& run) {
  StateContent content;
  content.identity = DumpJson(identity, 1);
  ForEachCount(run.counts, To(about["counts"]));
  about["training"] = TrainingJson(run);
  content.report = DumpJson(about, 1);
  for (const MutableStateColumn& column : films.Columns()) {
    content.pixels.push_back(column);
  }
  for (const MutableStateColumn& column : films.film().SharedColumns()) {
    content.tables.push_back(column);
  }
  for (const TrainedTable& table : run.tables) {
    content.tables.push_back(
        MakeStateColumn<double>(table.name, table.meaning, table.values));
  }
  return content;
}

RunRecord ReadRecord(const StateFile& file, const Json& report) {
  RunRecord run;
  ForEachCount(run.counts, From(report.at("counts")));
  const Json& training = report.at("training");
  run.trained = !training.is_null();
  if (!run.trained) return run;
  ForEachOutcome(run.training, From(training));
  // States of earlier programs do not have these.
  run.training.gain = training.value("gain", 0.0);
  run.training.filtered_gain = training.value("filtered_gain", 0.0);
  for (const auto& [name, meaning] : training.at("tables").items()) {
    TrainedTable table = {name, meaning, std::vector<double>(file.TableRows(name))};
    file.ReadTable(MakeStateColumn<double>(name, meaning, table.values));
    run.tables.push_back(std::move(table));
  }
  return run;
}

}  // namespace lanelight

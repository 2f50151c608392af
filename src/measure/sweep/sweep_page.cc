// sweep.json, and what the page of a sweep and `lanelight plot` show.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "src/base/image/exr.h"
#include "src/measure/compare/linear_image.h"
#include "src/measure/report/page.h"
#include "src/measure/sweep/results.h"
#include "src/measure/sweep/sweep_folder.h"
#include "src/render/job/machine_json.h"
#include "src/scene/description/scene_names.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;

bool AreNumbers(const std::vector<std::string>& values) {
  return std::ranges::all_of(values, [](const std::string& text) {
    char* end = nullptr;
    const double x = std::strtod(text.c_str(), &end);
    return !text.empty() && *end == '\0' && std::isfinite(x);
  });
}

// Lists values in the order of the grid.
Json AxisJson(const std::vector<CellGroup>& groups, const std::string& name) {
  std::vector<std::string> values;
  std::set<std::string> seen;
  bool unset = false;
  for (const CellGroup& group : groups) {
    const auto value = group.values.find(name);
    unset |= value == group.values.end();
    if (value == group.values.end() || !seen.insert(value->second).second) continue;
    values.push_back(value->second);
  }
  const std::optional<Axis> axis = AxisOfKey(name);
  return {{"name", name},       {"title", axis ? Title(*axis) : name},
          {"parameter", !axis}, {"numeric", axis != Axis::kScene && AreNumbers(values)},
          {"values", values},   {"unset", unset}};
}

// Lists axes of the grid but the seed, with open parts of strategies before amounts.
Json AxesJson(const Sweep& sweep, const std::vector<CellGroup>& groups) {
  std::vector<std::string> names;
  for (const Axis axis : sweep.UsedAxes()) {
    if (axis != Axis::kSeed) names.push_back(Key(axis));
    if (axis != Axis::kStrategy) continue;
    for (const CellGroup& group : groups) {
      for (const auto& [name, unused] : group.values) {
        if (AxisOfKey(name)) continue;
        if (std::ranges::find(names, name) == names.end()) {
          names.push_back(name);
        }
      }
    }
  }
  Json axes = Json::array();
  for (const std::string& name : names) axes.push_back(AxisJson(groups, name));
  return axes;
}

Json MachinesJson(const std::vector<Json>& cells) {
  std::vector<MachineInfo> machines;
  for (const Json& cell : cells) {
    if (cell.at("status") != Name(CellState::kDone)) continue;
    AddMachine(MachineFromJson(cell.at("machine")), machines);
  }
  return ToJson(machines);
}

// Rounds stages to four digits and omits their names.
Json PageCell(const Json& cell, const std::vector<std::string>& stage_names) {
  Json json = {{"name", cell.at("name")},       {"status", cell.at("status")},
               {"message", cell.at("message")}, {"values", cell.at("values")},
               {"measured", Json::object()},    {"stages", Json::array()}};
  for (const auto& [name, value] : cell.at("measured").items()) {
    if (IsOnPage(name)) json["measured"][name] = value;
  }
  for (const std::string& name : stage_names) {
    const auto stage = cell.at("stages").find(name);
    if (stage == cell.at("stages").end()) {
      json["stages"].push_back(nullptr);
    } else {
      const double seconds = stage->get<double>();
      json["stages"].push_back(std::stod(fmt::format("{:.4g}", seconds)));
    }
  }
  return json;
}

// A member of all cells: numbers, or indices of texts.
class CellColumn {
 public:
  void Set(std::size_t cell, const Json& value) {
    if (value.is_null()) return;
    while (at_.size() < cell) at_.push_back(nullptr);
    if (value.is_string()) {
      const auto [entry, is_new] = index_.try_emplace(value, texts_.size());
      if (is_new) texts_.push_back(value);
      at_.push_back(entry->second);
    } else if (value.is_number_float()) {
      at_.push_back(std::stod(fmt::format("{:.6g}", value.get<double>())));
    } else {
      at_.push_back(value);
    }
  }

  Json Packed() const {
    return index_.empty() ? Json({{"at", at_}}) : Json({{"at", at_}, {"texts", texts_}});
  }

 private:
  std::map<std::string, std::size_t> index_;
  Json texts_ = Json::array(), at_ = Json::array();  // null: unknown
};

using CellColumns = std::map<std::string, CellColumn>;

void SetAll(std::size_t cell, const Json& members, CellColumns& columns) {
  if (members.is_array()) {
    for (std::size_t i = 0; i < members.size(); ++i) {
      columns[std::to_string(i)].Set(cell, members[i]);
    }
    return;
  }
  for (const auto& [name, value] : members.items()) columns[name].Set(cell, value);
}

Json PackedJson(const CellColumns& columns) {
  Json json = Json::object();
  for (const auto& [name, column] : columns) json[name] = column.Packed();
  return json;
}

constexpr std::size_t kMaxThumbnails = 1000;
constexpr std::size_t kValuesOfOne = 3 * 160 * 90, kValuesOfAll = 3'000'000;

ReportImage ThumbnailOf(const std::string& name, const std::string& path) {
  const LinearImage image = LinearOf(ReadExr(path));
  std::vector<ReportImage> one = {
      {name, image.width, image.height, 3, image.Interleaved()}};
  ShrinkImages(one, kValuesOfOne);
  return std::move(one[0]);
}

}  // namespace

std::map<std::string, std::string> NamesOfScenes(const Sweep& sweep) {
  std::vector<std::string> texts, paths;
  std::set<std::string> seen;
  for (const SweepCell& cell : sweep.cells) {
    const std::string& text = *Get(cell.values, Axis::kScene);
    if (!seen.insert(text).second) continue;
    texts.push_back(text);
    paths.push_back(sweep.ScenePath(cell));
  }
  const std::vector<std::string> names = SceneNames(paths);
  std::map<std::string, std::string> result;
  for (std::size_t i = 0; i < texts.size(); ++i) result[texts[i]] = names[i];
  return result;
}

Json SweepJson(const Sweep& sweep, const std::vector<Json>& cells,
               const std::vector<CellGroup>& groups) {
  const std::vector<std::string> stages = StageNames(cells);
  const std::map<std::string, std::string> scenes = NamesOfScenes(sweep);
  const std::string baseline = BaselineOf(sweep);
  Json page_cells = Json::array();
  std::set<std::string> seeds;
  for (const Json& cell : cells) {
    page_cells.push_back(PageCell(cell, stages));
    Json& values = page_cells.back()["values"];
    values["scene"] = scenes.at(values["scene"]);
    // Cells without a value are of no further seed.
    if (const auto seed = values.find(Key(Axis::kSeed)); seed != values.end()) {
      seeds.insert(seed->get<std::string>());
    }
  }
  return {{"schema", 2},
          {"kind", "lanelight-sweep"},
          {"file", std::filesystem::path(sweep.path).filename().string()},
          {"settings", sweep.settings.texts},
          {"excluded", sweep.excluded},
          {"axes", AxesJson(sweep, groups)},
          {"seeds", std::max<std::size_t>(1, seeds.size())},
          {"baseline", baseline.empty() ? Json() : Json(baseline)},
          {"stages", stages},
          {"machines", MachinesJson(cells)},
          {"groups", GroupsJson(groups, cells, baseline)},
          {"leaders", LeadersJson(groups, cells, baseline)},
          {"cells", page_cells}};
}

Json PageJson(Json sweep_json) {
  constexpr const char* kParts[] = {"values", "measured", "stages"};
  std::map<std::string, CellColumns> parts;
  CellColumns own;
  Json names = Json::array();
  for (const Json& cell : sweep_json.at("cells")) {
    for (const char* part : kParts) SetAll(names.size(), cell.at(part), parts[part]);
    own["status"].Set(names.size(), cell.at("status"));
    own["message"].Set(names.size(), cell.at("message"));
    names.push_back(cell.at("name"));
  }
  Json packed = {{"names", std::move(names)}, {"own", PackedJson(own)}};
  for (const char* part : kParts) packed[part] = PackedJson(parts[part]);
  sweep_json.erase("cells");
  sweep_json["packed"] = std::move(packed);
  return sweep_json;
}

std::vector<ReportImage> Thumbnails(const Sweep& sweep, const SweepFolder& folder,
                                    const std::vector<CellGroup>& groups) {
  std::vector<ReportImage> images;
  std::set<std::size_t> shown;
  for (const CellGroup& group : groups) {
    if (images.size() == kMaxThumbnails) break;
    if (group.cells.empty() || !shown.insert(group.cells[0]).second) continue;
    const SweepCell& cell = sweep.cells[group.cells[0]];
    try {
      images.push_back(ThumbnailOf(cell.name, folder.File(cell, "image.exr")));
    } catch (const InputError&) {  // the page says that it is missing
    }
  }
  ShrinkImages(images, kValuesOfAll);
  return images;
}

}  // namespace lanelight

#include "src/measure/sweep/sweep_file.h"

#include <algorithm>
#include <filesystem>

#include "src/base/core/input_file.h"
#include "src/base/core/source_location.h"
#include "src/base/core/suggest.h"
#include "src/measure/sweep/toml_values.h"
#include "src/vocabulary/strategy/strategy_text.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

// Returns whether two values are equal. Different names of one strategy are equal;
// "scene" depends on the scene.
bool IsSameValue(Axis axis, const std::string& a, const std::string& b) {
  if (a == b) return true;
  if (axis != Axis::kStrategy || a == kSceneStrategyName || b == kSceneStrategyName) {
    return false;
  }
  return StrategyNamed(a, {}, {}) == StrategyNamed(b, {}, {});
}

// Adds the place of a strategy of a pattern to an equal strategy listed before the
// pattern. Returns false for other duplicates, which are errors.
bool IsJoined(const GridValue& added, GridValue& known) {
  const auto begin = [](const SourceLocation& w) { return std::pair(w.line, w.column); };
  if (added.places.empty() || added.places[0].parameters.empty()) return false;
  if (begin(added.where) == begin(known.where)) return false;
  known.places.push_back(added.places[0]);
  return true;
}

void AddValue(const std::string& name, GridValue value, std::vector<GridValue>& values) {
  const Axis axis = *SweepAxisOf(name);
  value.text = CanonicalValue(name, value.text, value.where);
  for (GridValue& other : values) {
    if (!IsSameValue(axis, other.text, value.text)) continue;
    if (IsJoined(value, other)) return;
    throw InputError(value.where, "{} {} is a duplicate: it equals {} in line {}",
                     Name(axis), Quoted(value.text), Quoted(other.text),
                     other.where.line);
  }
  values.push_back(std::move(value));
}

void AddValues(const TomlFile& file, const std::string& name, const toml::node& node,
               std::vector<GridValue>& values) {
  const SourceLocation where = file.Where(node);
  const std::string text = file.Value(name, AxisFormOf(name), node);
  if (SweepAxisOf(name) != Axis::kStrategy) return AddValue(name, {text, where}, values);
  for (const PatternStrategy& strategy : ExpandStrategy(text, where)) {
    AddValue(name, {strategy.text, where, {strategy.place}}, values);
  }
}

std::vector<GridValue> ReadValues(const TomlFile& file, const std::string& name,
                                  const toml::node& node) {
  std::vector<GridValue> values;
  const toml::array* array = node.as_array();
  if (array == nullptr) {
    AddValues(file, name, node, values);
    return values;
  }
  if (array->empty()) {
    throw InputError(file.Where(node),
                     "{} has no values; remove the line to use the value of "
                     "the scene",
                     name);
  }
  for (const toml::node& item : *array) AddValues(file, name, item, values);
  return values;
}

SubGrid ReadSubGrid(const TomlFile& file, const toml::table& table) {
  SubGrid grid = {file.Where(table), {}};
  for (const auto& [key, node] : table) {
    const std::optional<Axis> axis = SweepAxisOf(std::string(key.str()));
    if (!axis) ThrowUnknown(file.Where(key.source()), "axis", key.str(), AxisNames());
    if (grid.axes.count(*axis) > 0) {
      throw InputError(file.Where(key.source()),
                       "{} and {} set the same axis; remove one of them", key.str(),
                       Name(*axis));
    }
    grid.axes[*axis] = ReadValues(file, std::string(key.str()), node);
  }
  return grid;
}

// Throws InputError unless the grid has scenes and either samples or a time.
void CheckRenderable(const SubGrid& grid, const fs::path& folder) {
  const auto scenes = grid.axes.find(Axis::kScene);
  if (scenes == grid.axes.end()) {
    throw InputError(grid.where,
                     "the grid has no scene; add a line such as scene = \"box.pbrt\"");
  }
  for (const GridValue& scene : scenes->second) {
    const fs::path path = folder / scene.text;
    std::error_code error;
    if (fs::is_regular_file(path, error)) continue;
    throw InputError(scene.where,
                     "scene file '{}' does not exist (names are relative to "
                     "the sweep file)",
                     path.string());
  }
  const bool target =
      grid.axes.count(Axis::kTargetRelmse) > 0 || grid.axes.count(Axis::kTargetRmse) > 0;
  const auto time = grid.axes.find(Axis::kTime);
  if (target || time == grid.axes.end() || grid.axes.count(Axis::kSpp) == 0) return;
  throw InputError(time->second.front().where,
                   "time excludes spp, except as limits of target-relmse or "
                   "target-rmse; use [[include]] for cells of the other kind");
}

std::vector<SubGrid> ReadTables(const TomlFile& file, const std::string& key,
                                const toml::node& node) {
  std::vector<SubGrid> grids;
  for (const toml::table* table : file.Tables(key, node)) {
    grids.push_back(ReadSubGrid(file, *table));
  }
  return grids;
}

// Returns the setting with this key in [settings].
const Setting& SettingOf(const std::string& key, const SourceLocation& where) {
  if (SweepAxisOf(key)) {
    throw InputError(where,
                     "{} is an axis: put it into [grid], with one "
                     "value if it is the same for all cells",
                     key);
  }
  std::vector<std::string> known;
  for (const Setting& setting : SettingList()) {
    if (!setting.Is(kSweepKey)) continue;
    if (key == setting.name) return setting;
    known.push_back(setting.name);
  }
  ThrowUnknown(where, "setting", key, known);
}

SweepSettings ReadSweepSettings(const TomlFile& file, const toml::table& table) {
  SweepSettings settings;
  for (const auto& [toml_key, node] : table) {
    const std::string key(toml_key.str());
    const Setting& setting = SettingOf(key, file.Where(toml_key.source()));
    const std::string text = file.Value(key, setting.form, node);
    ReadAt(file.Where(node), key, [&] { setting.read(settings.render, text); });
    settings.texts[key] = *setting.text(settings.render);
  }
  return settings;
}

}  // namespace

Sweep ParseSweep(const std::string& path, const std::string& text) {
  const TomlFile file(path, text);
  Sweep sweep = {path, text, {}, {}, {}, 0};
  std::vector<SubGrid> grids, exclude;
  for (const auto& [toml_key, node] : file.root()) {
    const std::string key(toml_key.str());
    if (key == "grid") {
      grids.insert(grids.begin(), ReadSubGrid(file, file.Table(key, node)));
    } else if (key == "include") {
      for (SubGrid& grid : ReadTables(file, key, node)) grids.push_back(std::move(grid));
    } else if (key == "exclude") {
      exclude = ReadTables(file, key, node);
    } else if (key == "settings") {
      sweep.settings = ReadSweepSettings(file, file.Table(key, node));
    } else if (SweepAxisOf(key)) {
      throw InputError(file.Where(toml_key.source()),
                       "{} is an axis: it belongs below [grid]", key);
    } else {
      ThrowUnknown(file.Where(toml_key.source()), "table", key,
                   {"grid", "include", "exclude", "settings"});
    }
  }
  if (!file.root().contains("grid")) {
    throw InputError({std::make_shared<const std::string>(path), 1, 1},
                     "the file has no [grid], the table of axes and their values");
  }
  for (const SubGrid& grid : grids) {
    CheckRenderable(grid, fs::path(path).parent_path());
  }
  sweep.places = PlacesOf(grids);
  sweep.cells = ExpandGrid(grids, exclude);
  sweep.excluded = ExpandGrid(grids, {}).size() - sweep.cells.size();
  return sweep;
}

Sweep ReadSweep(const std::string& path) { return ParseSweep(path, ReadWholeFile(path)); }

}  // namespace lanelight

#include "src/measure/sweep/sweep_file.h"

#include <algorithm>
#include <filesystem>

#include "src/base/core/input_file.h"
#include "src/base/core/source_location.h"
#include "src/base/core/suggest.h"
#include "src/measure/sweep/sweep_settings.h"
#include "src/measure/sweep/toml_values.h"
#include "src/vocabulary/strategy/strategy_text.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

// Two names of one strategy would be rendered twice. What "scene" is depends on the
// scene.
bool Same(Axis axis, const std::string& a, const std::string& b) {
  if (a == b) return true;
  if (axis != Axis::kStrategy || a == kSceneStrategyName || b == kSceneStrategyName) {
    return false;
  }
  return StrategyNamed(a, {}, {}) == StrategyNamed(b, {}, {});
}

// What the file says there before a pattern is taken as the pattern's too; anything else
// that is said twice is a mistake.
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
    if (!Same(axis, other.text, value.text)) continue;
    if (IsJoined(value, other)) return;
    throw InputError(
        value.where,
        fmt::format("{} {} is there twice: it is the same as {}, line {}", Name(axis),
                    Quoted(value.text), Quoted(other.text), other.where.line));
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
                     fmt::format("{} has no values; leave the line out if the scene is "
                                 "to decide",
                                 name));
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
                       fmt::format("{} and {} are one thing: leave one of them out",
                                   key.str(), Name(*axis)));
    }
    grid.axes[*axis] = ReadValues(file, std::string(key.str()), node);
  }
  return grid;
}

// A grid whose cells can be rendered: it has scenes, and one thing says how much.
void CheckRenderable(const SubGrid& grid, const fs::path& folder) {
  const auto scenes = grid.axes.find(Axis::kScene);
  if (scenes == grid.axes.end()) {
    throw InputError(grid.where,
                     "no scene is given; add a line such as scene = \"box.pbrt\"");
  }
  for (const GridValue& scene : scenes->second) {
    const fs::path path = folder / scene.text;
    std::error_code error;
    if (fs::is_regular_file(path, error)) continue;
    throw InputError(scene.where,
                     fmt::format("there is no scene file '{}' (names are relative to "
                                 "the sweep file)",
                                 path.string()));
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

// Of the strategies of all grids, each place once.
std::map<std::string, std::vector<StrategyPlace>> PlacesOf(
    const std::vector<SubGrid>& grids) {
  std::map<std::string, std::vector<StrategyPlace>> places;
  for (const SubGrid& grid : grids) {
    const auto strategies = grid.axes.find(Axis::kStrategy);
    if (strategies == grid.axes.end()) continue;
    for (const GridValue& strategy : strategies->second) {
      std::vector<StrategyPlace>& known = places[strategy.text];
      for (const StrategyPlace& place : strategy.places) {
        if (std::find(known.begin(), known.end(), place) == known.end()) {
          known.push_back(place);
        }
      }
    }
  }
  return places;
}

std::size_t CountAll(const std::vector<SubGrid>& grids) {
  return ExpandGrid(grids, {}).size();
}

}  // namespace

std::string Sweep::ScenePath(const SweepCell& cell) const {
  return (fs::path(path).parent_path() / *Get(cell.values, Axis::kScene)).string();
}

std::vector<Axis> Sweep::UsedAxes() const {
  std::vector<Axis> used;
  for (int i = 0; i < kNumAxes; ++i) {
    const auto axis = static_cast<Axis>(i);
    if (std::any_of(cells.begin(), cells.end(), [&](const SweepCell& c) {
          return Get(c.values, axis).has_value();
        })) {
      used.push_back(axis);
    }
  }
  return used;
}

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
                       fmt::format("{} is an axis: it belongs below [grid]", key));
    } else {
      ThrowUnknown(file.Where(toml_key.source()), "table", key,
                   {"grid", "include", "exclude", "settings"});
    }
  }
  if (!file.root().contains("grid")) {
    throw InputError({std::make_shared<const std::string>(path), 1, 1},
                     "there is no [grid], the table of axes and their values");
  }
  for (const SubGrid& grid : grids) {
    CheckRenderable(grid, fs::path(path).parent_path());
  }
  sweep.places = PlacesOf(grids);
  sweep.cells = ExpandGrid(grids, exclude);
  sweep.excluded = CountAll(grids) - sweep.cells.size();
  return sweep;
}

Sweep ReadSweep(const std::string& path) { return ParseSweep(path, ReadWholeFile(path)); }

}  // namespace lanelight

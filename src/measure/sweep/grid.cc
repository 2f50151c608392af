#include "src/measure/sweep/sweep_file.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "src/base/core/check.h"
#include "src/base/core/hash.h"
#include "src/base/core/suggest.h"
#include "src/scene/description/scene_names.h"

namespace lanelight {
namespace {

constexpr std::size_t kMaxCells = 1000000;

std::size_t Combinations(const SubGrid& grid) {
  std::size_t cells = 1;
  for (const auto& [axis, values] : grid.axes) {
    cells *= values.size();
    if (cells <= kMaxCells) continue;
    throw InputError(grid.where,
                     "the grid has more than {} cells; divide it "
                     "into several sweeps",
                     kMaxCells);
  }
  return cells;
}

// Returns a combination; the last axis changes fastest.
AxisValues CombinationOf(const SubGrid& grid, std::size_t number) {
  AxisValues values;
  for (auto it = grid.axes.rbegin(); it != grid.axes.rend(); ++it) {
    const auto& [axis, list] = *it;
    values[std::size_t(axis)] = list[number % list.size()].text;
    number /= list.size();
  }
  return values;
}

bool Applies(const SubGrid& rule, const AxisValues& cell) {
  return std::ranges::all_of(rule.axes, [&](const auto& entry) {
    const auto& value = Get(cell, entry.first);
    return value && std::ranges::any_of(entry.second, [&](const GridValue& v) {
             return v.text == *value;
           });
  });
}

// Throws InputError for values of an exclusion that no cell has.
void CheckValues(const SubGrid& rule, const std::vector<AxisValues>& cells) {
  for (const auto& [axis, values] : rule.axes) {
    std::set<std::string> known;
    for (const AxisValues& cell : cells) known.insert(Get(cell, axis).value_or(""));
    known.erase("");
    for (const GridValue& value : values) {
      if (known.count(value.text) > 0) continue;
      throw InputError(value.where, "no cell of the grid has {} {}; {}", Name(axis),
                       Quoted(value.text),
                       known.empty() ? "the grid has no such axis"
                                     : "its values there: " +
                                           QuotedList({known.begin(), known.end()}));
    }
  }
}

void CheckRule(const SubGrid& rule, const std::vector<AxisValues>& cells) {
  if (rule.axes.empty()) {
    throw InputError(rule.where,
                     "this exclusion names no axis and would exclude all cells");
  }
  CheckValues(rule, cells);
  if (std::ranges::none_of(cells,
                           [&](const AxisValues& cell) { return Applies(rule, cell); })) {
    throw InputError(rule.where, "no cell of the grid has all of these values together");
  }
}

// Replaces characters that file systems or shells may not accept.
std::string Plain(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 ||
                       std::string(".=+-").find(c) != std::string::npos;
    out += plain ? c : '-';
  }
  return out;
}

std::vector<AxisValues> AllCombinations(const std::vector<SubGrid>& grids) {
  std::vector<AxisValues> all;
  std::set<AxisValues> seen;
  for (const SubGrid& grid : grids) {
    const std::size_t cells = Combinations(grid);
    for (std::size_t i = 0; i < cells; ++i) {
      AxisValues values = CombinationOf(grid, i);
      if (seen.insert(values).second) all.push_back(std::move(values));
    }
  }
  return all;
}

}  // namespace

std::string CellName(const AxisValues& values) {
  constexpr std::size_t kLongest = 120;  // of the readable part
  std::string readable, all;
  for (const Axis axis : kAllAxes) {
    const auto& value = Get(values, axis);
    if (!value) continue;
    readable +=
        (readable.empty() ? "" : "_") +
        Plain(ValueInNames(axis, axis == Axis::kScene ? SceneName(*value) : *value));
    all += fmt::format("{}={}\n", Key(axis), *value);
  }
  readable.resize(std::min(readable.size(), kLongest));
  return fmt::format("{}-{:010x}", readable, Hash64(all) >> 24);
}

std::vector<SweepCell> ExpandGrid(const std::vector<SubGrid>& grids,
                                  const std::vector<SubGrid>& exclude) {
  LL_CHECK(!grids.empty());
  const std::vector<AxisValues> all = AllCombinations(grids);
  for (const SubGrid& rule : exclude) CheckRule(rule, all);
  std::vector<SweepCell> cells;
  std::set<std::string> names;
  for (const AxisValues& values : all) {
    if (std::ranges::any_of(exclude,
                            [&](const SubGrid& rule) { return Applies(rule, values); })) {
      continue;
    }
    cells.push_back({cells.size(), values, CellName(values)});
    LL_CHECK(names.insert(cells.back().name).second);
  }
  if (cells.empty()) {
    throw InputError(grids.front().where, "the exclusions leave no cell of the grid");
  }
  return cells;
}

std::map<std::string, std::vector<StrategyPlace>> PlacesOf(
    const std::vector<SubGrid>& grids) {
  std::map<std::string, std::vector<StrategyPlace>> places;
  for (const SubGrid& grid : grids) {
    const auto strategies = grid.axes.find(Axis::kStrategy);
    if (strategies == grid.axes.end()) continue;
    for (const GridValue& strategy : strategies->second) {
      std::vector<StrategyPlace>& known = places[strategy.text];
      for (const StrategyPlace& place : strategy.places) {
        if (std::ranges::find(known, place) == known.end()) {
          known.push_back(place);
        }
      }
    }
  }
  return places;
}

std::string Sweep::ScenePath(const SweepCell& cell) const {
  return (std::filesystem::path(path).parent_path() / *Get(cell.values, Axis::kScene))
      .string();
}

std::vector<Axis> Sweep::UsedAxes() const {
  std::vector<Axis> used;
  for (const Axis axis : kAllAxes) {
    const auto has_value = [&](const SweepCell& c) {
      return Get(c.values, axis).has_value();
    };
    if (std::ranges::any_of(cells, has_value)) used.push_back(axis);
  }
  return used;
}

}  // namespace lanelight

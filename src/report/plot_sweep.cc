#include "src/report/plot_sweep.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>

#include "src/report/plot_json.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;
using Unit = PlotAxis::Unit;

// What a figure shows of each group of cells that differ in their seed only.
struct SweepFigure {
  PlotChoice choice;
  std::string title;
  PlotPanel panel;
  std::string y;  // a measure, or "efficiency"
  std::string x;  // an axis, or "cpu_seconds"; empty in rows
};

std::vector<SweepFigure> FiguresOf(const Json& sweep) {
  const PlotAxis relmse = {"relative MSE"}, spp = {"samples per pixel", Unit::kSamples},
                 seconds = {"processor time of one render", Unit::kSeconds};
  const PlotAxis efficiency = {"efficiency relative to " + sweep.value("baseline", "-")};
  std::vector<SweepFigure> figures = {
      {{"samples", "relative MSE against samples per pixel"},
       "Error against samples",
       {false, spp, relmse, {}, {}, -1.0},
       "relmse",
       "spp"},
      {{"time", "relative MSE against processor time"},
       "Error against time",
       {false, seconds, relmse, {}, {}, -1.0},
       "relmse",
       "cpu_seconds"},
      {{"efficiency", "efficiency relative to the baseline"},
       "Efficiency",
       {true, {}, efficiency, {}, 1.0, {}},
       "efficiency",
       ""},
      {{"rate", "samples per second"},
       "Throughput",
       {true, {}, {"samples per second"}, {}, {}, {}},
       "samples_per_second",
       ""}};
  for (const Json& axis : sweep.at("axes")) {
    if (!axis.at("parameter").get<bool>() || !axis.at("numeric").get<bool>()) continue;
    const std::string name = axis.at("name");
    figures.push_back({{name, "efficiency against this part of the strategy"},
                       "Efficiency against " + name,
                       {false, {name}, efficiency, {}, 1.0, {}},
                       "efficiency",
                       name});
  }
  return figures;
}

// A mean over seeds; of a single cell its value, with the render's own interval where it
// has stated one.
Interval MeasureOf(const Json& sweep, const Json& group, const std::string& name) {
  if (name == "efficiency") return IntervalOf(group.at("efficiency"));
  if (group.contains("measured")) return IntervalOf(group.at("measured").at(name));
  const Json& measured =
      sweep.at("cells").at(group.at("cells").at(0).get<std::size_t>()).at("measured");
  return {NumberOf(measured.value(name, Json())),
          NumberOf(measured.value(name + "_low", Json())),
          NumberOf(measured.value(name + "_high", Json()))};
}

// Of a group on the figure's x; NaN where it has no place.
double PlaceOf(const Json& sweep, const Json& group, const SweepFigure& figure) {
  if (figure.panel.rows) return 0;
  if (figure.x == "cpu_seconds") return MeasureOf(sweep, group, figure.x).value;
  const std::string text = group.at("values").value(figure.x, "");
  return text.empty() ? std::nan("") : std::atof(text.c_str());
}

// The strategy, and values of the axes that vary beside the scene and what lies along x:
// the amount of samples too where that is the time.
std::string NameOf(const Json& sweep, const Json& group, const SweepFigure& figure) {
  const bool by_part = figure.choice.name == figure.x;  // of the strategy
  std::string name = by_part ? "" : group.value("strategy", "");
  for (const Json& axis : sweep.at("axes")) {
    const std::string key = axis.at("name");
    const bool amount = key == "spp" || key == "time" || key.starts_with("target");
    const bool along = key == figure.x || (figure.x == "cpu_seconds" && amount);
    const std::size_t values =
        axis.at("values").size() + (axis.at("unset").get<bool>() ? 1 : 0);
    const bool of_strategy = key == "strategy" || axis.at("parameter").get<bool>();
    if (key == "scene" || along || values < 2 || (of_strategy && !by_part)) continue;
    const std::string value = group.at("values").value(key, "");
    if (value.empty()) continue;
    const std::string text = key == "strategy" ? value : key + " " + value;
    name += (name.empty() ? "" : ", ") + text;
  }
  return name.empty() ? "all" : name;
}

std::vector<std::string> ScenesOf(const Json& sweep) {
  for (const Json& axis : sweep.at("axes")) {
    if (axis.at("name") == "scene") return axis.at("values");
  }
  return {};
}

std::string SourceOf(const Json& sweep) {
  const auto seeds = sweep.at("seeds").get<std::size_t>();
  const Json& machines = sweep.at("machines");
  return fmt::format(
      "{}; {}; {}",
      seeds > 1 ? fmt::format("95 % intervals over {} seeds", seeds)
                : "95 % intervals that renders state of their errors",
      sweep.at("file").get<std::string>(),
      machines.empty() ? "unknown machine" : machines.at(0).value("text", "?"));
}

}  // namespace

std::vector<PlotChoice> SweepPlots(const Json& sweep) {
  std::vector<PlotChoice> choices;
  for (const SweepFigure& figure : FiguresOf(sweep)) choices.push_back(figure.choice);
  return choices;
}

Plot SweepPlot(const Json& sweep, const std::string& path, std::size_t at,
               const std::string& scene_name) {
  const SweepFigure figure = FiguresOf(sweep).at(at);
  const std::string scene = ChosenScene(ScenesOf(sweep), path, scene_name);
  PlotPanel panel = figure.panel;
  for (const Json& group : sweep.at("groups")) {
    if (group.at("values").at("scene") != scene) continue;
    const PlotPoint point = {PlaceOf(sweep, group, figure),
                             MeasureOf(sweep, group, figure.y)};
    if (!(point.y.value > 0) || !(panel.rows || point.x > 0)) continue;
    const std::string name = NameOf(sweep, group, figure);
    auto series = std::find_if(panel.series.begin(), panel.series.end(),
                               [&](const PlotSeries& s) { return s.name == name; });
    if (series == panel.series.end()) {
      const int look = static_cast<int>(panel.series.size());
      series = panel.series.insert(panel.series.end(), {name, {}, look});
    }
    series->points.push_back(point);
  }
  for (PlotSeries& series : panel.series) {
    std::sort(series.points.begin(), series.points.end(),
              [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; });
  }
  if (panel.series.empty()) {
    throw InputError(fmt::format("'{}' has no numbers for figure \"{}\" of scene \"{}\"",
                                 path, figure.choice.name, scene));
  }
  return {figure.title + ": " + scene, SourceOf(sweep), {panel}};
}

}  // namespace lanelight

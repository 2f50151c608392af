#include "src/report/plot_figures.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "src/core/error.h"
#include "src/core/json_text.h"
#include "src/core/suggest.h"
#include "src/report/plot_json.h"
#include "src/report/plot_sweep.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;
using Unit = PlotAxis::Unit;

constexpr std::size_t kMostLeading = 8;  // as MOST_CURVES of the page
constexpr int kKnownSchema = 1;          // of a study and a bench
constexpr int kSweepSchema = 2;

const PlotAxis kSpp = {"samples per pixel", Unit::kSamples};
const PlotAxis kSeconds = {"processor time of one render", Unit::kSeconds};

bool IsStudy(const Json& json) { return json.value("kind", "") == "lanelight-study"; }
bool IsSweep(const Json& json) { return json.value("kind", "") == "lanelight-sweep"; }

// A file of this schema and no later one.
void CheckKind(const Json& json, const std::string& path) {
  const bool known =
      json.is_object() && (IsStudy(json) || IsSweep(json) ||
                           (json.contains("rows") && json.contains("program")));
  if (!known) {
    throw InputError(fmt::format(
        "'{}' is not what can be drawn: study.json of `lanelight study`, sweep.json of "
        "`lanelight sweep`, or what `lanelight bench --json` writes",
        path));
  }
  const int schema = IsSweep(json) ? kSweepSchema : kKnownSchema;
  if (json.at("schema") != schema) {
    throw InputError(fmt::format("'{}' has schema {}; this program draws schema {}", path,
                                 DumpJson(json.at("schema")), schema));
  }
}

const Json& SceneOf(const Json& study, const std::string& path, const std::string& name) {
  std::vector<std::string> names;
  for (const Json& scene : study.at("scenes")) {
    if (scene.at("error").is_null()) names.push_back(scene.at("name"));
  }
  const std::string chosen = ChosenScene(names, path, name);
  const Json& scenes = study.at("scenes");
  return *std::find_if(scenes.begin(), scenes.end(), [&](const Json& scene) {
    return scene.at("error").is_null() && scene.at("name") == chosen;
  });
}

// Indices of the strategies to draw, best first. `paper`: those of its figures and the
// baseline, where there are any.
std::vector<std::size_t> Chosen(const Json& scene, bool paper, bool all) {
  std::vector<std::size_t> ranking = scene.at("ranking");
  if (all) return ranking;
  const std::size_t baseline = scene.at("baseline");
  const auto of_paper = [&](std::size_t i) {
    return !scene.at("strategies").at(i).at("figure").is_null();
  };
  if (paper && std::any_of(ranking.begin(), ranking.end(), of_paper)) {
    std::erase_if(ranking, [&](std::size_t i) { return i != baseline && !of_paper(i); });
  } else if (ranking.size() > kMostLeading) {
    std::size_t place = 0;
    std::erase_if(ranking, [&](std::size_t i) {
      return place++ >= kMostLeading - 1 && i != baseline;
    });
  }
  return ranking;
}

using PointsOf = std::vector<PlotPoint> (*)(const Json& strategy);

PlotPanel PanelOf(const Json& scene, const std::vector<std::size_t>& chosen,
                  PlotPanel panel, PointsOf points_of) {
  for (std::size_t place = 0; place < chosen.size(); ++place) {
    const Json& strategy = scene.at("strategies").at(chosen[place]);
    PlotSeries series = {strategy.at("name"), {}, static_cast<int>(place)};
    for (const PlotPoint& p : points_of(strategy)) {
      const bool drawn = std::isfinite(p.y.value) && (!panel.y.log || p.y.value > 0) &&
                         (panel.rows || p.x > 0);
      if (drawn) series.points.push_back(p);
    }
    panel.series.push_back(std::move(series));
  }
  return panel;
}

std::vector<PlotPoint> LevelPoints(const Json& strategy, const char* error, bool time) {
  std::vector<PlotPoint> points;
  for (const Json& level : strategy.at("levels")) {
    const double x =
        time ? IntervalOf(level.at("cpu_seconds")).value : NumberOf(level.at("spp"));
    points.push_back({x, IntervalOf(level.at(error))});
  }
  return points;
}

std::vector<PlotPoint> RowPoint(const Json& strategy, const char* member) {
  return {{0, IntervalOf(strategy.at(member))}};
}

struct StudyFigure {
  PlotChoice choice;
  const char* title;
  bool paper;  // of the paper's strategies
  std::vector<std::pair<PlotPanel, PointsOf>> panels;
};

const std::vector<StudyFigure>& StudyFigures() {
  const PlotAxis relmse = {"relative MSE"}, rmse = {"RMSE"};
  static const std::vector<StudyFigure> figures = {
      {{"8", "the paper's figure 8: RMSE against samples, and the slopes"},
       "Convergence",
       true,
       {{{false, kSpp, rmse, {}, {}, -0.5},
         [](const Json& s) { return LevelPoints(s, "rmse", false); }},
        {{true, {}, {"slope", Unit::kNumber, false}, {}, -0.5, {}},
         [](const Json& s) { return RowPoint(s, "order"); }}}},
      {{"samples", "relative MSE against samples per pixel"},
       "Error against samples",
       false,
       {{{false, kSpp, relmse, {}, {}, -1.0},
         [](const Json& s) { return LevelPoints(s, "relmse", false); }}}},
      {{"time", "relative MSE against processor time"},
       "Error against time",
       false,
       {{{false, kSeconds, relmse, {}, {}, -1.0},
         [](const Json& s) { return LevelPoints(s, "relmse", true); }}}},
      {{"efficiency", "the ranking: efficiency relative to the baseline"},
       "Efficiency",
       false,
       {{{true, {}, {"efficiency relative to the baseline"}, {}, 1.0, {}},
         [](const Json& s) { return RowPoint(s, "efficiency"); }}}},
  };
  return figures;
}

// Where the numbers are from, in one line.
std::string StudySource(const Json& study, const Json& scene) {
  const Json& settings = study.at("settings");
  const Json& versions = study.at("machine").at("versions");
  return fmt::format(
      "{:g} % intervals of {} repetitions; {} x {} pixels; lanelight {}, commit {}; {}",
      100 * NumberOf(settings.at("confidence")), DumpJson(settings.at("repetitions")),
      DumpJson(scene.at("resolution").at(0)), DumpJson(scene.at("resolution").at(1)),
      versions.value("lanelight", "?"), versions.value("commit", "?"),
      study.at("machine").value("text", "unknown machine"));
}

Plot StudyPlot(const Json& study, const std::string& path, const StudyFigure& figure,
               const std::string& scene_name, bool all) {
  const Json& scene = SceneOf(study, path, scene_name);
  Plot plot = {fmt::format("{}: {}", figure.title, scene.at("name").get<std::string>()),
               StudySource(study, scene),
               {}};
  const std::vector<std::size_t> chosen = Chosen(scene, figure.paper, all);
  bool empty = true;
  for (const auto& [panel, points_of] : figure.panels) {
    plot.panels.push_back(PanelOf(scene, chosen, panel, points_of));
    for (const PlotSeries& s : plot.panels.back().series) empty &= s.points.empty();
  }
  if (empty) {
    throw InputError(fmt::format("'{}' has no numbers for figure \"{}\" of scene \"{}\"",
                                 path, figure.choice.name,
                                 scene.at("name").get<std::string>()));
  }
  return plot;
}

const PlotChoice kRateChoice = {"rate",
                                "samples per second of every row, with intervals"};

Plot BenchPlot(const Json& bench) {
  PlotPanel panel = {true, {}, {"samples per second"}, {}, {}, {}};
  std::vector<std::string> targets;  // a look for each
  for (const Json& row : bench.at("rows")) {
    const std::string target = row.at("target");
    const auto found = std::find(targets.begin(), targets.end(), target);
    const int look = static_cast<int>(found - targets.begin());
    if (found == targets.end()) targets.push_back(target);
    const int threads = row.at("threads");
    panel.series.push_back(
        {fmt::format("{}, {}, {} thread{}", row.at("scene").get<std::string>(), target,
                     threads, threads == 1 ? "" : "s"),
         {{0, IntervalOf(row.at("samples_per_second"))}},
         look});
  }
  return {"Throughput",
          fmt::format("{:g} % intervals of the median; {}; {}",
                      100 * NumberOf(bench.at("confidence")),
                      bench.at("program").get<std::string>(),
                      bench.at("machine").at("text").get<std::string>()),
          {panel}};
}

// Figures of the paper that a study has as images.
void RefusePictures(const std::string& figure, const std::string& path) {
  if (figure.size() != 1 || figure[0] < '1' || figure[0] > '7') return;
  throw InputError(fmt::format(
      "figure {} of '{}' is a picture, not a plot: report.html beside it shows it, and "
      "the folder of the scene has its pixels as EXR",
      figure, path));
}

}  // namespace

std::vector<PlotChoice> PlotsOf(const Json& json, const std::string& path) {
  return FromJsonOf(path, [&] {
    CheckKind(json, path);
    if (IsSweep(json)) return SweepPlots(json);
    if (!IsStudy(json)) return std::vector<PlotChoice>{kRateChoice};
    std::vector<PlotChoice> choices;
    for (const StudyFigure& figure : StudyFigures()) choices.push_back(figure.choice);
    return choices;
  });
}

Plot MakePlot(const Json& json, const std::string& path, const std::string& figure,
              const std::string& scene, bool all) {
  std::vector<std::string> names;
  for (const PlotChoice& choice : PlotsOf(json, path)) names.push_back(choice.name);
  const auto found = std::find(names.begin(), names.end(), figure);
  if (IsStudy(json)) RefusePictures(figure, path);
  if (found == names.end()) {
    ThrowUnknown({std::make_shared<const std::string>(path)}, "figure", figure, names);
  }
  return FromJsonOf(path, [&] {
    const std::size_t at = static_cast<std::size_t>(found - names.begin());
    if (IsSweep(json)) return SweepPlot(json, path, at, scene);
    if (!IsStudy(json)) return BenchPlot(json);
    return StudyPlot(json, path, StudyFigures()[at], scene, all);
  });
}

}  // namespace lanelight

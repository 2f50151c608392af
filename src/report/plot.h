// Plots for papers: what is drawn, and the drawing as SVG and its numbers as CSV. Always
// in light colours, those of the pages (src/report/page/base.css).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/stat/interval.h"

namespace lanelight {

/// One estimate. In a panel of curves `y` stands over `x`, which is positive; in a panel
/// of rows `x` is unused.
struct PlotPoint {
  double x = 0;
  Interval y;  // bounds that are not finite are not drawn
};

struct PlotSeries {
  std::string name;
  std::vector<PlotPoint> points;
  int look = 0;  // colour, marker and dash; equal in all panels of a plot
};

struct PlotAxis {
  enum class Unit { kNumber, kSeconds, kSamples };
  std::string label;
  Unit unit = Unit::kNumber;
  bool log = true;
};

/// Curves over x, or rows: a dot with its interval for each series, along `y`, which then
/// lies horizontally.
struct PlotPanel {
  bool rows = false;
  PlotAxis x, y;
  std::vector<PlotSeries> series;
  std::optional<double> mark;   // a value of y with a line of its own
  std::optional<double> slope;  // of a dashed guide in a panel of curves
};

struct Plot {
  std::string title, source;      // source: where the numbers are from, one line
  std::vector<PlotPanel> panels;  // one, or curves and beside them rows
};

/// A complete SVG 1.1 document of 960 pixels width. Every marker has its numbers in
/// `data-series`, `data-x` and `data-y`, every tick its in `data-value`.
std::string PlotSvg(const Plot& plot);

/// A row for each point: series, quantity, value, low, high, at, at_quantity. Empty: not
/// known.
std::string PlotCsv(const Plot& plot);

/// An axis from `from` to `to` on `length` pixels.
struct PlotScale {
  double from = 0, to = 1, length = 1;
  bool log = true;

  /// Pixels from the axis's start; values beyond its ends are held there.
  double At(double value) const;
};
/// A scale that holds the values with some room; of a logarithmic one only those above 0.
PlotScale ScaleFor(const std::vector<double>& values, const PlotAxis& axis,
                   double length);
/// Round values inside, ascending, about `most`.
std::vector<double> TicksOf(const PlotScale& scale, const PlotAxis& axis, int most);
/// "0.05", "2×10⁻⁴", "50 ms", "1.2 k".
std::string TickText(double value, const PlotAxis& axis);

/// `#rrggbb` of a series with such a look, and their number; from the pages' style.
std::vector<std::string> PlotColors();

}  // namespace lanelight

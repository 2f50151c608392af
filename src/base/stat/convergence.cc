#include "src/base/stat/convergence.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/base/core/check.h"
#include "src/base/stat/bootstrap.h"

namespace lanelight::stat {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kMinSeconds = 1e-9;  // what a coarse clock cannot show

// Logarithms: of samples, mean error, mean seconds.
struct Point {
  double samples = 0, error = 0, seconds = 0;
};

// Least-squares slope of y over x; NaN if all x are equal.
double Slope(std::span<const double> x, std::span<const double> y) {
  const double n = static_cast<double>(x.size());
  double mx = 0, my = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mx += x[i] / n;
    my += y[i] / n;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mx) * (x[i] - mx);
    xy += (x[i] - mx) * (y[i] - my);
  }
  return xx > 0 ? xy / xx : kNan;
}

double Slope(std::span<const Point> points, double Point::* y) {
  std::vector<double> xs, ys;
  for (const Point& p : points) {
    xs.push_back(p.samples);
    ys.push_back(p.*y);
  }
  return Slope(xs, ys);
}

struct Target {
  double samples = kNan, seconds = kNan;  // logarithms; NaN: not reached
  bool extrapolated = false;
};

Target Continue(std::span<const Point> points, const Point& from, double error) {
  const double slope = Slope(points, &Point::error);
  if (!(slope < 0)) return {};
  const double step = (error - from.error) / slope;
  return {from.samples + step, from.seconds + step * Slope(points, &Point::seconds),
          true};
}

// Finds where the curve falls to `error` (a logarithm) for the last time.
Target Find(std::span<const Point> points, double error) {
  const auto above = [&](const Point& p) { return p.error > error; };
  const auto last = std::find_if(points.rbegin(), points.rend(), above);
  if (last == points.rbegin()) return Continue(points, points.back(), error);
  const Point& next = *(last - 1);
  if (next.error == error) return {next.samples, next.seconds, false};
  if (last == points.rend()) return Continue(points, points.front(), error);
  const double fraction = (error - last->error) / (next.error - last->error);
  return {last->samples + fraction * (next.samples - last->samples),
          last->seconds + fraction * (next.seconds - last->seconds), false};
}

// The levels as columns: error and seconds of each, a row for each repetition that all
// levels have.
Repetitions ToRepetitions(std::span<const Level> levels) {
  std::size_t n = std::numeric_limits<std::size_t>::max();
  for (const Level& l : levels) n = std::min(n, l.error.size());
  Repetitions out(2 * levels.size());
  std::vector<double> row(2 * levels.size());
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < levels.size(); ++k) {
      row[2 * k] = levels[k].error[i];
      row[2 * k + 1] = levels[k].seconds[i];
    }
    out.Add(row);
  }
  return out;
}

// Ascending, without levels that have no logarithm.
std::vector<Level> Usable(std::span<const Level> levels) {
  std::vector<Level> out;
  for (const Level& l : levels) {
    LL_CHECK_EQ(l.error.size(), l.seconds.size());
    if (l.samples > 0 && !l.error.empty() && Mean(l.error) > 0) out.push_back(l);
  }
  std::sort(out.begin(), out.end(),
            [](const Level& a, const Level& b) { return a.samples < b.samples; });
  return out;
}

std::vector<Point> ToPoints(std::span<const Level> levels,
                            std::span<const double> means) {
  std::vector<Point> points;
  points.reserve(levels.size());
  for (std::size_t k = 0; k < levels.size(); ++k) {
    points.push_back({std::log(levels[k].samples), std::log(means[2 * k]),
                      std::log(std::max(means[2 * k + 1], kMinSeconds))});
  }
  return points;
}

Interval AroundLogarithm(double log_value, double half) {
  const Interval v = {std::exp(log_value), std::exp(log_value - half),
                      std::exp(log_value + half)};
  return v.HasBounds() ? v : WithoutBounds(v.value);
}

}  // namespace

std::optional<Interval> FitOrder(std::span<const Level> levels, double confidence) {
  std::size_t repetitions = 0;
  for (const Level& l : levels) repetitions = std::max(repetitions, l.error.size());
  std::vector<double> slopes;
  for (std::size_t r = 0; r < repetitions; ++r) {
    std::vector<double> x, y;
    for (const Level& l : levels) {
      if (r >= l.error.size() || !(l.error[r] > 0) || !(l.samples > 0)) continue;
      x.push_back(std::log(l.samples));
      y.push_back(std::log(l.error[r]) / 2);
    }
    const double slope = Slope(x, y);
    if (std::isfinite(slope)) slopes.push_back(slope);
  }
  if (slopes.empty()) return std::nullopt;
  return MeanInterval(slopes, confidence);
}

std::optional<TargetCost> CostToTarget(std::span<const Level> levels, double target,
                                       double confidence, double reach) {
  LL_CHECK(reach >= 1);
  const std::vector<Level> usable = Usable(levels);
  if (usable.empty() || !(target > 0)) return std::nullopt;
  std::vector<double> means;
  for (const Level& l : usable) {
    means.push_back(Mean(l.error));
    means.push_back(Mean(l.seconds));
  }
  const double error = std::log(target);
  const auto find = [&](std::span<const double> m) {
    return Find(ToPoints(usable, m), error);
  };
  const Target found = find(means);
  const double limit = std::log(reach);
  if (!std::isfinite(found.samples) ||
      found.samples > std::log(usable.back().samples) + limit ||
      found.samples < std::log(usable.front().samples) - limit) {
    return std::nullopt;
  }
  const Repetitions repetitions = ToRepetitions(usable);
  const auto around = [&](double Target::* member) {
    const OfMeans f = [&](std::span<const double> m) { return find(m).*member; };
    return AroundLogarithm(found.*member, HalfWidth(repetitions, f, confidence));
  };
  return TargetCost{around(&Target::samples), around(&Target::seconds),
                    found.extrapolated};
}

}  // namespace lanelight::stat

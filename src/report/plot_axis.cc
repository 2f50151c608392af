// Axes of plots: scales, round ticks and their texts.
#include <algorithm>
#include <array>
#include <cmath>

#include "src/report/plot.h"

namespace lanelight {
namespace {

using Unit = PlotAxis::Unit;

// The first of 1, 2, 5, 10, ... times a power of ten that is not below `least`.
double NiceStep(double least) {
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= 0.999 * least) return factor * power;
  }
  return 10 * power;
}

std::vector<double> EvenTicks(const PlotScale& scale, int most) {
  const double step = NiceStep((scale.to - scale.from) / most);
  std::vector<double> ticks;
  for (double i = std::ceil(scale.from / step); i * step <= scale.to; ++i) {
    ticks.push_back(i * step);
  }
  return ticks;
}

// base^e times each factor, every `step` powers.
std::vector<double> PowerTicks(const PlotScale& scale, double base, int step,
                               const std::vector<double>& factors) {
  std::vector<double> ticks;
  const int first = static_cast<int>(std::floor(std::log(scale.from) / std::log(base)));
  for (int e = first; std::pow(base, e) <= scale.to; e += step) {
    for (const double factor : factors) {
      const double tick = factor * std::pow(base, e);
      if (tick >= scale.from && tick <= scale.to) ticks.push_back(tick);
    }
  }
  return ticks;
}

// On a logarithmic scale even ticks crowd at its end: only those that leave room for the
// text of the one before.
std::vector<double> Apart(const PlotScale& scale, const std::vector<double>& ticks,
                          int most) {
  std::vector<double> kept;
  for (const double tick : ticks) {
    const bool room =
        kept.empty() || scale.At(tick) - scale.At(kept.back()) >= scale.length / most;
    if (!scale.log || room) kept.push_back(tick);
  }
  return kept;
}

std::string Superscript(int exponent) {
  constexpr std::array<const char*, 10> kDigits = {"⁰", "¹", "²", "³", "⁴",
                                                   "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (const char c : std::to_string(std::abs(exponent))) text += kDigits[c - '0'];
  return text;
}

std::string WithMinus(double value) {
  return value < 0 ? fmt::format("−{:.6g}", -value) : fmt::format("{:.6g}", value);
}

}  // namespace

double PlotScale::At(double value) const {
  const auto f = [&](double v) { return log ? std::log(std::max(v, 1e-300)) : v; };
  return length * std::clamp((f(value) - f(from)) / (f(to) - f(from)), 0.0, 1.0);
}

PlotScale ScaleFor(const std::vector<double>& values, const PlotAxis& axis,
                   double length) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const double v : values) {
    if (!std::isfinite(v) || (axis.log && v <= 0)) continue;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  if (low > high) return {axis.log ? 0.1 : 0.0, 1, length, axis.log};
  if (axis.log) {
    const double room = std::max(1.2, std::sqrt(std::max(1.0, 2 * low / high)));
    return {low / room, high * room, length, true};
  }
  const double room = high > low ? 0.08 * (high - low) : 0.5 * std::abs(high) + 1e-3;
  return {low - room, high + room, length, false};
}

std::vector<double> TicksOf(const PlotScale& scale, const PlotAxis& axis, int most) {
  if (!scale.log || (axis.unit != Unit::kSamples && scale.to < 5 * scale.from)) {
    return Apart(scale, EvenTicks(scale, most), most);
  }
  std::vector<double> ticks;
  const auto fits = [&] { return ticks.size() <= static_cast<std::size_t>(most); };
  for (int step = 1;; ++step) {
    if (axis.unit == Unit::kSamples) {
      ticks = PowerTicks(scale, 2, step, {1});
      if (fits()) return ticks;
      continue;
    }
    for (const auto& factors :
         step == 1 ? std::vector<std::vector<double>>{{1, 2, 5}, {1, 3}, {1}}
                   : std::vector<std::vector<double>>{{1}}) {
      ticks = PowerTicks(scale, 10, step, factors);
      if (fits()) return ticks;
    }
  }
}

std::string TickText(double value, const PlotAxis& axis) {
  constexpr std::array<std::pair<double, const char*>, 5> kTimes = {
      {{3600, " h"}, {60, " min"}, {1, " s"}, {1e-3, " ms"}, {1e-6, " µs"}}};
  if (axis.unit == Unit::kSeconds) {
    for (const auto& [unit, name] : kTimes) {
      if (value >= 0.9999 * unit) return fmt::format("{:.3g}{}", value / unit, name);
    }
  }
  const double size = std::abs(value);
  if (axis.unit == Unit::kSamples && size >= 1) return fmt::format("{:.0f}", value);
  if (size < 1e-12) return "0";
  if (size >= 0.000999 && size < 1e5) return WithMinus(value);
  const int exponent = static_cast<int>(std::floor(std::log10(size) + 1e-9));
  const double factor = value / std::pow(10, exponent);
  const std::string power = Superscript(exponent);
  return std::abs(factor - 1) < 1e-6 ? power : WithMinus(factor) + "×" + power;
}

}  // namespace lanelight

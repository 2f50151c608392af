#include "src/render/schedule/schedule.h"

#include <algorithm>
#include <cmath>

#include "src/render/wave/run_options.h"

namespace lanelight {
namespace {

constexpr double kMaxTaskFraction = 0.005;  // of the budget

std::uint64_t NextCheck(std::uint64_t look, std::uint32_t unit) {
  std::uint64_t step = unit;
  while (look / step >= 8) step *= 2;
  return look + step;
}

}  // namespace

std::uint64_t FirstCheck(std::uint32_t unit) { return std::uint64_t{16} * unit; }

std::uint64_t CheckFrom(std::uint64_t done, std::uint32_t unit) {
  std::uint64_t look = FirstCheck(unit);
  while (look < done) look = NextCheck(look, unit);
  return look;
}

int ChecksUpTo(std::uint64_t done, std::uint32_t unit) {
  int checks = 0;
  for (auto at = FirstCheck(unit); at <= done; at = NextCheck(at, unit)) ++checks;
  return checks;
}

Round RoundAfter(std::uint64_t done, std::uint32_t per_task, std::uint32_t unit) {
  if (done >= per_task) return {done, done + kMaxSamplesPerPixel, per_task};
  const auto samples = std::uint32_t(std::max<std::uint64_t>(3 * done, unit));
  return {done, done + samples, std::min(samples, per_task)};
}

std::uint32_t Pace::RoundedSamples(double samples) const {
  const double units = std::floor(samples / tasks_.unit);
  const double maximum = tasks_.per_task / tasks_.unit;
  return std::uint32_t(std::clamp(units, 1.0, std::max(1.0, maximum))) * tasks_.unit;
}

Round Pace::Next(std::uint64_t done, double elapsed) const {
  if (speed_ == 0) return {done, done + tasks_.unit, tasks_.unit};
  // Seconds of one sample of all pixels of a tile.
  const double tile = tasks_.threads / (speed_ * double(tasks_.tiles));
  const double maximum = RemainingSamples(elapsed) / 2;
  const std::uint32_t per_task =
      RoundedSamples(std::min(maximum, kMaxTaskFraction * budget_ / tile));
  const auto ranges = std::uint64_t(std::max(1.0, maximum / per_task));
  return {done, done + per_task * ranges, per_task};
}

void Pace::AddMeasurement(std::uint64_t samples, double seconds) {
  speed_ = double(samples) / std::max(seconds, 1e-6);
}

double Pace::RemainingSamples(double elapsed) const {
  return std::max(0.0, speed_ * (budget_ - elapsed));
}

}  // namespace lanelight

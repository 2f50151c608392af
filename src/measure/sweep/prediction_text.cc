#include <cmath>

#include "src/base/core/text_layout.h"
#include "src/measure/sweep/runner.h"

namespace lanelight {
namespace {

std::string BytesText(double bytes) {
  constexpr const char* kUnits[] = {"B", "kB", "MB", "GB", "TB"};
  int unit = 0;
  while (bytes >= 1000 && unit < 4) {
    bytes /= 1000;
    ++unit;
  }
  return fmt::format("{:.3g} {}", bytes, kUnits[unit]);
}

struct Sums {
  std::size_t done = 0, failing = 0, unknown = 0, estimated = 0;
  double seconds = 0, bytes = 0;

  void Add(const CellPrediction& p) {
    if (p.done) {
      ++done;
    } else if (!p.message.empty()) {
      ++failing;
    } else if (!std::isfinite(p.seconds)) {
      ++unknown;
    } else {
      estimated += !p.measured;
      seconds += p.seconds;
      bytes += p.bytes;
    }
  }
};

std::string Row(const SweepCell& cell, const CellPrediction& p) {
  if (p.done) return fmt::format("{:>10} {:>10}  {}\n", "done", "", cell.name);
  if (!p.message.empty()) {
    return fmt::format("{:>10} {:>10}  {}: {}\n", "will fail", "", cell.name, p.message);
  }
  const std::string seconds =
      std::isfinite(p.seconds) ? fmt::format("{:.3g}", p.seconds) : "-";
  return fmt::format("{:>10} {:>10}  {}\n", seconds + (p.measured ? " " : "~"),
                     std::isfinite(p.bytes) ? BytesText(p.bytes) : "-", cell.name);
}

}  // namespace

std::string PredictionText(const Sweep& sweep, const SweepPrediction& prediction) {
  std::string text = fmt::format("{:>9}  {:>10}  cell\n", "seconds", "space");
  Sums sums;
  for (const SweepCell& cell : sweep.cells) {
    text += Row(cell, prediction.cells[cell.index]);
    sums.Add(prediction.cells[cell.index]);
  }
  text += fmt::format("\n{} cells, {} combinations excluded; {} are done",
                      sweep.cells.size(), sweep.excluded, sums.done);
  if (sums.failing > 0) text += fmt::format(", {} will fail", sums.failing);
  if (sums.unknown > 0) text += fmt::format(", {} take an unknown time", sums.unknown);
  if (prediction.combinations == 0) return text + "\n";
  text += fmt::format("\n{} of {} combinations of scene and strategy were measured",
                      prediction.probes, prediction.combinations);
  if (sums.estimated > 0) {
    text += fmt::format("; {} cells (~) are estimated from the others", sums.estimated);
  }
  if (prediction.probes == 0) return text + "\n";
  return text + fmt::format("\nthe rest: {} on this machine by one process, {}\n",
                            DurationText(sums.seconds), BytesText(sums.bytes));
}

}  // namespace lanelight

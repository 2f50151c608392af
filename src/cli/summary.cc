#include "src/cli/summary.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "kernels/simd/target.h"
#include "src/cli/progress.h"
#include "src/core/machine_info.h"
#include "src/core/parallel.h"
#include "src/scene/image_changes.h"

namespace lanelight {
namespace {

std::string Row(const std::string& label, const std::string& text) {
  return fmt::format("{:<10} {}\n", label, text);
}

std::string IntervalText(const Interval& v) {
  if (!v.HasBounds())
    return fmt::format("at least {:.4g} (estimate {:.4g})", v.low, v.value);
  return fmt::format("{:.4g} [{:.4g}, {:.4g}]", v.value, v.low, v.high);
}

std::string HealthText(const Health& h) {
  if (h.Total() == 0) return "all samples valid";
  return fmt::format("{} INVALID samples set to zero: {} NaN, {} infinite, {} negative",
                     h.Total(), h.nan, h.infinite, h.negative);
}

// The summary's row on a control variate; empty without one.
std::string ControlRow(const RunResult& r, const Strategy& strategy) {
  if (strategy.control == Control::kNone) return "";
  const double c = r.control ? r.control->coefficient : strategy.coefficient.value_or(1);
  std::string text =
      fmt::format("{}, {}c = {:.4g} (in the paper's sign {:.4g})", Name(strategy.control),
                  strategy.coefficient ? "" : "mean ", c, 0 - c);
  if (r.control) {
    text += fmt::format(", correlation reached {:.4f}", r.control->correlation);
  }
  return Row("control", text);
}

const char* StopText(const RunResult& r) {
  if (r.stop_reason == StopReason::kInterrupted) return " (stopped early)";
  return r.stop_reason == StopReason::kTarget ? " (target reached)" : "";
}

std::string SpeedRows(const RunResult& r) {
  const double seconds = r.seconds > 0 ? r.seconds : 1e-9;
  const double closest = double(r.rays_closest), shadow = double(r.rays_shadow);
  return Row("samples",
             fmt::format("{} in {}: {}samples/s{}", TotalText(double(r.samples)),
                         DurationText(r.seconds), CountText(double(r.samples) / seconds),
                         StopText(r))) +
         Row("rays",
             fmt::format("{} ({} closest hit, {} shadow): {}rays/s",
                         TotalText(closest + shadow), TotalText(closest),
                         TotalText(shadow), CountText((closest + shadow) / seconds)));
}

}  // namespace

std::string ErrorText(const ErrorEstimate& e) {
  if (!e.available) return "unknown: needs two samples per pixel, or two pairs";
  std::string text = fmt::format("RMSE {}, relative MSE {} (95 % confidence)",
                                 IntervalText(e.rmse), IntervalText(e.relmse));
  if (!e.why.empty()) text += "; how large it may be cannot be told: " + e.why;
  return text;
}

std::string StageTable(const RunResult& result) {
  double total = 0;
  for (const StageProfile& s : result.stages) total += s.seconds;
  std::string text =
      fmt::format("{:<24}{:>9}{:>10}{:>8}{:>10}{:>8}{:>9}\n", "stage", "calls", "items",
                  "lanes", "seconds", "share", "ns/item");
  for (const StageProfile& s : result.stages) {
    text += fmt::format("{:<24}{:>9}{:>10}{:>6.1f} %{:>10.3f}{:>6.1f} %{:>9.2f}\n",
                        s.name, TotalText(double(s.calls)), TotalText(double(s.items)),
                        100 * s.Occupancy(), s.seconds,
                        total > 0 ? 100 * s.seconds / total : 0,
                        s.items ? 1e9 * s.seconds / double(s.items) : 0);
  }
  return text +
         fmt::format("{:<24}{:>37.3f}  seconds of all threads together\n", "", total);
}

std::string MergeSummaryText(const RenderReport& report, const MergedRender& merged) {
  const RunResult& r = report.result;
  const auto pixels = double(merged.window.pixels());
  std::string text;
  if (!report.exr.empty()) {
    text += Row("image", fmt::format("{} ({}x{} pixels, {:.4g} samples each)", report.exr,
                                     merged.window.width(), merged.window.height(),
                                     double(r.samples) / pixels));
  }
  if (!report.png.empty()) text += Row("png", report.png);
  if (merged.missing > 0) {
    text += Row("missing",
                fmt::format("{} of {} pixels", merged.missing, merged.window.pixels()));
  }
  if (merged.seeds.size() > 1)
    text += Row("seeds", fmt::format("{}", merged.seeds.size()));
  for (const MachineInfo& machine : merged.machines) {
    text += Row("machine", MachineText(machine));
  }
  text += Row("strategy", merged.identity.at("strategy"));
  text += SpeedRows(r);
  text += Row("error", ErrorText(report.error));
  return text + Row("health", HealthText(r.health));
}

std::string DiffersRow(const std::vector<Note>& notes) {
  const std::string text = ImageChangesText(notes);
  return text.empty() ? text : "\n" + Row("differs", text);
}

std::string SummaryText(const RenderReport& report, const Job& job) {
  const RunResult& r = report.result;
  std::string text =
      Row("image", fmt::format("{} ({}x{} pixels, {:.4g} samples each)",
                               report.exr.empty() ? "none" : report.exr,
                               job.window.width(), job.window.height(),
                               double(r.samples) / double(job.window.pixels())));
  if (!report.png.empty()) text += Row("png", report.png);
  text += Row("strategy", ToText(job.scene.strategy));
  text += Row("points", PointsText(job));
  text += SpeedRows(r);
  if (!r.training.note.empty()) {
    text +=
        Row("pilot", fmt::format("{} ({:.1f} %): {}", DurationText(r.training.seconds),
                                 100 * r.training.seconds / std::max(r.seconds, 1e-9),
                                 r.training.note));
  }
  text += Row("error", ErrorText(report.error));
  text += ControlRow(r, job.scene.strategy);
  text += Row("health", HealthText(r.health));
  text += Row("time",
              fmt::format("load {}, build {} (trees {} in {}), render {}, write {}",
                          DurationText(job.load_seconds), DurationText(job.build_seconds),
                          Name(job.trees.origin), DurationText(job.trees.seconds),
                          DurationText(r.seconds), DurationText(report.write_seconds)));
  const SimdTarget target = job.plan.options.target;
  text +=
      Row("machine", MachineText(ThisMachine())) +
      Row("kernels",
          fmt::format("{}, {} lanes, {} threads; wavefront {} paths of {} bytes",
                      target.name(), target.lanes(), ThreadCount(job.settings.threads),
                      job.plan.wavefront, job.plan.bytes_per_path));
  return text + "\n" + StageTable(r) + DiffersRow(job.description.notes);
}

}  // namespace lanelight

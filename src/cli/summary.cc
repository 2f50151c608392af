#include "src/cli/texts.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "kernels/simd/target.h"
#include "src/base/core/machine_info.h"
#include "src/base/core/parallel.h"
#include "src/base/core/text_layout.h"
#include "src/cli/console.h"
#include "src/cli/progress.h"
#include "src/render/job/loaded_scene.h"
#include "src/scene/description/note.h"
#include "src/vocabulary/strategy/strategy_text.h"

namespace lanelight {
namespace {

std::string HealthText(const Health& h) {
  if (h.Total() == 0) return "all valid";
  return fmt::format("{} INVALID, set to zero: {} NaN, {} infinite, {} negative",
                     h.Total(), h.nan, h.infinite, h.negative);
}

// The summary's row on a control variate; empty without one.
std::string ControlRow(const RunResult& r, const Strategy& strategy) {
  if (strategy.control == Control::kNone) return "";
  const double c = r.control ? r.control->coefficient : strategy.coefficient.value_or(1);
  std::string text =
      fmt::format("{}, {}c = {:.4g} ({:.4g} in the paper's sign convention)",
                  Name(strategy.control), strategy.coefficient ? "" : "mean ", c, 0 - c);
  if (r.control) {
    text += fmt::format(", correlation reached {:.4f}", r.control->correlation);
  }
  return SummaryRow("control", text);
}

const char* StopText(const RunResult& r) {
  if (r.stop_reason == StopReason::kInterrupted) return " (stopped early)";
  return r.stop_reason == StopReason::kTarget ? " (target reached)" : "";
}

double SecondsOf(const RunResult& r) { return std::max(r.seconds, 1e-9); }

std::string ImageRow(const RenderReport& report, const PixelRect& window) {
  std::string files = report.exr.empty() ? "none" : report.exr;
  if (!report.png.empty()) files += ", " + report.png;
  return SummaryRow("image",
                    fmt::format("{} ({}x{} pixels, {:.4g} samples each)", files,
                                window.width(), window.height(),
                                double(report.result.samples) / double(window.pixels())));
}

// The row of a render of a part, which writes a state instead of an image.
std::string PartRow(const RenderReport& report, const PixelRect& window,
                    const std::string& state) {
  const std::uint64_t pixels = window.pixels() - report.unsampled_pixels;
  return SummaryRow(
      "state",
      fmt::format("{} ({} of {} pixels, {:.4g} samples each); combine all "
                  "parts with `lanelight merge`",
                  state, pixels, window.pixels(),
                  double(report.result.samples) / std::max(double(pixels), 1.0)));
}

std::string ErrorRow(const ErrorEstimate& error) {
  return SummaryRow(
      "error", Painted(TextStyle::kBold, PercentText(error), Stream::kOutput) +
                   (error.available && error.why != kNoLight ? ", 95 % confidence" : ""));
}

std::string SpeedRows(const RunResult& r) {
  const double rays = double(r.rays_closest) + double(r.rays_shadow);
  return SummaryRow("time", DurationText(r.seconds) + StopText(r)) +
         SummaryRow("speed", fmt::format("{}samples/s, {}rays/s",
                                         CountText(double(r.samples) / SecondsOf(r)),
                                         CountText(rays / SecondsOf(r))));
}

// A time as `--time` takes it, rounded up.
std::string TimeArgument(double seconds) {
  if (seconds < 1) return fmt::format("{:.0f}ms", std::ceil(1e3 * seconds));
  return fmt::format("{:.0f}", std::ceil(seconds));
}

// Says how to get a smaller error: squared errors fall as 1 / samples.
std::string NextRow(const RenderReport& report, const Job& job,
                    const std::string& checkpoint) {
  const RunResult& r = report.result;
  const ErrorEstimate& e = report.error;
  if (!e.available || !(e.relmse.value > 0) || r.samples == 0) return "";
  const bool missed = job.target.Any() && !Reached(job.target, e);
  constexpr double kHalfTheError = 4;
  double times = kHalfTheError;
  if (missed) times = SamplesNeeded(job.target, e, r.samples) / double(r.samples);
  if (!std::isfinite(times) || times <= 0) return "";
  const double spp = double(r.samples) / double(job.window.pixels());
  const std::string amount = job.seconds > 0 || missed
                                 ? "--time " + TimeArgument(times * SecondsOf(r))
                                 : fmt::format("--spp {:.0f}", std::ceil(times * spp));
  const std::string cost =
      fmt::format("{} ({})", amount, DurationText(times * SecondsOf(r)));
  // Squared errors of a wide interval may fall by any amount.
  constexpr double kMaxRatio = 16;
  const bool known = e.relmse.high <= kMaxRatio * e.relmse.low;
  std::string text = fmt::format("{} takes about {:.2g} times as long: {}",
                                 missed ? "the target" : "half the error", times, cost);
  if (!missed && !known) {
    text = fmt::format(
        "the error is uncertain: render {:.2g} times as long for a narrower interval: {}",
        times, cost);
  }
  if (!checkpoint.empty()) {
    text += fmt::format("; --resume continues from '{}'", checkpoint);
  }
  return SummaryRow("next", text);
}

// Returns e.g. ": gains 2.3x per pixel, 1.5x after an 8x8 filter"; empty without a gain.
std::string GainText(const TrainingOutcome& t) {
  if (t.gain <= 0) return "";
  return fmt::format(": gains {:.2g}x per pixel, {:.2g}x after an 8x8 filter", t.gain,
                     t.filtered_gain);
}

// Names the choices of the strategy that differ from the default.
std::string StrategyRow(const RunResult& r, const Job& job, bool verbose) {
  const Strategy in_force = StrategyInForce(r, job);
  Strategy defaults;
  defaults.decide = in_force.decide;
  const std::string changes = ChoicesNotIn(ToText(defaults), ToText(in_force));
  if (changes.empty()) return "";
  if (r.training.changes.empty()) return SummaryRow("strategy", changes);
  return SummaryRow(
      "strategy", fmt::format("{} (chosen by a short trial run{}{})", changes,
                              GainText(r.training), verbose ? "" : "; details with -v"));
}

std::string TrialRow(const RunResult& r) {
  if (r.training.note.empty()) return "";
  return SummaryRow(
      "trial", fmt::format("{} ({:.1f} %): {}", DurationText(r.training.seconds),
                           100 * r.training.seconds / SecondsOf(r), r.training.note));
}

std::string RaysRow(const RunResult& r) {
  const double closest = double(r.rays_closest), shadow = double(r.rays_shadow);
  return SummaryRow("rays", fmt::format("{} ({} closest hit, {} shadow) of {} samples",
                                        TotalText(closest + shadow), TotalText(closest),
                                        TotalText(shadow), TotalText(double(r.samples))));
}

std::string DetailRows(const RenderReport& report, const Job& job) {
  const RunResult& r = report.result;
  const SimdTarget target = job.plan.options.target;
  return "\n" + SummaryRow("strategy", ToText(StrategyInForce(r, job))) +
         SummaryRow("sampler", PointsText(job)) + TrialRow(r) +
         SummaryRow("errors", ErrorText(report.error)) +
         ControlRow(r, job.scene.strategy) + RaysRow(r) +
         SummaryRow("samples", HealthText(r.health)) +
         SummaryRow(
             "steps",
             fmt::format("load {}, build {} (BVH {} in {}), render {}, write {}",
                         DurationText(job.loaded->load_seconds),
                         DurationText(job.loaded->build_seconds),
                         job.loaded->trees.Origin(),
                         DurationText(job.loaded->trees.seconds), DurationText(r.seconds),
                         DurationText(report.write_seconds))) +
         SummaryRow("machine", MachineText(ThisMachine())) +
         SummaryRow(
             "kernels",
             fmt::format("{}, {} lanes, {} threads; wavefront {} paths of {} "
                         "bytes",
                         target.name(), target.lanes(), ThreadCount(job.settings.threads),
                         job.plan.wavefront, job.plan.bytes_per_path)) +
         "\n" + StageCostText(r);
}

}  // namespace

std::string MergeSummaryText(const RenderReport& report, const MergedRender& merged,
                             bool verbose) {
  const RunResult& r = report.result;
  std::string text;
  if (!report.exr.empty()) text += ImageRow(report, merged.window);
  text += ErrorRow(report.error) + SpeedRows(r);
  if (merged.missing > 0) {
    text += SummaryRow("missing", fmt::format("{} of {} pixels", merged.missing,
                                              merged.window.pixels()));
  }
  if (merged.seeds.size() > 1) {
    text += SummaryRow("seeds", fmt::format("{}", merged.seeds.size()));
  }
  if (!verbose) return text;
  text += "\n" + SummaryRow("strategy", merged.identity.at("strategy")) +
          SummaryRow("errors", ErrorText(report.error)) + RaysRow(r) +
          SummaryRow("samples", HealthText(r.health));
  for (const MachineInfo& machine : merged.machines) {
    text += SummaryRow("machine", MachineText(machine));
  }
  return text;
}

std::string DiffersRow(const std::vector<Note>& notes) {
  const std::string text = ImageChangesText(notes);
  if (text.empty()) return text;
  return "\n" + Painted(TextStyle::kYellow, "differs", Stream::kOutput) + "    " + text +
         "\n";
}

std::string TransportText(const Job& job) {
  const bool spectral = job.scene.transport() == Transport::kSpectral;
  const std::string name = spectral ? "spectral" : "rgb";
  return job.loaded->transport_why.empty()
             ? name
             : fmt::format("{} ({})", name, job.loaded->transport_why);
}

std::string SummaryText(const RenderReport& report, const Job& job,
                        const SummaryChoice& choice) {
  const RunResult& r = report.result;
  const bool is_part = report.exr.empty() && report.unsampled_pixels > 0 &&
                       !report.has_holes && !choice.checkpoint.empty();
  std::string text = is_part ? PartRow(report, job.window, choice.checkpoint)
                             : ImageRow(report, job.window) + ErrorRow(report.error);
  text += SpeedRows(r) + StrategyRow(r, job, choice.verbose);
  const std::string transport = TransportText(job);
  if (transport.starts_with("spectral")) text += SummaryRow("transport", transport);
  if (r.health.Total() > 0) text += SummaryRow("samples", HealthText(r.health));
  text += NextRow(report, job, choice.checkpoint);
  if (choice.verbose) text += DetailRows(report, job);
  return text + DiffersRow(job.loaded->description.notes);
}

}  // namespace lanelight

#include "src/cli/texts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "src/cli/console.h"

namespace lanelight {
namespace {

std::string ChannelText(const CompareResult& r) {
  std::string text;
  for (std::size_t c = 0; c < r.channels.size(); ++c) {
    text += FactRow("mean " + r.channels[c],
                    fmt::format("{:.6g} against {:.6g}, ratio {:.5f}", r.mean_test[c],
                                r.mean_reference[c], r.mean_ratio[c]));
  }
  return text;
}

// Says how many values differ by more than their noise explains. Mean and deviation of
// the z-scores are in the JSON: they are useful only if images differ by noise.
std::string NoiseText(const ZScores& z) {
  if (!z.available) return FactRow("noise", "unknown: no image carries variances");
  std::string text;
  if (z.count > 0) {
    text = fmt::format(
        "{:.3g} % of {} values differ by more than 2 standard errors (noise alone: 4.55 "
        "%), {:.3g} % by more than 3 (0.27 %)",
        100 * z.beyond_2, z.count, 100 * z.beyond_3);
  }
  const auto add = [&text](std::uint64_t count, const char* what) {
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : "; ", count, what);
  };
  add(z.exact, "are equal without variance");
  add(z.mismatched, "differ without variance");
  add(z.invalid, "have an invalid variance");
  return FactRow("noise", text);
}

std::string NumberText(double value) { return fmt::format("{:.6g}", value); }

std::string MeasuresText(const CompareResult& r) {
  return FactRow("size",
                 fmt::format("{}x{}, {} values compared", r.width, r.height, r.samples)) +
         FactRow("invalid values",
                 fmt::format("{} and {}", r.invalid_test, r.invalid_reference)) +
         FactRow("MSE", NumberText(r.mse)) + FactRow("RMSE", NumberText(r.rmse)) +
         FactRow("relative MSE", fmt::format("{:.6g} (without the worst 0.1 %: {:.6g})",
                                             r.relmse, r.relmse_trimmed)) +
         FactRow("", fmt::format("after filters of 2, 4, 8 pixels: {:.6g}",
                                 fmt::join(r.relmse_filtered, ", "))) +
         FactRow("MAE", NumberText(r.mae)) +
         FactRow("MAPE", fmt::format("{:.4g} %", 100 * r.mape)) +
         FactRow("PSNR", std::isinf(r.psnr) && r.psnr > 0
                             ? "infinite: no difference"
                             : fmt::format("{:.2f} dB", r.psnr)) +
         ChannelText(r) +
         FactRow("tile rel. MSE", fmt::format("median {:.3g}, largest {:.3g}",
                                              r.tile_relmse_median, r.tile_relmse_max)) +
         NoiseText(r.z);
}

std::string FlipText(const char* name, const FlipSummary& s, const std::string& note) {
  return FactRow(
      name,
      fmt::format("mean {:.4g}, weighted median {:.4g} (quartiles {:.4g}, {:.4g}), "
                  "largest {:.4g}{}",
                  s.mean, s.median, s.first_quartile, s.third_quartile, s.max, note));
}

std::string FlipText(const FlipMaps& flip) {
  const std::string ppd = fmt::format("; {:.4g} pixels a degree", flip.pixels_per_degree);
  if (flip.hdr.empty()) return FlipText("FLIP", flip.ldr_summary, ppd);
  return FlipText(
             "FLIP", flip.hdr_summary,
             fmt::format("; {} exposures, 2^{:.2f} to 2^{:.2f}{}", flip.exposures.count,
                         flip.exposures.start, flip.exposures.stop, ppd)) +
         FlipText("FLIP on screen", flip.ldr_summary, "; values clamped to 0 ... 1");
}

}  // namespace

std::string ComparisonText(const ImageComparison& c) {
  std::string text = MeasuresText(c.metrics);
  if (c.flip) text += FlipText(*c.flip);
  text += FactRow("agreement", AgreementText(c.agreement));
  if (!c.agreement.caveat.empty()) text += FactRow("", c.agreement.caveat);
  return text + FactRow("verdict", c.verdict);
}

}  // namespace lanelight

#include "src/cli/compare_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lanelight {
namespace {

std::string ChannelText(const CompareResult& r) {
  std::string text;
  for (std::size_t c = 0; c < r.channels.size(); ++c) {
    text += fmt::format("mean {:<9} {:.6g} against {:.6g}, ratio {:.5f}\n", r.channels[c],
                        r.mean_test[c], r.mean_reference[c], r.mean_ratio[c]);
  }
  return text;
}

std::string ZText(const ZScores& z) {
  if (!z.available) return "z-scores       none: no image carries variances\n";
  return fmt::format(
      "z-scores       mean {:.3f}, deviation {:.3f}, |z|>2: {:.2f} %, |z|>3: {:.2f} % "
      "(noise alone: 0, 1, 4.55 %, 0.27 %)\n"
      "               {} values; {} equal without variance, {} different without "
      "variance, "
      "{} with an invalid variance\n",
      z.mean, z.standard_deviation, 100 * z.beyond_2, 100 * z.beyond_3, z.count, z.exact,
      z.mismatched, z.invalid);
}

std::string MeasuresText(const CompareResult& r) {
  return fmt::format("size           {}x{}, {} values compared\n", r.width, r.height,
                     r.samples) +
         fmt::format("invalid values {} and {}\n", r.invalid_test, r.invalid_reference) +
         fmt::format("MSE            {:.6g}\nRMSE           {:.6g}\n", r.mse, r.rmse) +
         fmt::format("relative MSE   {:.6g} (without the worst 0.1 %: {:.6g})\n",
                     r.relmse, r.relmse_trimmed) +
         fmt::format("  after filters of 2, 4, 8 pixels: {:.6g}\n",
                     fmt::join(r.relmse_filtered, ", ")) +
         fmt::format("MAE            {:.6g}\nMAPE           {:.4g} %\n", r.mae,
                     100 * r.mape) +
         fmt::format("PSNR           {:.2f} dB\n", r.psnr) + ChannelText(r) +
         fmt::format("tile rel. MSE  median {:.3g}, largest {:.3g}\n",
                     r.tile_relmse_median, r.tile_relmse_max) +
         ZText(r.z);
}

std::string FlipText(const char* name, const FlipSummary& s, const std::string& note) {
  return fmt::format(
      "{:<14} mean {:.4g}, weighted median {:.4g} (quartiles {:.4g}, {:.4g}), largest "
      "{:.4g}{}\n",
      name, s.mean, s.median, s.first_quartile, s.third_quartile, s.max, note);
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
  text += fmt::format("agreement      {}\n", AgreementText(c.agreement));
  if (!c.agreement.doubt.empty()) {
    text += fmt::format("               {}\n", c.agreement.doubt);
  }
  return text + fmt::format("verdict        {}\n", c.verdict);
}

}  // namespace lanelight

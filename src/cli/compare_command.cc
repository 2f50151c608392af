// `lanelight compare A B`: how far image A is from image B.
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "src/cli/commands.h"
#include "src/cli/console.h"
#include "src/cli/exit_codes.h"
#include "src/cli/validators.h"
#include "src/core/error.h"
#include "src/core/json_text.h"
#include "src/render/machine_json.h"
#include "src/render/report.h"
#include "src/estimate/metrics.h"
#include "src/image/color_channels.h"

namespace lanelight {
namespace {

struct CompareCommandOptions {
  std::string test, reference;
  bool exact_reference = false, json = false;
  std::optional<double> max_relmse;
};

// An exact reference has no noise: what it says of its variance is not used.
void ForgetVariance(Image& image) {
  constexpr std::string_view kPrefix = "variance.";
  for (std::string& name : image.names) {
    if (name.rfind(kPrefix, 0) == 0) name = "unused." + name;
  }
}

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

std::string Text(const CompareResult& r) {
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

// Invalid values in either image cannot pass a limit.
bool OverLimit(const CompareResult& r, double limit) {
  return !(r.relmse <= limit) || r.invalid_test > 0 || r.invalid_reference > 0;
}

Image ReadColored(const std::string& path) {
  Image image = ReadImage(path);
  if (!ColorChannels(image)) throw InputError(path + ": " + NoColorChannels(image));
  return image;
}

int Compare(const CompareCommandOptions& options) {
  const Image test = ReadColored(options.test);
  Image reference = ReadColored(options.reference);
  if (options.exact_reference) ForgetVariance(reference);
  const CompareResult result = CompareImages(test, reference);
  const bool over = options.max_relmse && OverLimit(result, *options.max_relmse);
  if (options.json) {
    nlohmann::json out = ToJson(result);
    out["schema"] = kReportSchema;
    out["machine"] = ToJson(ThisMachine());
    out["over_limit"] = over;
    Print(DumpJson(out, 2) + "\n");
  } else {
    Print(Text(result));
  }
  if (!over) return kExitGood;
  PrintError(
      fmt::format("over the limit: relative MSE {:.6g} (limit {:.6g}), {} invalid values",
                  result.relmse, *options.max_relmse,
                  result.invalid_test + result.invalid_reference));
  return kExitOverLimit;
}

}  // namespace

void AddCompareCommand(CLI::App& root, Command& chosen) {
  CLI::App* command =
      root.add_subcommand("compare", "Measure how far image A is from image B");
  auto options = std::make_shared<CompareCommandOptions>();
  command->add_option("A", options->test, "Image under test (EXR, PFM, HDR, PNG, ...)")
      ->required()
      ->type_name("");
  command->add_option("B", options->reference, "Image it should equal")
      ->required()
      ->type_name("");
  command->add_flag("--reference", options->exact_reference,
                    "B is exact: z-scores use the variance of A alone");
  command
      ->add_option("--max-relmse", options->max_relmse,
                   "Exit with 4 if the relative MSE exceeds this, or a value is invalid")
      ->transform(ValueFrom(0.0, 1e30))
      ->type_name("X");
  command->add_flag("--json", options->json, "Print JSON");
  command->footer(
      "\nRelative MSE is the mean of (a-b)^2 / (b^2 + 0.01) over pixels and channels.\n"
      "\nExample:\n  lanelight compare box.exr converged.exr --reference --max-relmse "
      "0.01");
  command->callback(
      [options, &chosen] { chosen = [options] { return Compare(*options); }; });
}

}  // namespace lanelight

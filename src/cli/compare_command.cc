// `lanelight compare A B [C...]`: how far images are from the last of them.
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "src/base/core/error.h"
#include "src/base/core/json_text.h"
#include "src/base/image/image.h"
#include "src/cli/commands.h"
#include "src/cli/console.h"
#include "src/cli/exit_codes.h"
#include "src/cli/options.h"
#include "src/cli/render_outputs.h"
#include "src/cli/texts.h"
#include "src/measure/compare/comparison.h"
#include "src/render/job/machine_json.h"
#include "src/render/job/report.h"
#include "src/render/job/saving.h"

namespace lanelight {
namespace {

struct CompareCommandOptions {
  std::string first, second;
  std::vector<std::string> more;
  ComparisonOptions comparison;
  std::string html, png;
  bool json = false;
  std::optional<double> max_relmse;

  // The last one is the reference.
  std::vector<std::string> Paths() const {
    std::vector<std::string> all = {first, second};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
};

// Invalid values in either image cannot pass a limit.
bool OverLimit(const CompareResult& r, double limit) {
  return !(r.relmse <= limit) || r.invalid_test > 0 || r.invalid_reference > 0;
}

NamedImage ReadColored(const std::string& path) {
  NamedImage image = {path, ReadImage(path)};
  if (!ColorChannels(image.image)) {
    throw InputError(path + ": " + NoColorChannels(image.image));
  }
  return image;
}

// An image against the reference, with the path in what is wrong with them.
ImageComparison CompareFiles(const NamedImage& test, const NamedImage& reference,
                             const ComparisonOptions& options) {
  try {
    return Compare(test, reference, options);
  } catch (const InputError& error) {
    throw InputError(
        fmt::format("{} and {}: {}", test.name, reference.name, error.message()));
  }
}

// Returns one comparison as an object, several as a list.
std::string JsonText(const std::vector<ImageComparison>& comparisons,
                     const std::vector<bool>& over) {
  nlohmann::json all = nlohmann::json::array();
  for (std::size_t i = 0; i < comparisons.size(); ++i) {
    all.push_back(ToJson(comparisons[i]));
    all.back()["over_limit"] = bool(over[i]);
  }
  nlohmann::json out =
      all.size() == 1 ? all[0] : nlohmann::json{{"comparisons", std::move(all)}};
  out["schema"] = kReportSchema;
  out["machine"] = ToJson(ThisMachine());
  return DumpJson(out, 2) + "\n";
}

std::string Texts(const std::vector<ImageComparison>& comparisons) {
  if (comparisons.size() == 1) return ComparisonText(comparisons[0]);
  std::string text;
  for (const ImageComparison& c : comparisons) {
    text += fmt::format("{}{} against {}\n{}", text.empty() ? "" : "\n", c.test,
                        c.reference, ComparisonText(c));
  }
  return text;
}

// Writes the page and the picture. False, with a message, if one could not be written.
bool Save(const CompareCommandOptions& options, const std::vector<NamedImage>& tests,
          const NamedImage& reference, const std::vector<ImageComparison>& comparisons) {
  ResultWriter writer;
  if (!options.html.empty()) {
    writer.SaveText(options.html, ComparisonPage(tests, reference, comparisons));
  }
  if (options.png.empty()) return PrintProblems(writer.problems());
  std::vector<SheetRow> rows;
  for (std::size_t i = 0; i < tests.size(); ++i) {
    rows.push_back({tests[i], reference, comparisons[i]});
  }
  const ComparisonSheet sheet = SheetOf(rows);
  std::string path = options.png;
  writer.Save(path, [&](const std::string& to) { WritePng(to, sheet.image); });
  if (!options.json) Print(fmt::format("{}: {}\n", path, SheetText(sheet)));
  return PrintProblems(writer.problems());
}

int ComparisonCode(const CompareCommandOptions& options,
                   const std::vector<ImageComparison>& comparisons,
                   const std::vector<bool>& over) {
  int code = kExitGood;
  for (std::size_t i = 0; i < comparisons.size(); ++i) {
    if (!over[i]) continue;
    const CompareResult& r = comparisons[i].metrics;
    PrintError(fmt::format(
        "{}over the limit: relative MSE {:.6g} (limit {:.6g}), {} invalid values",
        comparisons.size() > 1 ? comparisons[i].test + ": " : "", r.relmse,
        *options.max_relmse, r.invalid_test + r.invalid_reference));
    code = kExitOverLimit;
  }
  return code;
}

int Compare(CompareCommandOptions options) {
  const std::vector<std::string> paths = options.Paths();
  CheckOutputPaths({{options.html, options.png}}, {paths.begin(), paths.end()});
  options.comparison.flip |= !options.html.empty() || !options.png.empty();
  const NamedImage reference = ReadColored(paths.back());
  std::vector<NamedImage> tests;
  std::vector<ImageComparison> comparisons;
  std::vector<bool> over;
  for (std::size_t i = 0; i + 1 < paths.size(); ++i) {
    tests.push_back(ReadColored(paths[i]));
    comparisons.push_back(CompareFiles(tests.back(), reference, options.comparison));
    over.push_back(options.max_relmse &&
                   OverLimit(comparisons.back().metrics, *options.max_relmse));
    // Only the page and the picture want all images at once.
    if (options.html.empty() && options.png.empty()) tests.clear();
  }
  Print(options.json ? JsonText(comparisons, over) : Texts(comparisons));
  if (!Save(options, tests, reference, comparisons)) return kExitBadInput;
  return ComparisonCode(options, comparisons, over);
}

void AddCompareOptions(CLI::App& command, CompareCommandOptions& options) {
  AddOption(command, "A", options.first, "Image under test (EXR, PFM, HDR, PNG, ...)")
      ->required();
  AddOption(command, "B", options.second, "Image to compare with")->required();
  AddOption(command, "C", options.more,
            "More images; the last one is the reference; default: B is the reference");
  command.add_flag("--reference", options.comparison.exact_reference,
                   "Treat the last image as exact (without noise)");
  AddOption(command, "--max-relmse X", options.max_relmse,
            "Exit with 4 if a relative MSE exceeds this, or a value is invalid")
      ->transform(ValueFrom(0.0, 1e30));
  command.add_flag("--flip", options.comparison.flip,
                   "Compute FLIP as well (--html and --png do)");
  AddOption(command, "--ppd X", options.comparison.pixels_per_degree,
            "Pixels per degree of the field of view, for FLIP; default: 67.02 (3840 "
            "pixels on a 0.7 m wide screen at 0.7 m)")
      ->transform(ValueFrom(1.0, 1000.0));
  AddOption(command, "--html FILE", options.html,
            "Write an HTML page with the images and their differences")
      ->check(EndsIn(".html"));
  AddOption(command, "--png FILE", options.png,
            "Write a PNG with the images, their differences and FLIP, one row per image")
      ->check(EndsIn(".png"));
  command.add_flag("--json", options.json, "Print JSON");
}

}  // namespace

void AddCompareCommand(CLI::App& root, Command& chosen) {
  CLI::App* command =
      root.add_subcommand("compare", "Measure how far images are from a reference");
  auto options = std::make_shared<CompareCommandOptions>();
  AddCompareOptions(*command, *options);
  command->footer(
      "\nRelative MSE is the mean of (a-b)^2 / (b^2 + 0.01) over pixels and channels.\n"
      "docs/compare.md says what all measures mean.\n"
      "\nExamples:\n"
      "  lanelight compare box.exr converged.exr --reference --max-relmse 0.01\n"
      "  lanelight compare mis.exr resampled.exr converged.exr --html compare.html");
  command->callback(
      [options, &chosen] { chosen = [options] { return Compare(*options); }; });
}

}  // namespace lanelight

#include "src/measure/compare/comparison.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "src/base/image/image.h"
#include "src/base/stat/values.h"

namespace lanelight {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FlipSummary, mean, first_quartile, median,
                                   third_quartile, max)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FlipExposures, start, stop, count)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ErrorTile, x, y, width, height, relmse, share)

namespace {

constexpr std::size_t kMaxWorstTiles = 6;

FlipMaps FlipOf(const LinearImage& test, const LinearImage& reference, bool high_range,
                double pixels_per_degree) {
  FlipMaps out;
  out.pixels_per_degree = pixels_per_degree;
  out.ldr = LdrFlip(reference, test, pixels_per_degree);
  out.ldr_summary = SummaryOf(out.ldr);
  if (!high_range) return out;
  out.exposures = ExposuresOf(reference);
  out.hdr = HdrFlip(reference, test, out.exposures, pixels_per_degree);
  out.hdr_summary = SummaryOf(out.hdr);
  return out;
}

// Two digits, without an exponent.
std::string Percent(double share) {
  const double percent = 100 * share;
  return percent < 99.5 ? fmt::format("{:.2g} %", percent)
                        : fmt::format("{:.0f} %", percent);
}

// Smaller p-values depend on the assumed distributions.
std::string PText(double p) {
  return p < 1e-12 ? "p < 1e-12" : fmt::format("p = {:.2g}", p);
}

std::string FailureSummary(const Agreement& a) {
  if (a.failed.empty()) return "the mean of the whole image";
  return fmt::format("{} of {} tiles{}", a.failed.size(), a.layout.size(),
                     a.image_failed ? " and the mean of the whole" : "");
}

bool IsEqual(const ImageComparison& c) {
  return c.metrics.samples > 0 && c.metrics.mse == 0 && c.metrics.invalid_test == 0 &&
         c.metrics.invalid_reference == 0;
}

// Returns how much the images differ, and whether noise explains it.
std::string VerdictOf(const ImageComparison& c) {
  const CompareResult& m = c.metrics;
  if (m.samples == 0) return "there is no pixel with a valid value in both images";
  if (IsEqual(c)) return fmt::format("{} equals {} in every value", c.test, c.reference);
  std::string text =
      fmt::format("{} differs from {} by {} (root of the relative MSE{})", c.test,
                  c.reference, Percent(std::sqrt(m.relmse)),
                  c.flip ? fmt::format("; FLIP {:.3g}", c.flip->summary().mean) : "");
  switch (c.agreement.verdict) {
    case AgreementVerdict::kAgree:
      return text + "; the difference is not significant";
    case AgreementVerdict::kDiffer:
      return text +
             fmt::format("; the difference is significant ({})", PText(c.agreement.p));
    case AgreementVerdict::kInconclusive:
      break;
  }
  return text + "; significance unknown: " + c.agreement.why;
}

nlohmann::json FlipJson(const std::optional<FlipMaps>& flip) {
  if (!flip) return nullptr;
  nlohmann::json out = {{"pixels_per_degree", flip->pixels_per_degree},
                        {"ldr", flip->ldr_summary},
                        {"hdr", nullptr},
                        {"exposures", nullptr}};
  if (flip->hdr.empty()) return out;
  out["hdr"] = flip->hdr_summary;
  out["exposures"] = flip->exposures;
  return out;
}

nlohmann::json AgreementJson(const Agreement& a) {
  nlohmann::json tiles = TilesJson(a.layout, a.z);
  tiles["failed"] = a.failed;
  return {{"verdict", Name(a.verdict)},
          {"why", a.why},
          {"doubt", a.caveat},
          {"text", AgreementText(a)},
          {"p", NumberJson(a.p)},
          {"false_alarm", a.level},
          {"tests", a.tests},
          {"untested", a.untested},
          {"image_differs", a.image_failed},
          {"detectable", NumberJson(a.detectable)},
          {"tiles", tiles}};
}

}  // namespace

ImageComparison Compare(const NamedImage& test, const NamedImage& reference,
                        const ComparisonOptions& options) {
  ImageComparison out;
  out.test = test.name;
  out.reference = reference.name;
  out.metrics = CompareImages(test.image, reference.image, options.exact_reference);
  out.agreement = TestAgreement(test.image, reference.image, options.exact_reference);
  const LinearImage a = LinearOf(test.image), b = LinearOf(reference.image);
  out.worst = WorstTiles(a, b, kMaxWorstTiles);
  if (options.flip) {
    out.flip = FlipOf(a, b, !test.image.is_bytes() || !reference.image.is_bytes(),
                      options.pixels_per_degree);
  }
  out.verdict = VerdictOf(out);
  return out;
}

std::string AgreementText(const Agreement& a) {
  const std::string tests = fmt::format("{} tests of equal means, false-alarm rate {}",
                                        a.tests - a.untested, Percent(a.level));
  switch (a.verdict) {
    case AgreementVerdict::kAgree:
      return fmt::format(
          "no significant difference ({}){}", tests,
          std::isfinite(a.detectable)
              ? fmt::format("; smallest detectable difference of the whole image: {}",
                            Percent(a.detectable))
              : "");
    case AgreementVerdict::kDiffer:
      return fmt::format("significant difference in {} ({}; {})", FailureSummary(a),
                         PText(a.p), tests);
    case AgreementVerdict::kInconclusive:
      break;
  }
  return "no test: " + a.why;
}

nlohmann::json ToJson(const ImageComparison& c) {
  nlohmann::json out = ToJson(c.metrics);
  out.update({{"test", c.test},
              {"reference", c.reference},
              {"verdict", c.verdict},
              {"agreement", AgreementJson(c.agreement)},
              {"flip", FlipJson(c.flip)},
              {"worst_tiles", c.worst}});
  return out;
}

}  // namespace lanelight

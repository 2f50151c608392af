#include "src/measure/compare/comparison.h"

#include <fmt/format.h>

#include <cmath>

#include "src/base/image/image.h"

namespace lanelight {
namespace {

constexpr std::size_t kMostWorstTiles = 6;

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

std::string Percent(double share) { return fmt::format("{:.2g} %", 100 * share); }

// Beyond that, distributions are not what they are taken for.
std::string PText(double p) {
  return p < 1e-12 ? "p < 1e-12" : fmt::format("p = {:.2g}", p);
}

std::string WhatFailed(const Agreement& a) {
  if (a.failed.empty()) return "the mean of the whole image";
  return fmt::format("{} of {} tiles{}", a.failed.size(), a.layout.size(),
                     a.image_failed ? " and the mean of the whole" : "");
}

bool IsEqual(const ImageComparison& c) {
  return c.metrics.samples > 0 && c.metrics.mse == 0 && c.metrics.invalid_test == 0 &&
         c.metrics.invalid_reference == 0;
}

// By how much, and whether noise explains it.
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
      return text + ", which their noise explains";
    case AgreementVerdict::kDiffer:
      return text +
             fmt::format(", more than their noise explains ({})", PText(c.agreement.p));
    case AgreementVerdict::kCannotTell:
      break;
  }
  return text + "; it is unknown whether noise explains it: " + c.agreement.why;
}

}  // namespace

ImageComparison Compare(const NamedImage& test, const NamedImage& reference,
                        const ComparisonOptions& options) {
  ImageComparison out;
  out.test = test.name;
  out.reference = reference.name;
  out.metrics = CompareImages(test.image, reference.image,
                              {.exact_reference = options.exact_reference});
  out.agreement = TestAgreement(test.image, reference.image, options.exact_reference);
  const LinearImage a = LinearOf(test.image), b = LinearOf(reference.image);
  out.worst = WorstTiles(a, b, kMostWorstTiles);
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
      return fmt::format("significant difference in {} ({}; {})", WhatFailed(a),
                         PText(a.p), tests);
    case AgreementVerdict::kCannotTell:
      break;
  }
  return "cannot tell: " + a.why;
}

}  // namespace lanelight

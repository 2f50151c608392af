#include "src/measure/compare/agreement.h"

#include <fmt/format.h>
#include <half.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/base/image/image.h"
#include "src/base/stat/distributions.h"
#include "src/base/stat/hypothesis.h"

namespace lanelight {
namespace {

using stat::MeanEstimate;

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

// Largest relative rounding of half floats, the same for all pixels of a smooth area.
constexpr double kHalfRounding = 0x1p-11;

bool HasHalfValues(const Image& image, const std::vector<int>& channels) {
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      for (int c : channels) {
        const float value = image.At(x, y, c);
        if (std::isfinite(value) && float(half(value)) != value) return false;
      }
    }
  }
  return true;
}

// Returns samples per pixel of the reference divided by those of the image; 1 if unknown.
double SamplesRatio(const Image& test, const Image& reference) {
  const double a = NumberAttribute(test, "spp", 0);
  const double b = NumberAttribute(reference, "spp", 0);
  return a > 0 && b > 0 ? b / a : 1;
}

std::string SharedSeed(const Image& test, const Image& reference) {
  const auto text = [](const Image& image, const char* name) {
    const auto found = image.attributes.find(name);
    const auto* value = found == image.attributes.end()
                            ? nullptr
                            : std::get_if<std::string>(&found->second);
    return value != nullptr ? *value : "";
  };
  const std::string seed = text(test, "seed");
  if (seed.empty() || seed != text(reference, "seed")) return "";
  return fmt::format(
      "both images were rendered with seed {}, and their common noise hides differences; "
      "render one of them with another --seed",
      seed);
}

// Tests channels and collects their results.
class AgreementTest {
 public:
  AgreementTest(const Image& test, const Image& reference)
      : ratio_(SamplesRatio(test, reference)) {
    out_.layout = LayoutOf(test.width, test.height);
    out_.z.assign(out_.layout.size(), kNotKnown);
    out_.level = kBiasLevel;
  }

  // Tests the tiles and the whole image. Tiles that may have missed rare samples get the
  // variance of their neighbours.
  void AddChannel(ChannelMeans means, double rounding) {
    const std::vector<MeanEstimate> a = means.test, b = means.reference;
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (means.pixels[i] == 0) {
        Keep(i, kNotKnown, 0);
        continue;
      }
      means.test[i] = WithSurroundings(a, i);
      means.reference[i] = WithSurroundings(b, i);
      const double p = PValue(means.test[i], means.reference[i], rounding);
      Keep(i, p, SignedZ(p, a[i], b[i]));
    }
    const double p = PValue(means.whole_test, means.whole_reference, rounding);
    Keep(a.size(), p, 0);
    wholes_.push_back({means.whole_test, means.whole_reference, !std::isnan(p)});
  }

  Agreement Finish() {
    out_.tests = p_.size();
    out_.untested = std::ranges::count_if(p_, [](double p) { return p != p; });
    out_.detectable = Detectable();
    if (out_.untested == out_.tests) {
      out_.why = "too few bright samples determine their means";
      out_.p = kNotKnown;
      return out_;
    }
    double min_p = 1;
    for (double p : p_) min_p = std::min(min_p, std::isnan(p) ? 1 : p);
    out_.p = std::min(1.0, min_p * double(p_.size()));
    for (std::size_t i : stat::HolmRejections(p_, out_.level)) {
      if (where_[i] == out_.layout.size()) {
        out_.image_failed = true;
      } else {
        out_.failed.push_back(where_[i]);
      }
    }
    std::ranges::sort(out_.failed);
    out_.failed.erase(std::unique(out_.failed.begin(), out_.failed.end()),
                      out_.failed.end());
    out_.verdict = out_.failed.empty() && !out_.image_failed ? AgreementVerdict::kAgree
                                                             : AgreementVerdict::kDiffer;
    return out_;
  }

 private:
  struct Whole {
    MeanEstimate test, reference;
    bool tested;
  };

  // Replaces the variance by that of the neighbouring tiles if that is larger.
  MeanEstimate WithSurroundings(const std::vector<MeanEstimate>& tiles,
                                std::size_t i) const {
    const MeanEstimate around = VarianceAround(out_.layout, tiles, i);
    if (tiles[i].variance >= around.variance) return tiles[i];
    return {tiles[i].mean, around.variance, around.dof};
  }

  double PValue(const MeanEstimate& a, const MeanEstimate& b, double rounding) const {
    if (!HasEnoughObservations(a, b, ratio_) ||
        !HasEnoughObservations(b, a, 1 / ratio_)) {
      return kNotKnown;
    }
    return stat::WelchPValue(a, b, rounding * std::abs(b.mean));
  }

  void Keep(std::size_t tile, double p, double z) {
    p_.push_back(p);
    where_.push_back(tile);
    if (tile == out_.z.size() || std::isnan(p)) return;
    if (!(std::abs(z) <= std::abs(out_.z[tile]))) out_.z[tile] = z;
  }

  // Returns the largest of the channels' smallest detectable differences.
  double Detectable() const {
    double max_difference = 0;
    for (const Whole& w : wholes_) {
      if (!w.tested) return kNotKnown;
      const MeanEstimate pair[] = {w.test, w.reference};
      const MeanEstimate half_sum = stat::Average({pair[0], pair[1]});
      const double t =
          stat::StudentTwoSidedQuantile(out_.level / double(p_.size()), half_sum.dof);
      max_difference = std::max(max_difference, 2 * t * std::sqrt(half_sum.variance) /
                                                    std::abs(w.reference.mean));
    }
    return max_difference;
  }

  Agreement out_;
  const double ratio_;
  std::vector<double> p_;
  std::vector<std::size_t>
      where_;  // tile of each p_; the number of tiles for the whole image
  std::vector<Whole> wholes_;
};

Agreement Inconclusive(const Image& test, const std::string& why) {
  Agreement out;
  out.why = why;
  out.level = kBiasLevel;
  out.p = out.detectable = kNotKnown;
  out.layout = LayoutOf(test.width, test.height);
  out.z.assign(out.layout.size(), kNotKnown);
  return out;
}

}  // namespace

std::string Name(AgreementVerdict verdict) {
  constexpr const char* kNames[] = {"agree", "differ", "cannot tell"};
  return kNames[int(verdict)];
}

Agreement TestAgreement(const Image& test, const Image& reference, bool exact_reference) {
  const NoisyChannels a = FindNoisyChannels(test), b = FindNoisyChannels(reference);
  if (a.variances.empty() && b.variances.empty() && !exact_reference) {
    return Inconclusive(test, "neither image has variances");
  }
  if (a.variances.empty()) return Inconclusive(test, "the first image has no variances");
  if (b.variances.empty() && !exact_reference) {
    return Inconclusive(
        test, "the reference has no variances (--reference treats it as exact)");
  }
  if (a.colors.size() != b.colors.size()) {
    return Inconclusive(test, "one image is grey, the other is not");
  }
  const bool rounded = (!test.is_bytes() && HasHalfValues(test, a.colors)) ||
                       reference.is_bytes() || HasHalfValues(reference, b.colors);
  AgreementTest tests(test, reference);
  for (std::size_t c = 0; c < a.colors.size(); ++c) {
    tests.AddChannel(MeansOf({test, a, c}, {reference, b, c, exact_reference},
                             LayoutOf(test.width, test.height)),
                     rounded ? kHalfRounding : kFloatRounding);
  }
  Agreement out = tests.Finish();
  if (out.verdict == AgreementVerdict::kAgree) out.caveat = SharedSeed(test, reference);
  return out;
}

}  // namespace lanelight

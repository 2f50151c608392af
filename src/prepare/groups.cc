#include "src/prepare/groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "src/prepare/pmj02.h"
#include "src/prepare/parameters.h"

namespace lanelight {
namespace {

constexpr std::uint32_t kMostGroup = 1u << 20;

// Chooses among group sizes by the predicted variance of the sum of a pixel's samples, in
// units of the variance of one: that of the complete groups, and that of the samples left
// over, which are a random part of a group.
class BestSize {
 public:
  explicit BestSize(std::uint64_t spp) : spp_(spp) {}

  /// `variance` of the sum of a group of n samples.
  void Consider(std::uint64_t n, double variance) {
    const std::uint64_t groups = spp_ > 0 ? spp_ / n : 1;
    const double left = spp_ > 0 ? double(spp_ % n) : 0;
    double sum = double(groups) * variance + left * (1 - left / double(n));
    if (spp_ == 0) sum /= double(n);
    if (sum >= least_) return;
    least_ = sum;
    size_ = static_cast<std::uint32_t>(n);
  }
  std::uint32_t size() const { return size_; }

 private:
  std::uint64_t spp_;
  double least_ = INFINITY;
  std::uint32_t size_ = 1;
};

// a x b strata: what is left of the variance of linear functions is a mean of 1 / a^2 and
// 1 / b^2.
std::uint32_t GridSize(std::uint64_t wanted, std::uint64_t spp) {
  BestSize best(spp);
  const auto root = static_cast<std::uint64_t>(std::sqrt(double(wanted)));
  for (std::uint64_t a = (root + 3) / 4; a <= root; ++a) {
    for (std::uint64_t b = a; b <= std::min(4 * a, wanted / a); ++b) {
      best.Consider(a * b, 0.5 * (double(b) / double(a) + double(a) / double(b)));
    }
  }
  return best.size();
}

// The error ends with the blocks of 2^a and 3^b points that the group consists of: n
// times the RMSE measured 0.25 sqrt(2^-a + 3^-b) for the product of the coordinates,
// whose standard deviation is 0.22, and at most 0.27.
std::uint32_t HaltonSize(std::uint64_t wanted, std::uint64_t spp) {
  BestSize best(spp);
  for (std::uint64_t n = wanted; n > wanted / 4; --n) {
    double error2 = 1, error3 = 1;
    for (std::uint64_t rest = n; rest % 2 == 0; rest /= 2) error2 /= 2;
    for (std::uint64_t rest = n; rest % 3 == 0; rest /= 3) error3 /= 3;
    best.Consider(n, 1.3 * std::min(1.0, error2 + error3));
  }
  return best.size();
}

}  // namespace

std::uint32_t MostGroupSize(Points points) {
  if (points == Points::kIndependent) return 1;
  return points == Points::kPmj02 ? kPmj02Points : kMostGroup;
}

std::uint32_t PointsGroupSize(Points points, std::uint64_t spp) {
  const std::uint64_t wanted =
      std::clamp<std::uint64_t>(spp > 0 ? spp / 4 : 64, 1, MostGroupSize(points));
  switch (points) {
    case Points::kIndependent:
      return 1;
    case Points::kSobol:
    case Points::kPmj02:
      return static_cast<std::uint32_t>(std::bit_floor(wanted));
    case Points::kHalton:
      return HaltonSize(wanted, spp);
    case Points::kLattice:
      return static_cast<std::uint32_t>(wanted);
    case Points::kStratified:
    case Points::kCmj:
      return GridSize(wanted, spp);
  }
  return 1;
}

std::uint32_t GroupSize(const Strategy& strategy, std::uint64_t spp) {
  const bool pairs = strategy.pairs == Pairs::kAntithetic;
  const std::uint64_t share =
      pairs && spp > 0 ? std::max<std::uint64_t>(spp / 2, 1) : spp;
  return PointsGroupSize(strategy.points, share) * (pairs ? 2 : 1);
}

namespace {

// What the group size costs against one net of all samples.
std::string LossText(const Strategy& strategy, std::uint64_t spp, std::uint32_t own) {
  const std::uint32_t pairs = strategy.pairs == Pairs::kAntithetic ? 2 : 1;
  std::string text;
  if (own == 1) {
    return fmt::format(", not stratified (that takes {} samples): as independent",
                       8 * pairs);
  }
  if (own == MostGroupSize(strategy.points)) {
    text += fmt::format(", {} being the most that are stratified together", own);
  }
  if (spp % (own * pairs) != 0) {
    text += fmt::format(", {} left over in an incomplete one, less well stratified",
                        spp % (own * pairs));
  }
  return text;
}

}  // namespace

std::string PointsText(const Strategy& strategy, std::uint64_t spp,
                       std::uint32_t group_size) {
  const bool pairs = strategy.pairs == Pairs::kAntithetic;
  const std::uint32_t size = group_size > 0 ? group_size : GroupSize(strategy, spp);
  const std::uint32_t own = size / (pairs ? 2 : 1);
  std::string text = Name(strategy.points);
  if (strategy.points != Points::kIndependent) {
    if (spp == 0) {
      text += fmt::format(", randomisations of {} samples", size);
    } else if (own > 1) {
      text += fmt::format(", {} randomisations of {} samples", spp / size, size);
    }
    const PointsParameters p = MakePointsParameters(strategy.points, own);
    if (p.columns.count * p.rows.count > 1) {
      text += fmt::format(" in {}x{} strata", p.columns.count, p.rows.count);
    }
    if (spp > 0) text += LossText(strategy, spp, own);
  }
  if (pairs) text += fmt::format(", antithetic pairs ({})", Name(strategy.paired));
  return text;
}

}  // namespace lanelight

#include "src/base/image/wavelengths.h"

#include <algorithm>
#include <cmath>

#include "src/base/core/check.h"
#include "src/base/image/color_spaces.h"

namespace lanelight {
namespace {

constexpr int kNodes = kLastCarriedNm - kFirstCarriedNm + 1;

// Begin of the second and third segment, nm: of the pairs with increasing edges (485 to
// 490, 570 to 580), one with little noise of saturated colours.
constexpr double kSecondSegment = 488, kThirdSegment = 575;

// Shares of D65 of each channel: per nm, linear between whole ones, and cumulative.
class WhiteFractions {
 public:
  WhiteFractions() {
    for (int i = 0; i < kNodes; ++i) density_[i] = WhiteFraction(kFirstCarriedNm + i);
    for (int i = 1; i < kNodes; ++i) {
      below_[i] = below_[i - 1] + (density_[i - 1] + density_[i]) / 2;
    }
    const Rgb all = below_.back();
    for (Rgb& v : density_) v = {v.x / all.x, v.y / all.y, v.z / all.z};
    for (Rgb& v : below_) v = {v.x / all.x, v.y / all.y, v.z / all.z};
  }

  Rgb Density(double nm) const {
    const auto [i, part] = At(nm);
    return density_[i] * (1 - part) + density_[i + 1] * part;
  }
  Rgb Below(double nm) const {
    const auto [i, part] = At(nm);
    return below_[i] + (density_[i] + Density(nm)) * (part / 2);
  }

 private:
  struct Place {
    std::size_t i;
    double part;
  };
  static Place At(double nm) {
    const double x = std::clamp(nm - kFirstCarriedNm, 0.0, kNodes - 1.0);
    const double whole = std::min(std::floor(x), kNodes - 2.0);
    return {static_cast<std::size_t>(whole), x - whole};
  }

  std::array<Rgb, kNodes> density_;
  std::array<Rgb, kNodes> below_{};
};

const WhiteFractions& Shares() {
  static const WhiteFractions fractions;
  return fractions;
}

Rgb SumBelow(const Vec3d& nm) {
  return Shares().Below(nm.x) + Shares().Below(nm.y) + Shares().Below(nm.z);
}

// Finds three wavelengths whose cumulative shares sum to `wanted`, by damped Newton steps
// from `nm`. The damping matters at both ends of the range.
Vec3d Solve(Vec3d nm, Rgb wanted) {
  constexpr double kDamping = 1e-13, kLongestStep = 5, kNear = 1e-9;
  for (int i = 0; i < 100; ++i) {
    const Rgb miss = wanted - SumBelow(nm);
    const Rgb slope[3] = {Shares().Density(nm.x), Shares().Density(nm.y),
                          Shares().Density(nm.z)};
    ColorMatrix normal;
    Vec3d gradient;
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) {
        normal.row[a][b] = Dot(slope[a], slope[b]) + (a == b ? kDamping : 0);
      }
      gradient[a] = Dot(slope[a], miss);
    }
    const Vec3d step = Inverse(normal) * gradient;
    double longest = 0;
    for (int a = 0; a < 3; ++a) {
      const double moved = std::clamp(step[a], -kLongestStep, kLongestStep);
      nm[a] = std::clamp(nm[a] + moved, double(kFirstCarriedNm), double(kLastCarriedNm));
      longest = std::max(longest, std::abs(moved));
    }
    if (longest < kNear) break;
  }
  return nm;
}

// Weight of a wavelength in the response of the film.
double Weight(double nm) {
  const Rgb fraction = Shares().Density(nm);
  return std::abs(fraction.x) + std::abs(fraction.y) + std::abs(fraction.z) + 1e-12;
}

double WeightedMean(double low, double high, const Spectrum& spectrum) {
  const int steps = std::max(16, static_cast<int>(std::ceil((high - low) * 8)));
  double sum = 0, weights = 0;
  for (int i = 0; i < steps; ++i) {
    const double nm = low + (high - low) * (i + 0.5) / steps;
    sum += Weight(nm) * spectrum(nm);
    weights += Weight(nm);
  }
  return sum / weights;
}

WavelengthBins MakeBins() {
  WavelengthBins bins;
  Vec3d nm = {kFirstCarriedNm, kSecondSegment, kThirdSegment};
  const Rgb first = SumBelow(nm);
  for (int i = 0; i < kTriples; ++i) {
    const double fraction = double(i) / kTriples;
    if (i > 0) nm = Solve(nm, first + Rgb{fraction, fraction, fraction});
    for (int s = 0; s < 3; ++s) bins.edge[s * kTriples + i] = nm[s];
  }
  bins.edge.back() = kLastCarriedNm;
  LL_CHECK(std::is_sorted(bins.edge.begin(), bins.edge.end()));
  for (int b = 0; b < kWavelengthBins; ++b) {
    const double low = bins.edge[b], high = bins.edge[b + 1];
    bins.film[b] = (Shares().Below(high) - Shares().Below(low)) * kTriples;
    bins.centre[b] = WeightedMean(low, high, [](double nm) { return nm; });
  }
  return bins;
}

}  // namespace

const WavelengthBins& CarriedWavelengths() {
  static const WavelengthBins bins = MakeBins();
  return bins;
}

std::vector<float> BinMeans(const Spectrum& spectrum) {
  const WavelengthBins& bins = CarriedWavelengths();
  std::vector<float> means(kWavelengthBins);
  for (int b = 0; b < kWavelengthBins; ++b) {
    means[b] = static_cast<float>(WeightedMean(bins.edge[b], bins.edge[b + 1], spectrum));
  }
  return means;
}

std::vector<float> BinValues(const Spectrum& spectrum) {
  std::vector<float> values;
  for (double nm : CarriedWavelengths().centre) {
    values.push_back(static_cast<float>(spectrum(nm)));
  }
  return values;
}

Rgb ColorOfBins(const std::vector<float>& values) {
  LL_CHECK_EQ(values.size(), std::size_t{kWavelengthBins});
  const WavelengthBins& bins = CarriedWavelengths();
  Rgb sum;
  for (int b = 0; b < kWavelengthBins; ++b) sum += bins.film[b] * double(values[b]);
  return sum / kTriples;
}

}  // namespace lanelight

#include "src/base/image/spectral_buckets.h"

#include <fmt/format.h>

#include <algorithm>

#include "src/base/image/wavelengths.h"

namespace lanelight {
namespace {

double Integral(const Spectrum& spectrum, double low, double high) {
  const int steps = std::max(4, static_cast<int>((high - low) * 8));
  double sum = 0;
  for (int i = 0; i < steps; ++i) sum += spectrum(low + (high - low) * (i + 0.5) / steps);
  return sum * (high - low) / steps;
}

}  // namespace

std::string ChannelName(const SpectralBuckets& buckets, int i) {
  const double middle = (buckets.Edge(i) + buckets.Edge(i + 1)) / 2;
  std::string text = fmt::format("{:.3f}", middle);
  // A dot would separate layers.
  std::replace(text.begin(), text.end(), '.', ',');
  return "S0." + text + "nm";
}

Spectrum WhiteRadiance() {
  const Spectrum d65 = DaylightD65();
  // Integral of the photometric curve over that of D65.
  double unit = 0;
  for (int nm = kFirstCarriedNm; nm <= kLastCarriedNm; ++nm) {
    unit += Luminance(WhiteFraction(nm)) / d65(nm);
  }
  return [d65, unit](double nm) { return d65(nm) * unit; };
}

BucketFractions::BucketFractions(const SpectralBuckets& buckets) {
  const Spectrum white = WhiteRadiance();
  const WavelengthBins& bins = CarriedWavelengths();
  for (int b = 0; b < kWavelengthBins; ++b) {
    begin_.push_back(static_cast<std::uint32_t>(shares_.size()));
    for (int k = 0; k < buckets.count; ++k) {
      const double first = buckets.Edge(k), last = buckets.Edge(k + 1);
      const double low = std::max(first, bins.edge[b]);
      const double high = std::min(last, bins.edge[b + 1]);
      if (low >= high) continue;
      const double carried = std::min(last, double(kLastCarriedNm)) -
                             std::max(first, double(kFirstCarriedNm));
      shares_.push_back({static_cast<std::uint32_t>(k),
                         kTriples * Integral(white, low, high) / carried});
    }
  }
  begin_.push_back(static_cast<std::uint32_t>(shares_.size()));
}

}  // namespace lanelight

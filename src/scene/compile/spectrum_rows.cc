#include "src/scene/compile/spectrum_rows.h"

#include <algorithm>

#include "src/base/core/check.h"
#include "src/base/core/error.h"

namespace lanelight {
namespace {

std::vector<float> Values(const ColorValue& color, ColorBound bound) {
  const bool reflects = bound == ColorBound::kReflectance;
  if (color.spectrum == nullptr) {
    return BinValues(reflects ? UpsampledReflectance(color.constant)
                              : UpsampledColor(color.constant));
  }
  std::vector<float> values = BinMeans(*color.spectrum);
  if (reflects) {
    for (float& v : values) v = std::clamp(v, 0.0f, 1.0f);
  }
  return values;
}

}  // namespace

std::vector<float> LightValues(Rgb color, const OwnSpectrum& spectrum) {
  std::vector<float> values;
  if (spectrum == nullptr) {
    values = BinValues(UpsampledColor(color / Luminance(color)));
  } else {
    const Spectrum d65 = DaylightD65();
    values = BinMeans([&](double nm) { return (*spectrum)(nm) / d65(nm); });
  }
  // What the fit misses of the luminance, and the unit of the spectrum.
  const double luminance = Luminance(ColorOfBins(values));
  if (!(luminance > 0)) {
    throw InputError(fmt::format(
        "a light emits nothing from {} to {} nm, which is what --transport spectral "
        "carries; --transport rgb with Film \"rgb\" renders it",
        kFirstCarriedNm, kLastCarriedNm));
  }
  for (float& v : values) v = static_cast<float>(double(v) / luminance);
  return values;
}

SpectrumRows::SpectrumRows() {
  const WavelengthBins& bins = CarriedWavelengths();
  for (int b = 0; b < kWavelengthBins; ++b) {
    for (int c = 0; c < 3; ++c) {
      table_.film[c].push_back(static_cast<float>(bins.film[b][c]));
    }
    table_.place.push_back(static_cast<float>(SigmoidPlace(bins.centre[b])));
  }
}

std::int32_t SpectrumRows::Intern(const std::vector<float>& row) {
  const auto next = static_cast<std::int32_t>(table_.rows.size() / kWavelengthBins);
  const auto [it, is_new] = rows_.try_emplace(row, next);
  if (is_new) table_.rows.insert(table_.rows.end(), row.begin(), row.end());
  return it->second;
}

std::int32_t SpectrumRows::Of(const ColorValue& color, ColorBound bound) {
  LL_CHECK_EQ(color.texture, kNone);
  return Intern(Values(color, bound));
}

std::int32_t SpectrumRows::OfLight(Rgb color, const OwnSpectrum& spectrum) {
  return Intern(LightValues(color, spectrum));
}

std::int32_t SpectrumRows::OfIndex(const Spectrum& index) {
  const WavelengthBins& bins = CarriedWavelengths();
  const std::size_t row = table_.indices.size() / kWavelengthEdges;
  for (double nm : bins.edge) table_.indices.push_back(static_cast<float>(index(nm)));
  return static_cast<std::int32_t>(row);
}

std::int32_t SpectrumRows::Append(std::initializer_list<std::vector<float>> rows) {
  const auto first = static_cast<std::int32_t>(table_.rows.size() / kWavelengthBins);
  for (const std::vector<float>& row : rows) {
    table_.rows.insert(table_.rows.end(), row.begin(), row.end());
  }
  return first;
}

void SpectrumRows::NeedSigmoids() {
  if (!table_.sigmoids.empty()) return;
  for (const auto& row : PolynomialThrough()) {
    for (double v : row) table_.polynomial.push_back(static_cast<float>(v));
  }
  table_.per_half_tangent =
      static_cast<float>(1 / HalfTangentOfGrey(1 - kLeastUpsampled));
  const std::vector<float>& sigmoids = UpsamplingTable();
  table_.sigmoids.assign(sigmoids.begin(), sigmoids.end());
}

}  // namespace lanelight

// Spectra of constant colours, as rows by bin of wavelengths.
#pragma once

#include <initializer_list>
#include <map>
#include <vector>

#include "src/base/image/upsampling.h"
#include "src/base/image/wavelengths.h"
#include "src/scene/compiled/spectra.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// The bounds of a material's colour.
enum class ColorBound { kReflectance, kUnbounded };

/// Returns, per bin, light of this colour (not black) per unit of luminance, in units of
/// D65. Throws InputError if the spectrum has no energy at the wavelengths of paths.
std::vector<float> LightValues(Rgb color, const OwnSpectrum& spectrum);

/// Collects the rows of a scene; equal ones are kept once.
class SpectrumRows {
 public:
  SpectrumRows();

  /// A colour that has no texture.
  std::int32_t Of(const ColorValue& color, ColorBound bound);
  /// LightValues.
  std::int32_t OfLight(Rgb color, const OwnSpectrum& spectrum);
  /// An index of refraction: a row of SpectrumTable::indices.
  std::int32_t OfIndex(const Spectrum& index);
  /// Rows of a medium, one after the other; returns the first.
  std::int32_t Append(std::initializer_list<std::vector<float>> rows);
  /// Colours come by path as well.
  void NeedSigmoids();

  SpectrumTable Take() { return std::move(table_); }

 private:
  std::int32_t Intern(const std::vector<float>& row);

  SpectrumTable table_;
  std::map<std::vector<float>, std::int32_t> rows_;
};

}  // namespace lanelight

// Spectra of constant colours, as rows by bin of wavelengths.
#pragma once

#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "src/base/image/upsampling.h"
#include "src/base/image/wavelengths.h"
#include "src/scene/compiled/spectra.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// Range of the values of a colour.
enum class ColorBound { kReflectance, kUnbounded };

/// Returns, per bin, light of this colour (not black) per unit of luminance, in units of
/// D65. Throws InputError if the spectrum has no energy at the wavelengths of paths.
std::vector<float> LightValues(Rgb color, const OwnSpectrum& spectrum);

/// Collects the rows of a scene; equal ones are kept once.
class SpectrumRows {
 public:
  SpectrumRows();

  /// Returns the row of a colour without texture.
  std::int32_t Of(const ColorValue& color, ColorBound bound);
  std::int32_t OfLight(Rgb color, const OwnSpectrum& spectrum);
  /// Adds an index of refraction; returns its row in SpectrumTable::indices.
  std::int32_t OfIndex(const Spectrum& index);
  /// Appends the rows of a medium; returns the index of the first.
  std::int32_t Append(std::initializer_list<std::vector<float>> rows);
  /// Adds the tables for colours that vary by path.
  void AddSigmoidTables();

  SpectrumTable Finish() { return std::move(table_); }

 private:
  std::int32_t Intern(const std::vector<float>& row);

  SpectrumTable table_;
  std::map<std::vector<float>, std::int32_t> rows_;
};

/// A material, light or medium with a spectrum or an index by wavelength.
struct SpectrumUser {
  SourceLocation where;
  std::string what;  // "the metal \"spoon\""
  bool disperses = false;
};

/// The first such of the used materials, the lights and the media that glow, or one that
/// disperses if there is any; nothing if all colours are given as such. (Spectra inside
/// textures and of coefficients of media are taken by their colour in any case.)
std::optional<SpectrumUser> FindSpectrum(const SceneDescription& description,
                                         const std::vector<Index>& used);

/// Adds a note, for RGB transport, about the first used glass that disperses.
void NoteDispersion(const SceneDescription& description, const std::vector<Index>& used,
                    std::vector<Note>& notes);

}  // namespace lanelight

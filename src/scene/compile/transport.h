// Finds what of a scene paths with wavelengths need.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/scene/description/description.h"

namespace lanelight {

/// What a spectrum, or an index by wavelength, is the look of.
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

/// Of paths that carry red, green and blue: the first used glass whose index is taken at
/// one wavelength.
void NoteDispersion(const SceneDescription& description, const std::vector<Index>& used,
                    std::vector<Note>& notes);

}  // namespace lanelight

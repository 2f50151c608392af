// What paths that carry wavelengths cannot carry yet, and what others cannot at all.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/scene/description.h"

namespace lanelight {

/// Throws InputError, with the place, for what the description uses and only red, green
/// and blue are known of: grids of colours, media that glow by their temperature, and
/// materials that are measured. `used`: the materials of shapes.
void CheckTransport(const SceneDescription& description, const std::vector<Index>& used);

/// What a spectrum, or an index by wavelength, is the look of.
struct SpectrumUser {
  SourceLocation where;
  std::string what;  // "the metal \"spoon\""
  bool disperses = false;
};

/// The first such of the used materials and the lights, or one that disperses if there is
/// any; nothing if all colours are given as such. (Spectra inside textures and of media
/// are taken by their colour in any case.)
std::optional<SpectrumUser> FindSpectrum(const SceneDescription& description,
                                         const std::vector<Index>& used);

/// Of paths that carry red, green and blue: the first used glass whose index is taken at
/// one wavelength.
void NoteDispersion(const SceneDescription& description, const std::vector<Index>& used,
                    std::vector<Note>& notes);

}  // namespace lanelight

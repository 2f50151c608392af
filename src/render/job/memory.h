// Decides whether a render fits into this machine's memory, before anything is allocated.
#pragma once

#include <cstdint>
#include <string>

#include "src/render/job/settings.h"

namespace lanelight {

/// Layers of a film besides colours, for its memory.
struct FilmLayers {
  Auxiliary auxiliary = Auxiliary::kNone;
  int buckets = 0;  // of wavelengths

  FilmLayers(Auxiliary a, int b = 0) : auxiliary(a), buckets(b) {}  // NOLINT: alike
};
FilmLayers LayersOf(const RenderSettings& settings, const Film& film);

/// Returns the bytes of the film and of the planes of the output file, for any number of
/// samples.
std::uint64_t FilmBytes(const PixelRect& window, const FilmLayers& layers,
                        const Strategy& strategy = {});

/// Returns the memory of the machine, or the limit of a control group or `ulimit -v`.
std::uint64_t PhysicalMemory();

/// Returns "out of memory: ..." with the memory taken and available, in GiB.
std::string OutOfMemoryText();

/// Throws InputError with both numbers if the film does not fit.
void CheckFilmFits(const PixelRect& window, const FilmLayers& layers,
                   const Strategy& strategy, std::uint64_t memory);

}  // namespace lanelight

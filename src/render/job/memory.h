// Decides whether a render fits into this machine's memory, before anything is allocated.
#pragma once

#include <cstdint>
#include <string>

#include "src/render/job/settings.h"

namespace lanelight {

/// What a film has beside colours, as far as its memory goes.
struct FilmLayers {
  Auxiliary auxiliary = Auxiliary::kNone;
  int buckets = 0;  // of wavelengths

  FilmLayers(Auxiliary a, int b = 0) : auxiliary(a), buckets(b) {}  // NOLINT: alike
};
FilmLayers LayersOf(const RenderSettings& settings, const Film& film);

/// Bytes that the film and the planes of the output file take. Independent of the number
/// of samples.
std::uint64_t FilmBytes(const PixelRect& window, const FilmLayers& layers,
                        const Strategy& strategy = {});

/// Memory of the machine, or what a control group or `ulimit -v` limits this process to.
std::uint64_t PhysicalMemory();

/// "out of memory: ..." with what the process has taken, and what there is, in GiB.
std::string OutOfMemoryText();

/// Throws InputError with both numbers if the film does not fit.
void CheckFilmFits(const PixelRect& window, const FilmLayers& layers,
                   const Strategy& strategy, std::uint64_t memory);

}  // namespace lanelight

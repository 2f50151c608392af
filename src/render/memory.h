// Whether a render fits into this machine's memory, before anything is allocated.
#pragma once

#include <cstdint>
#include <string>

#include "src/render/settings.h"

namespace lanelight {

/// Bytes that the film and the planes of the output file take. Independent of the number
/// of samples.
std::uint64_t FilmBytes(const PixelRect& window, Auxiliary auxiliary,
                        const Strategy& strategy = {});

/// Memory of the machine, or what a control group or `ulimit -v` limits this process to.
std::uint64_t PhysicalMemory();

/// "out of memory: ..." with what the process has taken, and what there is, in GiB.
std::string OutOfMemoryText();

/// Throws InputError with both numbers if the film does not fit.
void CheckFilmFits(const PixelRect& window, Auxiliary auxiliary, const Strategy& strategy,
                   std::uint64_t memory);

}  // namespace lanelight

// The seal of a state file: 512 bytes before the HDF5 data (its user block), which show
// that the file is complete before HDF5 reads it. Little-endian:
//
//   0    "lanelight state\n"
//   16   schema
//   24   bytes of the whole file
//   32   XXH3 (64 bits) of everything after these 512 bytes
//   40   zeros
//   504  XXH3 (64 bits) of the 504 bytes before
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace lanelight {

inline constexpr std::size_t kSealBytes = 512;

/// Writes the seal into the first bytes of a whole file in memory.
void Seal(char* file, std::size_t bytes, std::uint64_t schema);

/// Reads the whole file and returns its length. Throws InputError, which begins with
/// `path`, unless it is a state file of `schema` and as it was sealed.
std::uint64_t CheckSeal(int fd, const std::string& path, std::uint64_t schema);

}  // namespace lanelight

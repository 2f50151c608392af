// A built tree as a file. Its arrays stand there as they do in memory, so that reading is
// mapping. Numbers are as the machine has them:
//
//   0     header: magic, byte order, layout, key, length of the file, and of every member
//         of Accel (VisitParts) where it begins, how many elements of how many bytes, and
//         a hash of them; then a hash of the header
//   4096  the members, each at a multiple of 64 bytes, large ones of 4096; at least 64
//         bytes of zeros behind each
//
// A part's hash is XXH3 (64 bits) of the hashes of its mebibytes, which threads find at
// the same time.
#pragma once

#include <string>

#include "src/accel/accel.h"
#include "src/accel/tree_key.h"

namespace lanelight {

/// Raised with every change of what is described above.
inline constexpr std::uint64_t kTreeFileLayout = 1;

/// Whole or not at all (WriteCacheFile). Throws InputError with the system's reason.
void WriteTreeFile(const std::string& path, const TreeKey& key, const Accel& accel);

/// The tree that WriteTreeFile was given. All of the file is read once, to compare the
/// hashes. Throws InputError, which names `path`, for whatever is not a whole file
/// of this key. What somebody has forged, hashes included, is believed.
Accel ReadTreeFile(const std::string& path, const TreeKey& key);

}  // namespace lanelight

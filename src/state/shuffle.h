// The filter "shuffle" of HDF5: all first bytes of the values, then all second bytes, and
// so on. Bytes of the same meaning compress, or can be seen not to.
#pragma once

#include <cstddef>

namespace lanelight {

/// Puts byte b of value i of `values` to planes[b * count + i]. `size` is 4 or 8; the
/// memories do not overlap.
void Shuffle(const void* values, std::size_t size, std::size_t count,
             unsigned char* planes);
/// The inverse.
void Unshuffle(const unsigned char* planes, std::size_t size, std::size_t count,
               void* values);

}  // namespace lanelight

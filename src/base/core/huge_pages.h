// Large memory in large pages: fewer page faults when it is filled, fewer misses of the
// address cache when it is used.
#pragma once

#include <cstddef>
#include <vector>

namespace lanelight {

/// Asks the system to back [data, data + bytes) with large pages where it can, before it
/// is touched. Nothing happens where it cannot.
void AdviseHugePages(void* data, std::size_t bytes);

/// values.resize(size) of an empty vector, in large pages.
template <class T>
void ResizeInHugePages(std::vector<T>& values, std::size_t size) {
  values.reserve(size);
  AdviseHugePages(values.data(), size * sizeof(T));
  values.resize(size);
}

}  // namespace lanelight

// The order in which a ray visits those children of a node that it enters, looked up.
#pragma once

#include <array>
#include <cstdint>

namespace lanelight {

/// For each octant of directions and each set of `lanes` children, their lanes, those
/// that are visited last first (WideNode: slots 0 ^ octant, 1 ^ octant, ... are visited
/// about nearest first), 4 bits each, the first in the lowest. With 4 lanes a node has
/// two parts and the octant's upper bit tells their order.
template <int lanes>
constexpr std::array<std::array<std::uint32_t, 1 << lanes>, lanes> MakeChildOrder() {
  std::array<std::array<std::uint32_t, 1 << lanes>, lanes> order{};
  for (std::uint32_t octant = 0; octant < lanes; ++octant) {
    for (std::uint32_t set = 0; set < 1 << lanes; ++set) {
      int shift = 0;
      for (std::uint32_t k = lanes; k-- > 0;) {
        const std::uint32_t lane = k ^ octant;
        if (!(set >> lane & 1)) continue;
        order[octant][set] |= lane << shift;
        shift += 4;
      }
    }
  }
  return order;
}

/// MakeChildOrder<8>(): 8 KB, of which a render touches a few lines.
inline constexpr auto kChildOrder8 = MakeChildOrder<8>();

/// MakeChildOrder<4>() as bytes for a shuffle of 4 words.
struct alignas(16) ByteOrder {
  std::uint8_t byte[16];
};
constexpr std::array<std::array<ByteOrder, 16>, 4> MakeChildBytes() {
  std::array<std::array<ByteOrder, 16>, 4> bytes{};
  const auto order = MakeChildOrder<4>();
  for (int octant = 0; octant < 4; ++octant) {
    for (int set = 0; set < 16; ++set) {
      for (int i = 0; i < 16; ++i) {
        const std::uint32_t lane = order[octant][set] >> (4 * (i / 4)) & 3;
        bytes[octant][set].byte[i] = static_cast<std::uint8_t>(4 * lane + i % 4);
      }
    }
  }
  return bytes;
}
inline constexpr auto kChildBytes4 = MakeChildBytes();

}  // namespace lanelight

#include "src/render/job/display_packets.h"

#include <bit>
#include <concepts>
#include <cstdint>

#include "src/base/core/check.h"

namespace lanelight {
namespace {

constexpr char kCreateImage = 4, kUpdateImage = 6;
constexpr const char* kChannels[] = {"R", "G", "B"};

class Packet {
 public:
  explicit Packet(char type) : bytes_(4, '\0') { bytes_ += type; }

  template <std::integral T>
  void Add(T value) {
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      bytes_ += static_cast<char>((static_cast<std::uint64_t>(value) >> (8 * i)) & 0xff);
    }
  }
  void Add(float value) { Add(std::bit_cast<std::uint32_t>(value)); }
  void Add(const std::string& text) { bytes_ += text + '\0'; }
  void AddChannels() {
    Add(std::int32_t{3});
    for (const std::string channel : kChannels) Add(channel);
  }
  void Reserve(std::size_t bytes) { bytes_.reserve(bytes_.size() + bytes); }

  /// All of it, with its length.
  std::string Bytes() && {
    for (std::size_t i = 0; i < 4; ++i) {
      bytes_[i] = static_cast<char>((bytes_.size() >> (8 * i)) & 0xff);
    }
    return std::move(bytes_);
  }

 private:
  std::string bytes_;
};

}  // namespace

std::string CreateImagePacket(const std::string& name, int width, int height) {
  Packet packet(kCreateImage);
  packet.Add(std::uint8_t{1});  // it is brought to the front
  packet.Add(name);
  packet.Add(std::int32_t{width});
  packet.Add(std::int32_t{height});
  packet.AddChannels();
  return std::move(packet).Bytes();
}

std::string UpdateImagePacket(const std::string& name, const PixelRect& place,
                              std::span<const float> rgb) {
  LL_CHECK_EQ(rgb.size(), 3 * place.pixels());
  Packet packet(kUpdateImage);
  packet.Reserve(name.size() + 128 + 4 * rgb.size());
  packet.Add(std::uint8_t{0});
  packet.Add(name);
  packet.AddChannels();
  for (const int v : {place.x0, place.y0, place.width(), place.height()}) {
    packet.Add(std::int32_t{v});
  }
  for (std::int64_t offset = 0; offset < 3; ++offset) packet.Add(offset);
  for (int channel = 0; channel < 3; ++channel) packet.Add(std::int64_t{3});
  for (const float value : rgb) packet.Add(value);
  return std::move(packet).Bytes();
}

}  // namespace lanelight

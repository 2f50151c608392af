#include "src/measure/live/token.h"

#include <fmt/format.h>

#include <random>

namespace lanelight::live {

std::string MakeToken() {
  std::random_device device;  // reads the system's, not a generator with a seed
  std::string token;
  for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", device() & 0xffffffffu);
  return token;
}

bool SameToken(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  }
  return difference == 0;
}

}  // namespace lanelight::live

// The header of a PLY file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lanelight {

enum class PlyFormat { kAscii, kBinaryLittle, kBinaryBig };
enum class PlyType {
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kFloat32,
  kFloat64
};

/// Bytes of a value in a binary file.
inline constexpr std::size_t kPlySize[] = {1, 1, 2, 2, 4, 4, 4, 8};
static_assert(std::size(kPlySize) == static_cast<std::size_t>(PlyType::kFloat64) + 1);
constexpr std::size_t PlySize(PlyType type) { return kPlySize[static_cast<int>(type)]; }

struct PlyProperty {
  std::string name;
  bool is_list = false;
  PlyType count_type = PlyType::kUint8;  // of a list
  PlyType type = PlyType::kFloat32;
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  /// Bytes of one element in a binary file at least (lists: empty).
  std::size_t min_bytes() const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements;
  std::size_t body = 0;  // offset of the first byte after the header
  int body_line = 1;     // its line
};

/// Throws InputError with name and line.
PlyHeader ParsePlyHeader(std::string_view bytes, const std::string& name);

}  // namespace lanelight

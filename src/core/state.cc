#include "src/core/state.h"

#include <cstring>

#include "src/core/error.h"

namespace lanelight {
namespace {

// In front of each section: length of the name, size of a value, number of values.
struct Header {
  std::uint32_t name = 0, size = 0;
  std::uint64_t count = 0;
};

}  // namespace

void StateWriter::Append(std::string_view name, const void* values, std::size_t size,
                         std::size_t count) {
  const Header header = {static_cast<std::uint32_t>(name.size()),
                         static_cast<std::uint32_t>(size), count};
  bytes_.append(reinterpret_cast<const char*>(&header), sizeof(header));
  bytes_.append(name);
  bytes_.append(static_cast<const char*>(values), size * count);
}

void StateReader::Take(std::string_view name, void* values, std::size_t size,
                       std::size_t count) {
  Header header;
  if (bytes_.size() < sizeof(header)) Refuse(name);
  std::memcpy(&header, bytes_.data(), sizeof(header));
  bytes_.remove_prefix(sizeof(header));
  if (bytes_.substr(0, header.name) != name || header.name != name.size() ||
      header.size != size || header.count != count) {
    Refuse(name);
  }
  bytes_.remove_prefix(name.size());
  if (bytes_.size() / size < count) Refuse(name);
  if (count > 0) std::memcpy(values, bytes_.data(), size * count);
  bytes_.remove_prefix(size * count);
}

void StateReader::Refuse(std::string_view name) {
  throw InputError(
      fmt::format("the saved state does not fit: expected \"{}\" of this render", name));
}

}  // namespace lanelight

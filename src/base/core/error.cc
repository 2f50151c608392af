#include "src/base/core/error.h"

#include <fmt/format.h>

#include <string_view>

#include "src/base/core/source_location.h"

namespace lanelight {
namespace {

constexpr std::string_view kError = ": error: ";

}  // namespace

std::string SourceLocation::ToString() const {
  if (!file) return "<no file>";
  if (line == 0) return *file;
  return fmt::format("{}:{}:{}", *file, line, column);
}

InputError::InputError(const SourceLocation& where, const std::string& message)
    : std::runtime_error(fmt::format("{}{}{}", where.ToString(), kError, message)),
      place_(where.ToString().size() + kError.size()) {}

InputError::InputError(const std::string& message)
    : std::runtime_error("error: " + message), place_(kError.size() - 2) {}

}  // namespace lanelight

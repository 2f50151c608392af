// A position in the input.
#pragma once

#include <memory>
#include <string>

namespace lanelight {

/// A place in a file. Lines and columns count from 1; 0 = unknown.
struct SourceLocation {
  std::shared_ptr<const std::string> file;
  int line = 0;
  int column = 0;

  /// "file:line:column", as far as known.
  std::string ToString() const;
};

}  // namespace lanelight

#include "src/base/core/version.h"

#include <fmt/format.h>

// Version() and Commit() are written by cmake/write_version.cmake.
namespace lanelight {

std::string Compiler() {
#ifdef __clang__
  return fmt::format("clang {}.{}.{}", __clang_major__, __clang_minor__,
                     __clang_patchlevel__);
#else
  return fmt::format("gcc {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#endif
}

std::string FullVersion() {
  return fmt::format("lanelight {} ({}, {})", Version(), Commit(), Compiler());
}

}  // namespace lanelight

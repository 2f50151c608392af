// Version of the program.
#pragma once

#include <string>

namespace lanelight {

/// "0.1.0"
const char* Version();

/// The commit it was built from, "e0ad31e9c2"; with "-dirty" if files of the checkout
/// were changed, "unknown" if the sources were no checkout.
const char* Commit();

/// "clang 19.1.7"
std::string Compiler();

/// "lanelight 0.1.0 (e0ad31e9c2, clang 19.1.7)"
std::string FullVersion();

}  // namespace lanelight

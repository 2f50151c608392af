// docs/pbrt-format.md as a part of the program: what becomes of every directive, object
// and parameter of pbrt-v4's file format. What is legal is stated by the interpreters
// alone; a test renders a scene for every line of the document and misses in it nothing
// that they take (tests/scene/parse/format_test.cc), so it cannot go stale.
#pragma once

#include <string_view>

namespace lanelight {

/// The document, put in when the library is built (CMakeLists.txt).
std::string_view FormatDocument();

}  // namespace lanelight

// What flags do when they are not given, in their help texts: made of the values that
// they set, so that both are declared once. A flag whose text begins with what it does
// ("Write ...") does not do it without (tests/cli/help_test.cc).
#pragma once

#include <fmt/format.h>

#include <string>

namespace lanelight {

/// "Seconds between states; default: 60".
template <class T>
std::string WithDefault(const std::string& meaning, const T& value) {
  return fmt::format("{}; default: {}", meaning, value);
}

}  // namespace lanelight

// What ends when the user asks for a stop.
#pragma once

#include <stdexcept>

namespace lanelight {

/// Something was given up because a stop was asked for. what() says what.
class Interrupted : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace lanelight

// The message of an expected InputError.
#pragma once

#include <string>

#include "src/base/core/error.h"

namespace lanelight {

/// Returns the message of the InputError that `call` throws, or "" if it throws none.
template <class Call>
std::string InputErrorOf(Call&& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace lanelight

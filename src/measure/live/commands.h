// What a page may ask for, as messages of its socket: JSON objects with a member "do"
// (Session::Do).
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

#include "src/base/core/error.h"

namespace lanelight::live {

inline constexpr int kSlots = 2;  // A and B

/// Bytes of a message, at most.
inline constexpr std::size_t kLongestMessage = 1u << 14;

/// Reads a JSON object whose member "do" is a text. Throws InputError.
nlohmann::json ParseMessage(std::string_view text);

/// Returns an InputError that says what is wrong with a message.
InputError NotUnderstood(const nlohmann::json::exception& error);

/// Returns whether a message can make the current work obsolete.
bool ChangesWork(const nlohmann::json& message);

}  // namespace lanelight::live

// What an image says of itself: `lanelight info IMAGE`.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace lanelight {

/// Throws InputError if it cannot be read.
nlohmann::json ImageInfoJson(const std::string& path);

/// The same, of ImageInfoJson(), for people.
std::string ImageInfoText(const nlohmann::json& info);

}  // namespace lanelight

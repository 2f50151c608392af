// The strategies whose intervals have to hold: all that can be chosen.
#pragma once

#include <string>
#include <vector>

namespace lanelight::bench {

/// The name of the renderer's default in --strategies.
inline constexpr const char* kDefaultName = "default";

/// Returns the default, every choice of every axis alone (in
/// src/vocabulary/strategy/choices.h; with each argument that is a choice of its own),
/// and every preset. What is the default under another name is listed once.
std::vector<std::string> EveryStrategy();

}  // namespace lanelight::bench

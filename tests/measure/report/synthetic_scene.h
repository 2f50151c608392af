// Scenes of a synthetic study.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace lanelight {

/// Efficiencies relative to the baseline, the order by them, ranks from their intervals.
void Rank(nlohmann::json& scene);

/// A scene without strategies.
nlohmann::json BareScene(const std::string& name);

/// A scene of many strategies, most with long names, without images. The first does what
/// two others do; the last is refused; one is heavy-tailed in several words; some renders
/// state no interval.
nlohmann::json CrowdedScene();
inline constexpr int kCrowd = 24;  // strategies that ran

}  // namespace lanelight

// Estimates how likely paths hit lights by chance.
#pragma once

namespace lanelight {

struct PreparedScene;  // src/scene/prepare/prepared_scene.h

/// Returns the probability that a direction meets a lamp, if directions ignore lights
/// (directions=bsdf, uniform): 1 / sum p^2 / s over lights that can be hit. p is a
/// light's share of the power, s the share of all directions that it fills as seen from
/// the middle of the scene. N directions are then worth N times this many hits of one
/// lamp. Returns 1 for other strategies, and if no light can be hit.
double ChanceOfLight(const PreparedScene& scene);

}  // namespace lanelight

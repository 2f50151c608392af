// How likely paths are to meet what shines where nothing leads them there.
#pragma once

namespace lanelight {

struct PreparedScene;  // src/scene/prepare/prepared_scene.h

/// Where directions are drawn without regard to lights (directions=bsdf, uniform), the
/// probability that one meets a lamp: 1 / sum p^2 / s over lights that can be met, p
/// being a light's share of the power and s the share of all directions that it fills as
/// seen from the middle of the scene, which makes N of them as good as N times this many
/// hits of one lamp. 1 for other strategies, and where nothing can be met.
double ChanceOfLight(const PreparedScene& scene);

}  // namespace lanelight

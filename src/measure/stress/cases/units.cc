// Scenes told in other units.
#include "src/measure/stress/cases/cases.h"
#include "src/measure/stress/cases/points.h"
#include "src/measure/stress/cases/scene_text.h"

namespace lanelight::stress {
namespace {

// A sphere of albedo 1/2 under a sky of radiance 1, filling the view: whatever the unit,
// a path that leaves it has half of the sky's light, and none comes back.
std::vector<Point> SphereUnderSky(double unit, const Effort& effort) {
  const std::string camera = CameraText({0, 3 * unit, 0}, {}, 5);
  return {Expect(0.5, SkyScene(camera, 0.5, Sphere({}, unit)), {}, effort)};
}

}  // namespace

void AddUnitCases(std::vector<Case>& cases) {
  const CaseAdder add{cases, "units", Truth::kClosedForm};
  add({"unit-of-length", "the unit of length, from 1e-15 to 1e15",
       "a diffuse sphere of albedo 1/2 under a sky of 1 is 1/2",
       Axis{"unit of length",
            "",
            true,
            1e-15,
            1e15,
            {1e-15, 1e-9, 1e-3, 1, 1e3, 1e9, 1e15},
            {}},
       SphereUnderSky});
}

}  // namespace lanelight::stress

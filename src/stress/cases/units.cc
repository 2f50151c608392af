// Scenes told in other units.
#include <fmt/format.h>

#include "src/stress/cases/cases.h"
#include "src/stress/scene_point.h"

namespace lanelight::stress {
namespace {

// A sphere of albedo 1/2 under a sky of radiance 1, filling the view: whatever the unit,
// a path that leaves it has half of the sky's light, and none comes back.
std::vector<Point> SphereUnderSky(double unit, const Effort& effort) {
  SceneText scene;
  scene.text = fmt::format(
      "LookAt 0 {:.17g} 0  0 0 0  0 0 1\n"
      "Camera \"perspective\" \"float fov\" 5\n"
      "WorldBegin\n"
      "LightSource \"infinite\" \"rgb L\" [1 1 1]\n"
      "Material \"diffuse\" \"rgb reflectance\" [0.5 0.5 0.5]\n"
      "Shape \"sphere\" \"float radius\" {:.17g}\n",
      3 * unit, unit);
  scene.settings.resolution = {8, 8};
  scene.settings.spp = effort(std::uint64_t{64}, std::uint64_t{4096});
  scene.settings.seed = effort.seed;
  Point point = MeanOf(RenderText(scene));
  point.expected = 0.5;
  point.tolerance = 1e-5 * point.expected;
  return {point};
}

}  // namespace

void AddUnitCases(std::vector<Case>& cases) {
  cases.push_back({"unit-of-length", "units", "the unit of length, from 1e-15 to 1e15",
                   "a diffuse sphere of albedo 1/2 under a sky of 1 is 1/2", "",
                   Truth::kClosedForm,
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

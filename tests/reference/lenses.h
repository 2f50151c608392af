// Lenses of the reference tracer: millimetres, spheres about their centres, from the film
// at z = 0 towards +z.
#pragma once

#include <optional>

#include "src/scene/description/description.h"
#include "tests/reference/geometry.h"

namespace lanelight::reference {

class Lenses {
 public:
  /// Focused: a ray from the middle of the film that hardly leaves the axis meets it
  /// again at the focal distance.
  explicit Lenses(const Camera& camera);

  /// The ray that leaves the lenses, or nothing if they stop it.
  std::optional<Ray> Trace(Vec3d from, Vec3d towards) const;
  double rear() const { return surfaces_.front().z; }
  double rear_radius() const { return surfaces_.front().half_diameter; }

 private:
  struct Surface {
    double z, center, radius;  // radius 0: the stop
    double eta_film, eta_scene, half_diameter;
  };
  double Crossing() const;
  std::vector<Surface> surfaces_;
};

}  // namespace lanelight::reference

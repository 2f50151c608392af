#include "src/base/image/film_response.h"

#include <algorithm>

namespace lanelight {

bool FilmResponse::IsIdentity() const {
  return !limits() && matrix.row[0] == Vec3d{1, 0, 0} &&
         matrix.row[1] == Vec3d{0, 1, 0} && matrix.row[2] == Vec3d{0, 0, 1};
}

void LimitColors(const FilmResponse& response, const ColorPlanes& planes,
                 std::size_t count) {
  static const ColorMatrix kXyzFromSrgb = XyzFromSrgb();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d xyz = kXyzFromSrgb * Vec3d{planes.r[i], planes.g[i], planes.b[i]};
    const double largest = std::max({xyz.x, xyz.y, xyz.z});
    if (!(largest > response.max_component)) continue;
    const double factor = response.max_component / largest;
    for (float* plane : {planes.r, planes.g, planes.b}) {
      plane[i] = static_cast<float>(factor * double(plane[i]));
    }
  }
}

void ConvertColors(const FilmResponse& response, const ColorPlanes& planes,
                   std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d c = response.matrix * Vec3d{planes.r[i], planes.g[i], planes.b[i]};
    planes.r[i] = static_cast<float>(c.x);
    planes.g[i] = static_cast<float>(c.y);
    planes.b[i] = static_cast<float>(c.z);
  }
}

}  // namespace lanelight

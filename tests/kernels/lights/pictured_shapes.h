// Emitting shapes of each kind with an image of their radiance, one to a scene, and what
// the reference sees of them.
#pragma once

#include <string>
#include <vector>

#include "src/scene/description/description.h"
#include "src/scene/geometry/geometry.h"
#include "tests/reference/geometry.h"
#include "tests/reference/texture.h"

namespace lanelight::test {

struct PicturedShape {
  std::string name;
  SceneDescription scene;  // with a point light beside it, so that there is a choice
  Vec3d middle;
  double radius;              // of a ball around the middle that holds it
  std::vector<Vec3d> places;  // that it is seen from
  bool solid_angle = false;   // sampled by that where it can be
};

/// Two-sided: a triangle and a rectangle with uneven uv, by area and by solid angle; a
/// ring; a sphere, from outside and inside. The uv of the rectangle's corners are not
/// affine: its halves interpolate them in different ways.
std::vector<PicturedShape> PicturedShapes();

/// Radiance of a pictured shape by the reference: its own intersections, interpolation by
/// barycentric weights, and images.
class PictureTruth {
 public:
  explicit PictureTruth(const PicturedShape& shape);
  PictureTruth(const PictureTruth&) = delete;
  /// From a place towards unit d; black if the shape is not met.
  Rgb Along(Vec3d from, Vec3d d) const;

 private:
  Rgb radiance_;
  std::vector<Texture> images_;
  reference::Textures textures_;
  reference::Geometry geometry_;
};

}  // namespace lanelight::test

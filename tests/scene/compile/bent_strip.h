// A scene whose compiled form has much to get wrong, for the tests of the compiler.
#pragma once

#include "src/scene/description/description.h"
#include "tests/scene/compile/testing.h"

namespace lanelight {

/// A bent strip of three triangles, with normals tilted to the chosen side: 1 or -1; 0:
/// without.
inline TriangleMesh Strip(int normal_side) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0.3}, {1, 1, 0}, {0, 1.2, 0.1}, {-0.5, 0.5, 0.7}};
  mesh.indices = {0, 1, 2, 0, 2, 3, 0, 3, 4};
  if (normal_side == 0) return mesh;
  const double s = normal_side;
  mesh.normals = {{-0.3 * s, 0.1 * s, s},
                  {-0.3 * s, 0, 2 * s},
                  {0, 0.2 * s, s},
                  {0.1 * s, 0, 0.8 * s},
                  {0.6 * s, 0, s}};
  return mesh;
}

/// Moves, turns and stretches; one axis by -2 if it mirrors.
inline Transform Skew(bool mirror) {
  return Transform::Translate({3, -2, 5}) * Transform::Rotate(40, {1, 2, 3}) *
         Transform::Scale({mirror ? -2.0 : 2.0, 1, 0.5});
}

/// Strips, an emitting sphere, an instance and a point light, all of them moved by
/// `outer`.
inline SceneDescription Varied(const Transform& outer) {
  SceneDescription d = SquareScene();
  d.shapes[0] = MeshShape(Strip(1), 0);
  d.shapes.push_back(SphereShape(0.7, 0));
  d.shapes[1].world_from_object = Transform::Translate({0.3, 0.2, -1});
  d.shapes[1].area_light = AddAreaLight(d, {});
  for (Shape& shape : d.shapes) shape.world_from_object = outer * shape.world_from_object;
  d.objects.resize(1);
  d.objects[0].shapes.push_back(MeshShape(Strip(0), 0));
  Instance instance;
  instance.object = 0;
  instance.world_from_object = outer * Transform::Rotate(30, {0, 1, 0});
  d.instances.push_back(instance);
  Light light;
  light.from = {1, 2, 3};
  light.emission = {1, 1, 1};
  light.world_from_light = outer;
  d.lights.push_back(light);
  d.camera.world_from_camera = outer * Transform::Translate({0.1, 0.2, -3});
  return d;
}

}  // namespace lanelight

// Small scene descriptions for the tests of the compiler.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "src/base/core/error.h"
#include "src/base/core/source_location.h"
#include "src/scene/compile/compile.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/description/description.h"
#include "src/scene/geometry/geometry.h"
#include "tests/support/input_error.h"

namespace lanelight {

inline SourceLocation At(int line) {
  return {std::make_shared<const std::string>("scene.pbrt"), line, 1};
}

inline Index AddMaterial(SceneDescription& d, Material m) {
  if (m.name.empty()) m.name = "m" + std::to_string(d.materials.size());
  m.where = At(static_cast<int>(d.materials.size()) + 100);
  d.materials.push_back(std::move(m));
  return static_cast<Index>(d.materials.size()) - 1;
}

inline Material OfKind(MaterialKind kind) {
  Material m;
  m.kind = kind;
  return m;
}

inline Index AddTexture(SceneDescription& d, Texture t) {
  d.textures.push_back(std::move(t));
  return static_cast<Index>(d.textures.size()) - 1;
}

inline Index AddAreaLight(SceneDescription& d, AreaLight light) {
  d.area_lights.push_back(std::move(light));
  return static_cast<Index>(d.area_lights.size()) - 1;
}

inline Shape MeshShape(TriangleMesh mesh, Index material) {
  Shape shape;
  shape.kind = ShapeKind::kMesh;
  shape.where = At(10);
  shape.material = material;
  shape.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
  return shape;
}

inline Shape SphereShape(double radius, Index material) {
  Shape shape;
  shape.kind = ShapeKind::kSphere;
  shape.where = At(11);
  shape.material = material;
  shape.radius = radius;
  return shape;
}

inline Shape DiskShape(double radius, Index material) {
  Shape shape = SphereShape(radius, material);
  shape.kind = ShapeKind::kDisk;
  shape.where = At(12);
  return shape;
}

inline Shape PlaneShape(Index material) {
  Shape shape = SphereShape(1, material);
  shape.kind = ShapeKind::kPlane;
  shape.where = At(13);
  return shape;
}

/// The square [-1, 1]^2 at z = 0, facing +z.
inline TriangleMesh Square() {
  TriangleMesh mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

/// A lit diffuse square: the smallest scene with everything.
inline SceneDescription SquareScene() {
  SceneDescription d;
  d.film.width = 4;
  d.film.height = 2;
  d.filter.kind = FilterKind::kBox;
  const Index diffuse = AddMaterial(d, OfKind(MaterialKind::kDiffuse));
  d.shapes.push_back(MeshShape(Square(), diffuse));
  return d;
}

/// what() of the InputError, or "".
inline std::string CompileError(const SceneDescription& d) {
  return InputErrorOf([&] { CompileScene(d); });
}

inline Vec3d Vertex(const TriangleRecord& t, int k) {
  return {t.p[k][0], t.p[k][1], t.p[k][2]};
}
inline Vec3d FaceNormal(const TriangleRecord& t) {
  return Normalize(Cross(Vertex(t, 1) - Vertex(t, 0), Vertex(t, 2) - Vertex(t, 0)));
}

}  // namespace lanelight

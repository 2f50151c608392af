// Pieces of pbrt text that the cases of geometry are made of, and numbers to draw shapes
// and rays from.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "src/core/vec.h"

namespace lanelight::stress {

/// A list of triangles; vertices as they go into the scene file.
struct MeshText {
  std::vector<Vec3d> points;
  std::vector<int> indices;

  /// Adds a triangle, or a quadrilateral a b c d of two, with vertices of its own.
  void AddTriangle(Vec3d a, Vec3d b, Vec3d c);
  void AddQuad(Vec3d a, Vec3d b, Vec3d c, Vec3d d);
  std::string Text() const;
};

/// Closed sphere of triangles that share their vertices.
MeshText SphereMesh(int rings, int segments, Vec3d center, double radius);

/// Square of two triangles across the unit vector `n`.
MeshText SquareMesh(Vec3d center, Vec3d n, double side = 1);

/// A sphere, `Shape "sphere"`, at a centre.
std::string SphereText(Vec3d center, double radius);

/// Camera from `eye` to `look` with the given field of view in degrees.
std::string CameraText(Vec3d eye, Vec3d look, double fov = 45);

/// A scene for tracing rays: diffuse shapes under a sky, seen from `eye` to the origin.
std::string RayScene(const std::string& shapes, Vec3d eye = {0, 0, 5});

/// Diffuse shapes of this albedo under a sky of radiance 1.
std::string SkyScene(const std::string& camera, double albedo, const std::string& shapes);

/// Numbers that are the same on every machine.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : engine_(seed) {}
  /// Uniform in [low, high).
  double operator()(double low, double high);
  /// Uniform on the unit sphere.
  Vec3d Direction();
  /// A direction within the hemisphere about n (of any length), at least `sine` above its
  /// edge.
  Vec3d Above(Vec3d n, double sine = 0);

 private:
  std::mt19937_64 engine_;
};

/// A point of SquareMesh, clear of its rim.
Vec3d PointOfSquare(Draws& draws, Vec3d center, Vec3d n, double side = 1);

/// Two unit vectors across the unit vector n and each other.
struct Across {
  Vec3d u, v;
  explicit Across(Vec3d n);
};

}  // namespace lanelight::stress

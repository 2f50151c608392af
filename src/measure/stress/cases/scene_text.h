// Pieces of pbrt text that the scenes of cases are made of.
#pragma once

#include <string>
#include <vector>

#include "src/base/core/vec.h"

namespace lanelight::stress {

// Values and blocks.

/// `"rgb <parameter>" [v v v]`, after a space.
std::string Grey(const std::string& parameter, double value);
/// "x y z", each followed by a space.
std::string Numbers(Vec3d v);
/// Between AttributeBegin and AttributeEnd.
std::string Block(const std::string& text);

// Cameras, up to "WorldBegin". Images have a box filter.

/// An orthographic camera above the plane z = 0 that sees the square |x|, |y| <= half
/// around the origin under an angle of this cosine. At slant angles the square is made
/// smaller, so that it stays in front of the plane.
std::string ViewOfPlane(double cosine = 1, double half = 1e-3);
/// A perspective camera at `eye` that looks at the origin.
std::string ViewFrom(Vec3d eye, double fov);

/// Only the camera, from `eye` to `look` with the given field of view in degrees; the
/// filter is the usual one.
std::string CameraText(Vec3d eye, Vec3d look, double fov = 45);

// Materials: the words after `Material`.

std::string Diffuse(double albedo);
/// GGX alpha along the two axes, as parameters of a material.
std::string Alphas(double alpha_x, double alpha_y);
/// A metal of this reflectance at normal incidence.
std::string Metal(double reflectance, double alpha_x, double alpha_y);
std::string Glass(double eta, double alpha = 0);

// Lights.

std::string Sky(double radiance);
/// `AreaLightSource "diffuse"` of this radiance.
std::string AreaLightText(double radiance, bool two_sided = false);
/// A sphere that emits and reflects nothing.
std::string SphereLight(Vec3d center, double radius, double radiance);

// Shapes.

/// The plane z = 0 with a material.
std::string Plane(const std::string& material);
/// A sphere at a centre; with a material of its own.
std::string Sphere(Vec3d center, double radius);
std::string Sphere(Vec3d center, double radius, const std::string& material);

/// A list of triangles; vertices as they go into the scene file.
struct MeshText {
  std::vector<Vec3d> points;
  std::vector<int> indices;

  /// Adds a triangle, or a quadrilateral a b c d of two, with vertices of its own.
  void AddTriangle(Vec3d a, Vec3d b, Vec3d c);
  void AddQuad(Vec3d a, Vec3d b, Vec3d c, Vec3d d);
  std::string Text() const;
};

/// The rectangle from (x0, y0) to (x1, y1) at that height, whose normal is up, or down.
std::string Rectangle(Vec3d low, Vec3d high, bool up = true);

// Whole scenes.

/// Diffuse shapes of this albedo under a sky of radiance 1.
std::string SkyScene(const std::string& camera, double albedo, const std::string& shapes);

/// The inside of a sphere of radius 4 that emits `emission` and reflects `albedo`.
std::string Walls(double emission, double albedo, double radius = 4);
/// The same with a camera in it: ClosedRoom() is what it sees.
std::string Room(double emission, double albedo);

/// Sheets of diffuse transmission 1e-3 (and one of the rest) between a sky of radiance 1
/// and the camera: it sees `transmitted`, at most 1.
std::string Sheets(double transmitted);

/// Point lights on a ring above a diffuse plane, whose intensities go through six
/// decades, and what the plane shows of them.
struct LightRing {
  std::string text;
  double expected = 0;
};
LightRing RingOfLights(int lights);

}  // namespace lanelight::stress

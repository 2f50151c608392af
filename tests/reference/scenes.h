// Small scenes for tests, built directly as SceneDescription (no parser), and the builder
// they are made with. All lengths are in scene units, all images have box filters.
#pragma once

#include <functional>
#include <vector>

#include "src/scene/description/description.h"

namespace lanelight::test {

/// Adds things to a SceneDescription, with pbrt's defaults. Later calls never change what
/// earlier ones added. Every Add returns the index of what it added.
class SceneBuilder {
 public:
  /// A film of width x height pixels, box filter of radius 0.5, max depth 5.
  SceneBuilder(int width, int height);

  SceneBuilder& Depth(int max_depth);
  /// World-space camera; fov of the shorter image axis in degrees.
  SceneBuilder& Perspective(Vec3d eye, Vec3d look, Vec3d up, double fov);
  /// The shorter image axis spans 2 * half_size.
  SceneBuilder& Orthographic(Vec3d eye, Vec3d look, Vec3d up, double half_size);
  SceneBuilder& Lens(double radius, double focal_distance);

  Index AddMaterial(const Material& material);
  Index AddDiffuse(Rgb albedo, Scattering scattering = Scattering::kLambertian);
  /// GGX alpha as given (no remapping); 0 is a mirror.
  Index AddConductor(Rgb eta, Rgb k, double alpha = 0);
  Index AddDielectric(double eta, double alpha = 0);
  Index AddEmission(Rgb radiance, bool two_sided = false);

  Shape& AddSphere(Vec3d center, double radius, Index material, Index light = kNone);
  /// Horizontal through `point` before `rotation` (normal +z), then moved.
  Shape& AddDisk(Vec3d center, Vec3d normal, double radius, Index material,
                 Index light = kNone);
  Shape& AddPlane(Vec3d point, Vec3d normal, Index material);
  /// Parallelogram with normal along Cross(e1, e2).
  Shape& AddQuad(Vec3d corner, Vec3d e1, Vec3d e2, Index material, Index light = kNone);
  Shape& AddMesh(const TriangleMesh& mesh, Index material, Index light = kNone);
  Shape& AddBox(Vec3d low, Vec3d high, Index material);

  void AddPoint(Vec3d from, Rgb intensity);
  void AddSpot(Vec3d from, Vec3d to, Rgb intensity, double cone, double delta);
  /// `toward` points to the light; irradiance on a facing surface.
  void AddDistant(Vec3d toward, Rgb irradiance);
  void AddEnvironment(Rgb radiance);

  SceneDescription& scene() { return scene_; }
  const SceneDescription& Build() const { return scene_; }

 private:
  Shape& Add(Shape shape, Index material, Index light);
  SceneDescription scene_;
};

inline constexpr Rgb Grey(double v) { return {v, v, v}; }

/// A sphere of `material` filling an orthographic image, environment radiance 1. Closed
/// form for diffuse: closed_form::Furnace(albedo, 1) in every pixel.
SceneDescription Furnace(const Material& material, int max_depth, int size = 8);

/// The inside of a sphere that emits 1 and reflects `albedo`. Closed form:
/// closed_form::ClosedRoom(1, albedo, max_depth).
SceneDescription ClosedRoom(double albedo, int max_depth,
                            Scattering scattering = Scattering::kLambertian);
/// The same with a box of 12 triangles.
SceneDescription ClosedBox(double albedo, int max_depth);

/// A plane z = 0 of albedo 0.5, a point light of intensity (1, 2, 3) at height 2 above
/// the middle; orthographic view of [-2, 2]^2 from above. Film position to plane point:
/// FilmPoint. Closed form: closed_form::PointLightOnPlane.
SceneDescription PointOverPlane(Scattering scattering, int size = 16);
/// The same plane under a sphere light of radius 0.5 and radiance 3 at (0.5, 0, 2), which
/// the camera looks through from below its lower end. closed_form::SphereLightIrradiance.
SceneDescription SphereLight(int size = 16);
/// The same plane under the quad light PolygonCorners() of radiance 3.
SceneDescription PolygonLight(int size = 16);
std::vector<Vec3d> PolygonCorners();
/// World point on z = 0 seen at film position (x, y) of a size x size image of these
/// three.
Vec3d FilmPoint(double x, double y, int size);

/// The exact value of a pixel.
using Exact = std::function<Rgb(int x, int y)>;
Exact ConstantImage(double value);
/// Returns the means over pixels of a closed form on the plane of these three scenes, by
/// a midpoint rule that is good to 1e-4.
Exact PixelMean(int size, const std::function<Rgb(Vec3d)>& f);

/// A slab -0.25 <= z <= 0 of glass 1.5, one parallel beam of camera rays at 45 degrees,
/// environment of radiance 1 only: all light is back. Closed form 1 (reflected 2R/(1+R) +
/// transmitted), given depth.
SceneDescription GlassSlab(int max_depth);

/// A small room with one square light of this half width, a diffuse box and a metal ball.
SceneDescription SmallRoom(int size = 16, int max_depth = 4,
                           double light_half_width = 0.4);
/// Plates of a material under a small and a large light, for estimator agreement.
SceneDescription Plate(const Material& material, int size = 8, int max_depth = 3);

/// Materials of every kind, named, for loops over kinds.
std::vector<Material> MaterialZoo();

}  // namespace lanelight::test

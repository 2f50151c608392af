// Brute-force geometry of the reference tracer. Every instance is flattened, and
// triangles are in world space. Spheres, disks, cylinders, planes and curves are
// intersected in their own object space (an affine map keeps the ray parameter). No
// record, bound or tessellation of the renderer is used.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "src/scene/description/description.h"
#include "tests/reference/random.h"

namespace lanelight::reference {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The point of a texture lookup; p and n (unit, either side) in world space.
struct TexturePoint {
  double u = 0, v = 0;
  Vec3d p, n;
};

/// Value of texture `index` at a point.
using TextureLookup = std::function<Rgb(Index index, const TexturePoint& at)>;

/// One triangle, sphere, disk, cylinder, plane or curve, in the world.
struct Primitive {
  ShapeKind kind = ShapeKind::kMesh;
  Index material = kNone;
  Index area_light = kNone;
  int face = 0;  // of the file, which it is a part of: a face of a mesh or a round shape
  FloatValue alpha{1, kNone};
  MediumInterface media;
  double normal_sign = 1;  // -1: turned round
  // kMesh: one triangle.
  std::array<Vec3d, 3> p;                 // world space
  std::optional<std::array<Vec3d, 3>> n;  // world space, unit, on the outer side
  std::array<std::array<double, 2>, 3> uv = {{{0, 0}, {1, 0}, {1, 1}}};
  Vec3d face_normal;     // unit, on the outer side
  double mesh_side = 0;  // SurfacePoint
  // kSphere, kDisk, kCylinder, kPlane, kCurves: in object space.
  Transform world_from_object, object_from_world;
  double radius = 1, inner_radius = 0, height = 0;
  double z_min = -1, z_max = 1, phi_max = 0;  // of what is there; radians
  Curve curve;                                // kCurves: in object space
};

struct Ray {
  Vec3d o, d;        // d is a unit vector
  int from = kNone;  // primitive the origin lies on: never hit again at the origin
};

struct Hit {
  double t = kInfinity;
  int primitive = kNone;
  double b1 = 0, b2 = 0;  // kMesh: barycentric weights of vertices 1 and 2; kCurves: u
};

/// Everything about the surface at a hit.
struct SurfacePoint {
  Vec3d p;
  Vec3d ng, ns;  // unit, outer side; ng agrees in side with ns where ns is interpolated
  Vec3d dpdu, dpdv;  // not normalised
  // Meshes with normals: 1, or -1 where an instance mirrors them; else 0. Bumps on them
  // take ns x dpdu, in the space of the mesh, for dpdv (pbrt-v4).
  double mesh_side = 0;
  double u = 0, v = 0;
};

class Geometry {
 public:
  /// Flattens shapes and instances. Surfaces whose material is `interface` and that
  /// neither emit nor bound a medium are dropped: they do nothing.
  Geometry(const SceneDescription& scene, TextureLookup texture);

  const std::vector<Primitive>& primitives() const { return primitives_; }
  /// Nearest hit in (0, t_max). Surfaces with alpha < 1 are hit with that probability.
  Hit Intersect(const Ray& ray, double t_max, Random& random) const;
  SurfacePoint Describe(const Ray& ray, const Hit& hit) const;
  /// Of the primitive there: what is at least 1 is whole.
  double Alpha(const Ray& ray, const Hit& hit) const;

 private:
  void AddShape(const Shape& shape, const Transform& world_from_group);
  void AddTriangles(const Shape& shape, const Transform& world_from_object,
                    bool mirrored);
  void AddCurves(const Shape& shape, const Transform& world_from_object);
  void TestPrimitive(const Ray& ray, int index, double t_max, Random& random,
                     Hit& nearest) const;

  const SceneDescription& scene_;
  TextureLookup texture_;
  std::vector<Primitive> primitives_;
  int num_faces_ = 0;
};

/// Ray parameters at which the ray meets a primitive, in increasing order, all > 0.
/// At most two; `hits` of a triangle carry barycentric weights.
int IntersectPrimitive(const Primitive& primitive, const Ray& ray, bool origin_on_it,
                       Hit hits[2]);

}  // namespace lanelight::reference

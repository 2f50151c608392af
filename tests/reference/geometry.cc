#include "tests/reference/geometry.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "src/base/core/check.h"
#include "tests/reference/curves.h"

namespace lanelight::reference {

Geometry::Geometry(const SceneDescription& scene, TextureLookup texture)
    : scene_(scene), texture_(std::move(texture)) {
  for (const Shape& shape : scene.shapes) AddShape(shape, Transform());
  for (const Instance& instance : scene.instances) {
    for (const Shape& shape : scene.objects.at(instance.object).shapes) {
      AddShape(shape, instance.world_from_object);
    }
  }
}

void Geometry::AddShape(const Shape& shape, const Transform& world_from_group) {
  const bool emits = shape.area_light != kNone;
  if (!emits && !shape.media.IsTransition() &&
      scene_.materials.at(shape.material).kind == MaterialKind::kInterface)
    return;
  const Transform world_from_object = world_from_group * shape.world_from_object;
  if (shape.kind == ShapeKind::kMesh) {
    return AddTriangles(shape, world_from_object, world_from_group.SwapsHandedness());
  }
  if (shape.kind == ShapeKind::kCurves) return AddCurves(shape, world_from_object);
  LL_CHECK(!(emits && shape.kind == ShapeKind::kPlane));
  Primitive out;
  out.kind = shape.kind;
  out.material = shape.material;
  out.area_light = shape.area_light;
  out.media = shape.media;
  out.face = num_faces_++;
  out.alpha = shape.alpha;
  // Normals of round shapes are turned by a mirroring transform of their own as well.
  const bool turned =
      shape.reverse_orientation != shape.world_from_object.SwapsHandedness();
  out.normal_sign = turned ? -1 : 1;
  out.world_from_object = world_from_object;
  out.object_from_world = world_from_object.Inverse();
  out.radius = shape.radius;
  out.inner_radius = shape.inner_radius;
  out.height = shape.height;
  const double maximum = shape.kind == ShapeKind::kCylinder ? kInfinity : shape.radius;
  out.z_min = std::max(shape.z_min, -maximum);
  out.z_max = std::min(shape.z_max, maximum);
  out.phi_max = shape.phi_max / 360 * (2 * std::numbers::pi);
  primitives_.push_back(out);
}

void Geometry::AddTriangles(const Shape& shape, const Transform& world_from_object,
                            bool mirrored) {
  const TriangleMesh& mesh = *shape.mesh;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    Primitive out;
    out.material = shape.material;
    out.area_light = shape.area_light;
    out.media = shape.media;
    const bool continues = !mesh.continues.empty() && mesh.continues[i / 3];
    out.face = continues ? num_faces_ - 1 : num_faces_++;
    out.alpha = shape.alpha;
    out.normal_sign = shape.reverse_orientation ? -1 : 1;
    std::array<Vec3d, 3> normals;
    std::array<Vec3d, 3> object;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t index = mesh.indices[i + k];
      object[k] = mesh.positions.at(index);
      out.p[k] = world_from_object.Point(object[k]);
      if (!mesh.uvs.empty()) out.uv[k] = mesh.uvs.at(index);
      if (!mesh.normals.empty()) {
        normals[k] =
            out.normal_sign * Normalize(world_from_object.Normal(mesh.normals.at(index)));
      }
    }
    // The outer side is that of the object-space normal, also under a mirroring map.
    const Vec3d face = Cross(object[1] - object[0], object[2] - object[0]);
    out.face_normal = out.normal_sign * Normalize(world_from_object.Normal(face));
    if (!mesh.normals.empty()) {
      out.n = normals;
      out.mesh_side = mirrored ? -1 : 1;
    }
    primitives_.push_back(out);
  }
}

void Geometry::AddCurves(const Shape& shape, const Transform& world_from_object) {
  Primitive out;
  out.kind = shape.kind;
  out.material = shape.material;
  out.world_from_object = world_from_object;
  out.object_from_world = world_from_object.Inverse();
  const bool turned =
      shape.reverse_orientation != shape.world_from_object.SwapsHandedness();
  for (const Curve& curve : *shape.curves) {
    out.face = num_faces_++;
    out.curve = curve;
    for (Vec3d& n : out.curve.normal) n = (turned ? -1. : 1.) * n;
    primitives_.push_back(out);
  }
}

double Geometry::Alpha(const Ray& ray, const Hit& hit) const {
  const FloatValue& alpha = primitives_[hit.primitive].alpha;
  if (alpha.texture == kNone) return alpha.constant;
  LL_CHECK(texture_ != nullptr);
  const SurfacePoint at = Describe(ray, hit);
  return texture_(alpha.texture, {at.u, at.v, at.p, at.ng}).x;
}

void Geometry::TestPrimitive(const Ray& ray, int index, double t_max, Random& random,
                             Hit& nearest) const {
  Hit hits[2];
  const int count = IntersectPrimitive(primitives_[index], ray, ray.from == index, hits);
  for (int i = 0; i < count; ++i) {
    hits[i].primitive = index;
    if (hits[i].t >= std::min(nearest.t, t_max)) return;
    const double alpha = Alpha(ray, hits[i]);
    if (alpha >= 1 || random.Uniform() < alpha) {
      nearest = hits[i];
      return;
    }
  }
}

Hit Geometry::Intersect(const Ray& ray, double t_max, Random& random) const {
  Hit nearest;
  for (int i = 0; i < static_cast<int>(primitives_.size()); ++i) {
    TestPrimitive(ray, i, t_max, random, nearest);
  }
  return nearest;
}

}  // namespace lanelight::reference

// Ray against one primitive, and the surface at a hit. Textbook formulas in double
// precision; a ray never meets again the point it starts on, because the primitive it
// starts on is known: planar ones are left out, a sphere loses its root at zero.
#include <numbers>

#include "tests/reference/curves.h"
#include "tests/reference/frame.h"
#include "tests/reference/geometry.h"

namespace lanelight::reference {
namespace {

// Solves o + t d = p0 + b1 e1 + b2 e2 by Cramer's rule on the columns (-d, e1, e2).
int IntersectTriangle(const Primitive& triangle, const Ray& ray, Hit& hit) {
  const Vec3d e1 = triangle.p[1] - triangle.p[0], e2 = triangle.p[2] - triangle.p[0];
  const Vec3d s = ray.o - triangle.p[0];
  const Vec3d normal = Cross(e1, e2);
  const double det = -Dot(ray.d, normal);
  if (det == 0) return 0;
  const Vec3d q = Cross(s, ray.d);
  hit.t = Dot(s, normal) / det;
  hit.b1 = Dot(e2, q) / det;
  hit.b2 = -Dot(e1, q) / det;
  return hit.t > 0 && hit.b1 >= 0 && hit.b2 >= 0 && hit.b1 + hit.b2 <= 1;
}

constexpr double kTurn = 2 * std::numbers::pi;

// The angle about z from x, in [0, 2 pi).
double PhiOf(Vec3d o) {
  const double phi = std::atan2(o.y, o.x);
  return phi < 0 ? phi + kTurn : phi;
}

// x^2 + y^2 = r^2: the same quadratic as below, in two dimensions.
int IntersectCylinder(double radius, Vec3d o, Vec3d d, bool origin_on_it, Hit hits[2]) {
  const double a = d.x * d.x + d.y * d.y, b = o.x * d.x + o.y * d.y;
  if (a == 0) return 0;
  if (origin_on_it) {
    hits[0].t = -2 * b / a;
    return hits[0].t > 0;
  }
  const double nearest = std::abs(o.x * d.y - o.y * d.x) / std::sqrt(a);
  if (nearest > radius) return 0;
  const double root = std::sqrt((radius - nearest) * (radius + nearest) / a);
  int count = 0;
  for (const double t : {-b / a - root, -b / a + root}) {
    if (t > 0) hits[count++].t = t;
  }
  return count;
}

// Leaves of `count` hits those where the shape is.
int KeepParts(const Primitive& shape, Vec3d o, Vec3d d, int count, Hit hits[2]) {
  int kept = 0;
  for (int i = 0; i < count; ++i) {
    const Vec3d p = o + hits[i].t * d;
    const bool in_phi = shape.phi_max >= kTurn || PhiOf(p) <= shape.phi_max;
    const bool has_heights = shape.kind != ShapeKind::kDisk;
    const bool whole = shape.z_min <= -shape.radius && shape.z_max >= shape.radius &&
                       shape.kind == ShapeKind::kSphere;
    const bool in_z = !has_heights || whole || (p.z >= shape.z_min && p.z <= shape.z_max);
    if (in_phi && in_z) hits[kept++] = hits[i];
  }
  return kept;
}

// |o + t d|^2 = r^2, i.e. a t^2 + 2 b t + c = 0. The discriminant is taken from the point
// of the line nearest to the centre, which stays exact when the sphere is far away.
int IntersectSphere(double radius, Vec3d o, Vec3d d, bool origin_on_it, Hit hits[2]) {
  const double a = Dot(d, d), b = Dot(o, d);
  if (origin_on_it) {
    hits[0].t = -2 * b / a;
    return hits[0].t > 0;
  }
  const double nearest = Length(o - (b / a) * d);
  if (nearest > radius) return 0;
  const double root = std::sqrt(a * (radius - nearest) * (radius + nearest));
  const double q = b > 0 ? -b - root : -b + root;  // no cancellation
  double t0 = q / a, t1 = q == 0 ? 0 : (Length(o) - radius) * (Length(o) + radius) / q;
  if (t0 > t1) std::swap(t0, t1);
  int count = 0;
  if (t0 > 0) hits[count++].t = t0;
  if (t1 > 0) hits[count++].t = t1;
  return count;
}

int IntersectFlat(const Primitive& flat, Vec3d o, Vec3d d, Hit& hit) {
  const double height = flat.kind == ShapeKind::kDisk ? flat.height : 0;
  if (d.z == 0) return 0;
  hit.t = (height - o.z) / d.z;
  if (!(hit.t > 0)) return 0;
  if (flat.kind == ShapeKind::kPlane) return 1;
  const double r = std::hypot(o.x + hit.t * d.x, o.y + hit.t * d.y);
  return r <= flat.radius && r >= flat.inner_radius;
}

SurfacePoint DescribeTriangle(const Primitive& triangle, const Hit& hit) {
  const double b0 = 1 - hit.b1 - hit.b2;
  const auto mix = [&](const auto& a, const auto& b, const auto& c) {
    return b0 * a + hit.b1 * b + hit.b2 * c;
  };
  SurfacePoint out;
  out.p = mix(triangle.p[0], triangle.p[1], triangle.p[2]);
  out.u = mix(triangle.uv[0][0], triangle.uv[1][0], triangle.uv[2][0]);
  out.v = mix(triangle.uv[0][1], triangle.uv[1][1], triangle.uv[2][1]);
  out.ng = out.ns = triangle.face_normal;
  if (triangle.n) {
    const auto& n = *triangle.n;
    const Vec3d ns = Normalize(mix(n[0], n[1], n[2]));
    if (Length(ns) > 0) out.ns = ns;
    if (Dot(out.ng, out.ns) < 0) out.ng = -out.ng;
  }
  // p(u, v) is affine: e1 = du1 dpdu + dv1 dpdv, e2 = du2 dpdu + dv2 dpdv.
  const Vec3d e1 = triangle.p[1] - triangle.p[0], e2 = triangle.p[2] - triangle.p[0];
  const double du1 = triangle.uv[1][0] - triangle.uv[0][0];
  const double dv1 = triangle.uv[1][1] - triangle.uv[0][1];
  const double du2 = triangle.uv[2][0] - triangle.uv[0][0];
  const double dv2 = triangle.uv[2][1] - triangle.uv[0][1];
  const double det = du1 * dv2 - du2 * dv1;
  if (det != 0) {
    out.dpdu = (dv2 * e1 - dv1 * e2) / det;
    out.dpdv = (du1 * e2 - du2 * e1) / det;
  }
  out.mesh_side = triangle.mesh_side;
  return out;
}

// u = phi / phi_max around z, v from the lowest polar angle (0) to the highest (1), or
// along the axis; disks: v from the rim (0) to the inner edge (1), as in pbrt.
SurfacePoint DescribeQuadric(const Primitive& shape, Vec3d o) {
  SurfacePoint out;
  Vec3d normal = {0, 0, 1}, dpdu = {1, 0, 0}, dpdv = {0, 1, 0};
  const double turns = PhiOf(o) / shape.phi_max;
  if (shape.kind == ShapeKind::kSphere) {
    o = Normalize(o) * shape.radius;
    normal = o / shape.radius;
    dpdu = Vec3d{-o.y, o.x, 0} * shape.phi_max;
    const double across = std::hypot(o.x, o.y);
    out.u = turns;
    const auto polar = [](double z) { return std::acos(std::clamp(z, -1.0, 1.0)); };
    const double low = polar(shape.z_min / shape.radius);
    const double high = polar(shape.z_max / shape.radius);
    dpdv = Vec3d{-o.z * o.x / across, -o.z * o.y / across, across} * (low - high);
    out.v = (polar(normal.z) - low) / (high - low);
  } else if (shape.kind == ShapeKind::kCylinder) {
    normal = Normalize(Vec3d{o.x, o.y, 0});
    o = {shape.radius * normal.x, shape.radius * normal.y, o.z};
    dpdu = Vec3d{-o.y, o.x, 0} * shape.phi_max;
    dpdv = {0, 0, shape.z_max - shape.z_min};
    out.u = turns;
    out.v = (o.z - shape.z_min) / (shape.z_max - shape.z_min);
  } else if (shape.kind == ShapeKind::kDisk) {
    o.z = shape.height;
    dpdu = Vec3d{-o.y, o.x, 0} * shape.phi_max;
    dpdv = Vec3d{-o.x, -o.y, 0} *
           ((shape.radius - shape.inner_radius) / std::hypot(o.x, o.y));
    out.u = turns;
    out.v = (shape.radius - std::hypot(o.x, o.y)) / (shape.radius - shape.inner_radius);
  } else {
    o.z = 0;
    out.u = o.x;
    out.v = o.y;
  }
  out.p = shape.world_from_object.Point(o);
  out.ng = shape.normal_sign * Normalize(shape.world_from_object.Normal(normal));
  out.ns = out.ng;
  out.dpdu = shape.world_from_object.Vector(dpdu);
  out.dpdv = shape.world_from_object.Vector(dpdv);
  return out;
}

}  // namespace

int IntersectPrimitive(const Primitive& primitive, const Ray& ray, bool origin_on_it,
                       Hit hits[2]) {
  if (primitive.kind == ShapeKind::kMesh) {
    return origin_on_it ? 0 : IntersectTriangle(primitive, ray, hits[0]);
  }
  if (primitive.kind == ShapeKind::kCurves) {
    return IntersectPlacedCurve(primitive, ray, hits[0]);
  }
  const Vec3d o = primitive.object_from_world.Point(ray.o);
  const Vec3d d = primitive.object_from_world.Vector(ray.d);
  if (primitive.kind == ShapeKind::kPlane) {
    return origin_on_it ? 0 : IntersectFlat(primitive, o, d, hits[0]);
  }
  int count = 0;
  if (primitive.kind == ShapeKind::kSphere) {
    count = IntersectSphere(primitive.radius, o, d, origin_on_it, hits);
  } else if (primitive.kind == ShapeKind::kCylinder) {
    count = IntersectCylinder(primitive.radius, o, d, origin_on_it, hits);
  } else {
    count = origin_on_it ? 0 : IntersectFlat(primitive, o, d, hits[0]);
  }
  return KeepParts(primitive, o, d, count, hits);
}

SurfacePoint Geometry::Describe(const Ray& ray, const Hit& hit) const {
  const Primitive& primitive = primitives_[hit.primitive];
  if (primitive.kind == ShapeKind::kMesh) return DescribeTriangle(primitive, hit);
  if (primitive.kind == ShapeKind::kCurves) {
    return DescribePlacedCurve(primitive, ray, hit);
  }
  return DescribeQuadric(primitive,
                         primitive.object_from_world.Point(ray.o + hit.t * ray.d));
}

}  // namespace lanelight::reference

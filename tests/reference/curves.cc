#include "tests/reference/curves.h"

#include <algorithm>
#include <cmath>

#include "src/base/core/pi.h"
#include "tests/reference/frame.h"

namespace lanelight::reference {
namespace {

struct Bezier {
  Vec3d p[4];
};

// The halves share their middle point.
void Halve(const Bezier& b, Bezier halves[2]) {
  const Vec3d m0 = (b.p[0] + b.p[1]) / 2, m1 = (b.p[1] + b.p[2]) / 2,
              m2 = (b.p[2] + b.p[3]) / 2;
  const Vec3d n0 = (m0 + m1) / 2, n1 = (m1 + m2) / 2, middle = (n0 + n1) / 2;
  halves[0] = {{b.p[0], m0, n0, middle}};
  halves[1] = {{middle, n1, m2, b.p[3]}};
}

// Bernstein polynomials.
Vec3d PointAt(const Vec3d p[4], double u) {
  const double w = 1 - u;
  return w * w * w * p[0] + 3 * w * w * u * p[1] + 3 * w * u * u * p[2] +
         u * u * u * p[3];
}
Vec3d SlopeAt(const Vec3d p[4], double u) {
  const double w = 1 - u;
  return 3.0 *
         (w * w * (p[1] - p[0]) + 2 * w * u * (p[2] - p[1]) + u * u * (p[3] - p[2]));
}

double DotAcross(Vec3d a, Vec3d b) { return a.x * b.x + a.y * b.y; }

// Upper bound of the sign changes of c . c', half the change of the squared distance:
// those of the coefficients of its Bernstein form, that of a product (Descartes' rule).
// Coefficients that vanish, as at ends where points coincide, do not count.
struct Changes {
  int count = 0;
  bool falls_first = false;
};
Changes ChangesOf(const Bezier& b) {
  constexpr double kThree[] = {1, 3, 3, 1}, kTwo[] = {1, 2, 1};
  double sum[6] = {};
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 3; ++j) {
      sum[i + j] += kThree[i] * kTwo[j] * DotAcross(b.p[i], b.p[j + 1] - b.p[j]);
    }
  }
  Changes changes;
  double last = 0;
  for (const double coefficient : sum) {
    if (coefficient == 0) continue;
    if (last == 0) changes.falls_first = coefficient < 0;
    changes.count += last * coefficient < 0;
    last = coefficient;
  }
  return changes;
}

Vec3d RibbonNormalAt(const Curve& curve, double u) {
  const double angle =
      std::acos(std::clamp(Dot(curve.normal[0], curve.normal[1]), -1., 1.));
  if (angle < 1e-6) return curve.normal[0];
  return (std::sin((1 - u) * angle) * curve.normal[0] +
          std::sin(u * angle) * curve.normal[1]) /
         std::sin(angle);
}

double WidthSeen(const Curve& curve, double u, Vec3d d) {
  const double width = (1 - u) * curve.width[0] + u * curve.width[1];
  if (curve.type != CurveType::kRibbon) return width;
  return width * std::abs(Dot(RibbonNormalAt(curve, u), d));
}

// z along the ray, which starts at the origin.
struct Search {
  const Curve& curve;
  Vec3d d;
  double widest;
  Hit& nearest;
  int found = 0;

  void Look(const Bezier& b, double u0, double u1, int depth);
  void Bisect(const Bezier& b, double u0, double u1);
};

// The distance falls at the beginning and rises at the end: it is least in between.
void Search::Bisect(const Bezier& b, double u0, double u1) {
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    const bool rises = DotAcross(PointAt(b.p, middle), SlopeAt(b.p, middle)) > 0;
    (rises ? high : low) = middle;
  }
  const Vec3d c = PointAt(b.p, low);
  const double u = u0 + (u1 - u0) * low;
  if (!(std::hypot(c.x, c.y) <= WidthSeen(curve, u, d) / 2)) return;
  // Not the curve that the ray starts on.
  const double radius = ((1 - u) * curve.width[0] + u * curve.width[1]) / 2;
  const Vec3d slope = SlopeAt(b.p, low);
  const double across = std::hypot(slope.x, slope.y) / Length(slope);
  if (!(c.z * across > 1.1 * radius) || c.z >= nearest.t) return;
  nearest.t = c.z;
  nearest.b1 = u;
  found = 1;
}

void Search::Look(const Bezier& b, double u0, double u1, int depth) {
  // All of the piece lies within `size` of its first point.
  double size = 0;
  for (int k = 1; k < 4; ++k) {
    size = std::max(size, std::hypot(b.p[k].x - b.p[0].x, b.p[k].y - b.p[0].y));
  }
  if (std::hypot(b.p[0].x, b.p[0].y) - size > widest / 2) return;
  const Changes changes = ChangesOf(b);
  if (changes.count == 0 || (changes.count == 1 && !changes.falls_first)) return;
  if (changes.count == 1 || depth == 0) {
    if (changes.falls_first) Bisect(b, u0, u1);
    return;
  }
  Bezier halves[2];
  Halve(b, halves);
  const double middle = (u0 + u1) / 2;
  Look(halves[0], u0, middle, depth - 1);
  Look(halves[1], middle, u1, depth - 1);
}

}  // namespace

int IntersectCurve(const Curve& curve, const Ray& ray, Hit& nearest) {
  const TangentFrame across = MakeFrame(ray.d);
  Bezier seen;
  for (int k = 0; k < 4; ++k) seen.p[k] = across.ToLocal(curve.p[k] - ray.o);
  Search search{curve, ray.d, std::max(curve.width[0], curve.width[1]), nearest};
  search.Look(seen, 0, 1, 24);
  return search.found;
}

SurfacePoint DescribeCurve(const Curve& curve, const Ray& ray, const Hit& hit) {
  const double u = hit.b1, width = WidthSeen(curve, u, ray.d);
  SurfacePoint out;
  out.p = ray.o + hit.t * ray.d;
  out.dpdu = SlopeAt(curve.p, u);
  const Vec3d along =
      Normalize(Length(out.dpdu) > 0 ? out.dpdu : curve.p[3] - curve.p[0]);
  // Toward the viewer, or the ribbon's own normal, made to stand on the curve.
  const bool ribbon = curve.type == CurveType::kRibbon;
  const Vec3d front = ribbon ? RibbonNormalAt(curve, u) : -ray.d;
  const TangentFrame frame =
      MakeFrame(along, front);  // z along, x front, y = along x front
  const Vec3d right = -frame.y;
  // As seen along the ray.
  const Vec3d aside = out.p - PointAt(curve.p, u);
  const Vec3d seen = -MakeFrame(along, -ray.d).y;
  const double offset = Dot(aside, seen) * (Dot(seen, right) < 0 ? -1 : 1);
  out.u = u;
  out.v = 0.5 + std::clamp(offset / width, -0.5, 0.5);
  const double angle = curve.type == CurveType::kCylinder ? (out.v - 0.5) * kPi : 0;
  out.ng = out.ns = std::cos(angle) * frame.x + std::sin(angle) * right;
  out.dpdv = width * (std::cos(angle) * right - std::sin(angle) * frame.x);
  return out;
}

namespace {

// The ray in the space of the curve, and how much longer it is there.
double ToObject(const Primitive& primitive, Ray& ray) {
  const Vec3d d = primitive.object_from_world.Vector(ray.d);
  ray.o = primitive.object_from_world.Point(ray.o);
  ray.d = Normalize(d);
  return Length(d);
}

}  // namespace

int IntersectPlacedCurve(const Primitive& primitive, const Ray& ray, Hit& nearest) {
  Ray own = ray;
  const double longer = ToObject(primitive, own);
  Hit hit = nearest;
  hit.t *= longer;
  const int found = IntersectCurve(primitive.curve, own, hit);
  if (found > 0) {
    nearest = hit;
    nearest.t /= longer;
  }
  return found;
}

SurfacePoint DescribePlacedCurve(const Primitive& primitive, const Ray& ray, Hit hit) {
  Ray own = ray;
  const double t = hit.t;
  hit.t *= ToObject(primitive, own);
  SurfacePoint out = DescribeCurve(primitive.curve, own, hit);
  out.p = ray.o + t * ray.d;
  out.ng = out.ns = Normalize(primitive.object_from_world.Transposed().Vector(out.ng));
  out.dpdu = primitive.world_from_object.Vector(out.dpdu);
  out.dpdv = primitive.world_from_object.Vector(out.dpdv);
  return out;
}

}  // namespace lanelight::reference

// Intersection in double precision by plain formulas, as the truth for the kernels, and
// the shapes and rays that the intersection tests use.
#pragma once

#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "tests/support/wave_fixture.h"

namespace lanelight::brute {

inline constexpr double kInf = std::numeric_limits<double>::infinity();

struct Hit {
  double t = kInf;
  std::uint32_t prim = 0;
  double b1 = 0, b2 = 0;
  /// Least barycentric weight: how far inside the triangle, 0 = on an edge.
  double inside = 0;
};

/// Cramer's rule for o + t d = v0 + b1 e1 + b2 e2, without any test of the result.
inline std::optional<Hit> Solve(const TriangleRecord& tri, Vec3d o, Vec3d d) {
  const auto vertex = [&](int k) { return Vec3d{tri.p[k][0], tri.p[k][1], tri.p[k][2]}; };
  const Vec3d e1 = vertex(1) - vertex(0), e2 = vertex(2) - vertex(0);
  const Vec3d n = Cross(e1, e2), s = o - vertex(0);
  const double det = -Dot(n, d);
  if (det == 0) return std::nullopt;
  Hit hit;
  hit.t = Dot(n, s) / det;
  hit.b1 = Dot(Cross(e2, d), s) / -det;
  hit.b2 = Dot(Cross(d, e1), s) / -det;
  hit.inside = std::min({hit.b1, hit.b2, 1 - hit.b1 - hit.b2});
  return hit;
}

inline Hit Closest(const AlignedVector<TriangleRecord>& triangles, Vec3d o, Vec3d d) {
  Hit best;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const auto hit = Solve(triangles[i], o, d);
    if (hit && hit->inside >= 0 && hit->t > 0 && hit->t < best.t) {
      best = *hit;
      best.prim = i;
    }
  }
  return best;
}

/// Both roots of the sphere, or none.
inline std::vector<double> Roots(const SphereRecord& s, Vec3d o, Vec3d d) {
  const Vec3d f = o - Vec3d{s.center[0], s.center[1], s.center[2]};
  const double a = Dot(d, d), b = Dot(f, d), r = s.radius;
  const double discriminant = b * b - a * (Dot(f, f) - r * r);
  if (discriminant < 0) return {};
  return {(-b - std::sqrt(discriminant)) / a, (-b + std::sqrt(discriminant)) / a};
}

class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  float operator()(float lo, float hi) {
    return std::uniform_real_distribution<float>(lo, hi)(engine_);
  }
  Vec3f Point(float size) {
    return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)};
  }
  Vec3f Direction() {
    for (;;) {
      const Vec3f v = Point(1);
      if (Length(v) > 0.1f && Length(v) < 1) return Normalize(v);
    }
  }
  std::mt19937& engine() { return engine_; }

 private:
  std::mt19937 engine_;
};

/// n random triangles of edge about `edge` in a cube of half side `size`.
inline Geometry Soup(Random& random, int n, float size, float edge) {
  Geometry g;
  for (int i = 0; i < n; ++i) {
    const Vec3f c = random.Point(size);
    g.triangles.push_back(
        MakeTriangle(c, c + random.Point(edge), c + random.Point(edge)));
  }
  return g;
}

/// Closed unit sphere mesh of 2 * rings * segments triangles (less the poles), moved and
/// scaled; neighbours share vertices bit by bit.
inline Geometry SphereMesh(int rings, int segments, Vec3f center, float radius) {
  const auto vertex = [&](int r, int s) {
    const double theta = M_PI * r / rings, phi = 2 * M_PI * (s % segments) / segments;
    const double sine = r == 0 || r == rings ? 0 : std::sin(theta);
    return center + radius * Vec3f{static_cast<float>(sine * std::cos(phi)),
                                   static_cast<float>(sine * std::sin(phi)),
                                   static_cast<float>(std::cos(theta))};
  };
  Geometry g;
  for (int r = 0; r < rings; ++r) {
    for (int s = 0; s < segments; ++s) {
      const Vec3f a = vertex(r, s), b = vertex(r + 1, s), c = vertex(r + 1, s + 1),
                  d = vertex(r, s + 1);
      if (r + 1 < rings) g.triangles.push_back(MakeTriangle(a, b, c));
      if (r > 0) g.triangles.push_back(MakeTriangle(a, c, d));
    }
  }
  return g;
}

/// n separate triangles in and around a sphere mesh of 180: leaves of both kinds.
inline Geometry Mixed(Random& random, int n, float edge) {
  Geometry g = SphereMesh(10, 10, {0.3f, 0, 0}, 0.8f);
  const Geometry soup = Soup(random, n, 1, edge);
  g.triangles.insert(g.triangles.end(), soup.triangles.begin(), soup.triangles.end());
  return g;
}

inline Vec3f Corner(const TriangleRecord& triangle, int k) {
  return {triangle.p[k][0], triangle.p[k][1], triangle.p[k][2]};
}

inline Vec3d ToDouble(Vec3f v) { return VecCast<double>(v); }

}  // namespace lanelight::brute

// What single rays meet, without camera, materials or light: are shapes hit where they
// should be, and do rays that leave there meet anything?
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "src/base/core/vec.h"
#include "src/render/job/job.h"
#include "tests/extremes/check_points.h"
#include "tests/support/wave_fixture.h"

namespace lanelight::stress {

/// A unit normal along no axis.
inline const Vec3d kLeaning = Normalize(Vec3d{0.3, -0.5, 0.8});

/// Two unit vectors across the unit vector n and each other.
struct Across {
  Vec3d u, v;
  explicit Across(Vec3d n);

  /// The unit vector at an angle to u.
  Vec3d At(double phi) const;
};

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
  /// A direction in the hemisphere about the unit vector n, exactly `sine` above its
  /// edge.
  Vec3d AtSine(Vec3d n, double sine);

 private:
  std::mt19937_64 engine_;
};

/// A point of SquareMesh, clear of its rim.
Vec3d PointOfSquare(Draws& draws, Vec3d center, Vec3d n, double side = 1);

/// Closed sphere of triangles that share their vertices.
MeshText SphereMesh(int rings, int segments, Vec3d center, double radius);
/// Square of two triangles across the unit vector `n`.
MeshText SquareMesh(Vec3d center, Vec3d n, double side = 1);
/// Diffuse shapes under a sky, seen from `eye` downwards.
std::string RayScene(const std::string& shapes, Vec3d eye = {0, 0, 5});
/// Renders it twice, as two series. Once with paths that find the sky by hitting it:
/// every sample of a convex shape is then exactly its albedo. Once with 16 times the
/// samples and shadow rays.
std::vector<Point> ExpectBothWays(double expected, const std::string& text,
                                  Quality quality, const Effort& effort);
/// The largest of errors, which must not exceed the bound.
Point BoundPoint(double worst, double bound);
/// Failures among trials, of which there must be some and no failure.
Point NoFailures(std::uint64_t failures, std::uint64_t trials);

/// A ray in the coordinates of the scene file; `direction` is of unit length.
struct WorldRay {
  Vec3d origin, direction;
};

/// What a ray hits, in the coordinates of the scene file.
struct WorldHit {
  bool found = false;
  double t = std::numeric_limits<double>::infinity();
  std::uint32_t primitive = 0;  // id in src/scene/geometry/geometry.h
  Vec3d point, normal;          // as shading sees them; zero without a hit
};

/// Runs the closest-hit, surface and shadow stages that the plan of a scene has, on a
/// SIMD target. The scene needs a light, or it has no shadow stages.
class RayTracer {
 public:
  /// Compiles and plans the scene (pbrt text, no files). Throws InputError.
  RayTracer(SimdTarget target, const std::string& text);

  /// Closest hits and their surfaces.
  std::vector<WorldHit> Trace(const std::vector<WorldRay>& rays);

  /// True for each direction (unit) whose ray, leaving the hit of the ray of the same
  /// number in the last Trace, meets anything within `length` (scene-file units). Rays
  /// start where shading starts them. Without a hit there the answer is false.
  std::vector<bool> Blocked(const std::vector<Vec3d>& directions,
                            double length = std::numeric_limits<double>::infinity());

  /// The ray that the kernels get: rounded to float in the frame of the scene.
  WorldRay Rounded(const WorldRay& ray) const;
  const CompiledScene& scene() const { return *job_.scene.compiled; }

 private:
  void RunStages(const char* prefix);
  WorldHit HitOf(std::uint32_t slot) const;

  Job job_;
  std::optional<WaveFixture> fixture_;  // of the last Trace
};

/// Rays into a scene, and what becomes of them.
struct RayTrial {
  RayTracer tracer;
  std::vector<WorldRay> rays;
  std::vector<Vec3d> leaving;  // where rays have hit

  RayTrial(const Effort& effort, const std::string& shapes, Vec3d eye = {0, 0, 5})
      : tracer(effort.target, RayScene(shapes, eye)) {}

  /// Adds a ray in a direction that ends at `target`.
  void Aim(Vec3d target, Vec3d direction, double distance) {
    rays.push_back({target - distance * direction, direction});
  }

  /// Traces the rays: how many hits are not good(hit, number).
  template <class Good>
  std::uint64_t CountBad(const Good& good) {
    const std::vector<WorldHit> hits = tracer.Trace(rays);
    std::uint64_t bad = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) bad += !good(hits[i], i);
    return bad;
  }
  /// The largest of error(hit, number); a ray that hits nothing is off by 1.
  template <class Error>
  double Worst(const Error& error) {
    const std::vector<WorldHit> hits = tracer.Trace(rays);
    double worst = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
      worst = std::max(worst, hits[i].found ? error(hits[i], i) : 1.0);
    }
    return worst;
  }
  /// After tracing: how many of those that leave meet something within that length.
  std::uint64_t CountMet(double length = std::numeric_limits<double>::infinity()) {
    const std::vector<bool> met = tracer.Blocked(leaving, length);
    return static_cast<std::uint64_t>(std::count(met.begin(), met.end(), true));
  }
};

}  // namespace lanelight::stress

// Meshes: closed ones do not leak, sizes may differ, garbage harms none.
#include <limits>

#include "src/measure/stress/cases/cases.h"
#include "src/measure/stress/cases/ray_trial.h"

namespace lanelight::stress {
namespace {

// Rays from inside a closed mesh of radius 1 to its edges and vertices: how many get out.
std::vector<Point> Leaks(const MeshText& mesh, Vec3d center, const Effort& effort) {
  Draws draws(effort.seed);
  RayTrial trial(effort, mesh.Text(), center);
  for (int i = 0; i < effort(20000, 2000000); ++i) {
    const std::size_t k =
        static_cast<std::size_t>(draws(0, double(mesh.indices.size() / 3))) * 3;
    const Vec3d a = mesh.points[static_cast<std::size_t>(mesh.indices[k])];
    const Vec3d b = mesh.points[static_cast<std::size_t>(mesh.indices[k + 1])];
    const Vec3d target = i % 3 == 0 ? a : a + draws(0, 1) * (b - a);
    const Vec3d o = center + 0.5 * draws(0, 1) * draws.Direction();
    trial.rays.push_back({o, Normalize(target - o)});
  }
  const std::uint64_t leaks =
      trial.CountBad([](const WorldHit& hit, std::size_t) { return hit.found; });
  return {NoFailures(leaks, trial.rays.size())};
}

std::vector<Point> Watertight(double, const Effort& effort) {
  const Vec3d center{148376, 1234, -223423};
  return Leaks(SphereMesh(100, 100, center, 1), center, effort);
}

std::vector<Point> WatertightFar(double distance, const Effort& effort) {
  const Vec3d center = distance * Normalize(Vec3d{148376, 1234, -223423});
  return Leaks(SphereMesh(40, 40, center, 1), center, effort);
}

// A sphere of two rings of needles, each as thin as 2 pi / segments.
std::vector<Point> WatertightNeedles(double segments, const Effort& effort) {
  return Leaks(SphereMesh(2, static_cast<int>(segments), {}, 1), {}, effort);
}

// Triangles of sizes over twelve decades in one mesh: each is hit where it is aimed at.
std::vector<Point> AllSizes(double, const Effort& effort) {
  Draws draws(effort.seed);
  MeshText mesh;
  std::vector<Vec3d> centers;
  std::vector<double> sizes;
  for (int k = 0; k < 200; ++k) {
    // Spread along a spiral of the same decades about the eye's side of the origin.
    const double size = std::pow(10, -6 + 12 * k / 199.0);
    const Vec3d c = 3 * size * draws.Direction();
    const Across a(Normalize(c));
    mesh.AddQuad(c - size * 0.1 * (a.u + a.v), c + size * 0.1 * (a.u - a.v),
                 c + size * 0.1 * (a.u + a.v), c + size * 0.1 * (a.v - a.u));
    centers.push_back(c);
    sizes.push_back(size);
  }
  RayTrial trial(effort, mesh.Text(), {0, 0, 0});
  for (int i = 0; i < effort(2000, 200000); ++i) {
    const std::size_t k = static_cast<std::size_t>(i) % sizes.size();
    trial.rays.push_back({{}, Normalize(centers[k])});
  }
  // Something smaller may stand before it, but nothing lies behind it.
  const std::uint64_t failures = trial.CountBad([&](const WorldHit& hit, std::size_t i) {
    return hit.found && hit.t <= 3.1 * sizes[i % sizes.size()];
  });
  return {NoFailures(failures, trial.rays.size())};
}

// Rays that are no rays hit nothing, and the others are what they would be without.
std::vector<Point> Garbage(double, const Effort& effort) {
  Draws draws(effort.seed);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  std::uint64_t failures = 0, trials = 0;
  const std::string few = SphereMesh(4, 6, {}, 1).Text();
  const std::string many = SphereMesh(40, 60, {}, 1).Text();
  const std::string round = Sphere({}, 1) + "Shape \"disk\"\nShape \"plane\"\n";
  for (const std::string& shapes : {few, many, round}) {
    RayTracer tracer(effort.target, RayScene(shapes));
    std::vector<WorldRay> clean, mixed;
    std::vector<bool> bad;
    for (int i = 0; i < effort(2000, 100000); ++i) {
      WorldRay ray{3.0 * draws.Direction(), {}};
      ray.direction = Normalize(0.5 * draws.Direction() - ray.origin);
      clean.push_back(ray);
      bad.push_back(draws(0, 1) < 0.3);
      const double wrong[] = {nan, inf, -inf};
      const int what = static_cast<int>(draws(0, 3)),
                axis = static_cast<int>(draws(0, 3));
      const bool origin = draws(0, 1) < 0.5;
      if (bad.back() && origin) ray.origin[axis] = wrong[what];
      if (bad.back() && !origin) ray.direction[axis] = nan;
      mixed.push_back(ray);
    }
    const std::vector<WorldHit> good = tracer.Trace(clean), all = tracer.Trace(mixed);
    for (std::size_t i = 0; i < all.size(); ++i) {
      ++trials;
      failures += bad[i] ? all[i].found : all[i].t != good[i].t;
    }
  }
  return {NoFailures(failures, trials)};
}

}  // namespace

void AddMeshCases(std::vector<Case>& cases) {
  const CaseAdder add{cases, "geometry", Truth::kRate};
  add({"watertight-embree", "a closed mesh of radius 1 at (148376, 1234, -223423)",
       "no ray from inside gets out through edges or vertices", Single(), Watertight,
       "embree, watertight test (2e-5 allowed there)"});
  add({"watertight-far",
       "a closed mesh of radius 1 at a distance from the origin, to 1e9",
       "no ray from inside gets out",
       DecadesAxis("distance from the origin", "radii", {0, 12, 3}, {0, 9}),
       WatertightFar});
  Axis needles = DecadesAxis("needles in a ring", "", {1, 5}, {1, 5});
  needles.quick.pop_back();  // the last takes ten seconds to build
  add({"watertight-needles", "a closed mesh of two rings of needles, as thin as 6e-5",
       "no ray from inside gets out", needles, WatertightNeedles});
  add({"mesh-of-all-sizes", "squares of sides 1e-6 to 1e6 in one mesh",
       "each is hit, or one before it", Single(), AllSizes});
  add({"garbage-rays", "origins that are NaN or infinite, directions that are NaN",
       "they hit nothing, and the rays beside them what they would", Single(), Garbage,
       "embree"});
}

}  // namespace lanelight::stress

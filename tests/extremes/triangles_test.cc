// Single triangles, squares of two and meshes, of every size, place and angle, by rays.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "tests/extremes/check_points.h"
#include "tests/extremes/ray_trial.h"

namespace lanelight::stress {
namespace {

std::vector<Point> FarFromOrigin(double distance, const Effort& effort) {
  Draws draws(effort.seed);
  const Vec3d center = distance * Normalize(Vec3d{1, -2, 0.5});
  RayTrial trial(effort, SquareMesh(center, kLeaning).Text(), center + 5 * kLeaning);
  std::vector<Vec3d> targets;
  for (int i = 0; i < 1000; ++i) {
    targets.push_back(PointOfSquare(draws, center, kLeaning));
    trial.Aim(targets.back(), -draws.Above(kLeaning, 0.2), 3);
  }
  const double worst = trial.Worst(
      [&](const WorldHit& hit, std::size_t i) { return Length(hit.point - targets[i]); });
  return {BoundPoint(worst, 5e-6)};
}

// A triangle of length 1 and width 1 / aspect along x, or turned: interior points hit,
// and the normal is that of its vertices.
std::vector<Point> Needle(double aspect, const Effort& effort) {
  Draws draws(effort.seed);
  const double width = 1 / aspect;
  MeshText mesh;
  mesh.AddTriangle({-0.5, 0, 0}, {0.5, -width / 2, 0}, {0.5, width / 2, 0});
  RayTrial trial(effort, mesh.Text());
  for (int i = 0; i < 1000; ++i) {
    const double x = draws(0.1, 0.9), y = x * width * draws(-0.4, 0.4);
    const Vec3d d = -draws.Above({0, 0, 1}, 0.3);
    // Across the needle the ray must be straight: a float is coarser than it is wide.
    trial.Aim({x - 0.5, y, 0}, Normalize(Vec3d{d.x, 0, d.z}), 2);
  }
  const std::uint64_t failures = trial.CountBad([](const WorldHit& hit, std::size_t) {
    return hit.found && std::abs(std::abs(hit.normal.z) - 1) <= 1e-6;
  });
  return {NoFailures(failures, trial.rays.size())};
}

// Rays that leave a triangle whose vertices have coordinates of 10^-8 to 10^8 never meet
// it, nor its copy with the vertices in another order, again.
std::vector<Point> VerticesOfAllSizes(double, const Effort& effort) {
  Draws draws(effort.seed);
  const auto wild = [&] {
    const double size = std::pow(10, draws(-8, 8));
    return draws(-1, 1) < 0 ? -size : size;
  };
  std::uint64_t failures = 0, trials = 0;
  for (int n = 0; n < 40; ++n) {
    const Vec3d a{wild(), wild(), wild()}, b{wild(), wild(), wild()};
    const Vec3d c{wild(), wild(), wild()}, normal = Normalize(Cross(b - a, c - a));
    MeshText mesh;
    mesh.AddTriangle(a, b, c);
    mesh.AddTriangle(b, c, a);
    RayTrial trial(effort, mesh.Text(), a + Length(b - a) * normal);
    for (int i = 0; i < 1000; ++i) {
      const double u = draws(0.02, 0.97), v = draws(0.01, 0.98 - u);
      trial.Aim(a + u * (b - a) + v * (c - a), -normal, Length(c - a));
    }
    for (const WorldHit& hit : trial.tracer.Trace(trial.rays)) {
      trials += hit.found;
      trial.leaving.push_back(draws.Above(draws(-1, 1) * hit.normal, 1e-3));
    }
    failures += trial.CountMet();
  }
  return {NoFailures(failures, trials)};
}

// Triangles without area are never hit, nor do they hide what is behind. Coordinates are
// small multiples of 1/16, or two of them the same, so that no rounding gives them area.
std::vector<Point> Collinear(double, const Effort& effort) {
  Draws draws(effort.seed);
  MeshText mesh;
  mesh.AddTriangle({-13.45, -7.05, -5.24}, {-13.45, -8.09, -5.24},
                   {-13.45, -7.21, -5.24});
  const auto whole = [&] { return std::floor(draws(-64, 64)) / 16; };
  const auto corner = [&] { return Vec3d{whole(), whole(), whole()}; };
  for (int i = 0; i < 200; ++i) {
    const Vec3d a = corner(), b = corner();
    mesh.AddTriangle(a, b, a + std::floor(draws(-3, 4)) * (b - a));
    mesh.AddTriangle(a, a, b);
    mesh.AddTriangle(a, a, a);
  }
  const std::size_t slivers = mesh.indices.size() / 3;
  RayTrial trial(effort, mesh.Text() + SquareMesh({0, 0, -64}, {0, 0, 1}, 256).Text());
  for (int i = 0; i < 2000; ++i) {
    const std::size_t k =
        i % 8 == 0 ? 0 : static_cast<std::size_t>(draws(0, double(slivers)));
    const Vec3d a = mesh.points[3 * k], b = mesh.points[3 * k + 1];
    const Vec3d target = a + draws(0, 1) * (b - a);
    const Vec3d origin = target + 20.0 * draws.Direction();
    trial.rays.push_back({origin, Normalize(target - origin)});
  }
  const std::uint64_t failures = trial.CountBad([](const WorldHit& hit, std::size_t) {
    return !hit.found || std::abs(hit.point.z + 64) <= 1e-3;
  });
  return {NoFailures(failures, trial.rays.size())};
}

// Rays at an angle to a square of two triangles, at points of the edge that they share.
std::vector<Point> SharedEdge(double sine, const Effort& effort) {
  Draws draws(effort.seed);
  RayTrial trial(effort, Rectangle({-1, -1, 0}, {1, 1, 0}));
  for (int i = 0; i < 2000; ++i) {
    const double along = draws(-0.8, 0.8), phi = draws(0, 2 * M_PI);
    const double cosine = std::sqrt(1 - sine * sine);
    trial.Aim({along, along, 0}, {cosine * std::cos(phi), cosine * std::sin(phi), -sine},
              3);
  }
  const std::uint64_t failures =
      trial.CountBad([](const WorldHit& hit, std::size_t) { return hit.found; });
  return {NoFailures(failures, trial.rays.size())};
}

// Of a square along no axis, and of one in the plane z = 0.
template <class Measure>
std::vector<Point> LevelAndTilted(const Measure& measure) {
  return {Named("level", measure(Vec3d{0, 0, 1})), Named("tilted", measure(kLeaning))};
}

// Rays that leave a square of two triangles at an angle to it meet neither.
std::vector<Point> LeaveGrazing(double sine, const Effort& effort) {
  Draws draws(effort.seed);
  return LevelAndTilted([&](Vec3d n) {
    RayTrial trial(effort, SquareMesh({}, n).Text(), 5 * n);
    for (int i = 0; i < 2000; ++i) {
      const Vec3d d = -draws.Above(n, 0.1);
      trial.Aim(PointOfSquare(draws, {}, n), d, 2);
      trial.leaving.push_back(draws.AtSine(n, sine));
    }
    trial.tracer.Trace(trial.rays);
    return NoFailures(trial.CountMet(), trial.rays.size());
  });
}

// Between two squares a gap apart: rays from the lower one meet the upper one.
std::vector<Point> Gap(double gap, const Effort& effort) {
  Draws draws(effort.seed);
  return LevelAndTilted([&](Vec3d n) {
    // The upper square is larger, so that none passes beside it.
    const double side = 1.5 + 45 * gap;
    RayTrial trial(effort, SquareMesh({}, n).Text() + SquareMesh(gap * n, n, side).Text(),
                   -5.0 * n);
    for (int i = 0; i < 2000; ++i) {
      const Vec3d d = draws.Above(n, 0.3);
      trial.Aim(PointOfSquare(draws, {}, n), d, 1);
      trial.leaving.push_back(draws.Above(n, 0.05));
    }
    const std::uint64_t bad = trial.CountBad([&](const WorldHit& hit, std::size_t) {
      return hit.found && std::abs(Dot(hit.point, n)) <= 0.5 * gap;
    });
    const std::size_t rays = trial.rays.size();
    return NoFailures(bad + rays - trial.CountMet(), 2 * rays);
  });
}

// As many copies of one square at the same place: hit as the first of them, and left.
std::vector<Point> Coincident(double count, const Effort& effort) {
  Draws draws(effort.seed);
  const MeshText one = SquareMesh({}, kLeaning);
  MeshText mesh;
  for (int i = 0; i < std::lround(count); ++i) {
    mesh.AddQuad(one.points[0], one.points[1], one.points[2], one.points[3]);
  }
  RayTrial trial(effort, mesh.Text(), 5 * kLeaning);
  for (int i = 0; i < 64; ++i) {
    const Vec3d d = -draws.Above(kLeaning, 0.3);
    trial.Aim(PointOfSquare(draws, {}, kLeaning), d, 2);
    trial.leaving.push_back(draws.Above(kLeaning, 1e-3));
  }
  const std::uint64_t bad = trial.CountBad(
      [](const WorldHit& hit, std::size_t) { return hit.found && hit.primitive <= 1; });
  return {NoFailures(bad + trial.CountMet(), 2 * trial.rays.size())};
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
  for (int i = 0; i < 2000; ++i) {
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
    for (int i = 0; i < 2000; ++i) {
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

TEST_CASE("extremes: rays hit a square within 5e-6 up to 1e9 sides from the origin") {
  CheckPoints(Decades(0, 9, 3), FarFromOrigin);
}
TEST_CASE("extremes: needles 1e8 times as long as wide are hit") {
  CheckPoints(Decades(0, 8), Needle);
}
// As pbrt-v4's shapes_test.
TEST_CASE("extremes: rays leave triangles of vertices from 1e-8 to 1e8") {
  CheckPoints(VerticesOfAllSizes);
}
// Among them one of pbrt-v4's BadCases.
TEST_CASE("extremes: triangles without area are never hit") { CheckPoints(Collinear); }
TEST_CASE("extremes: no grazing ray passes between two triangles") {
  CheckPoints(Decades(-7, 0), SharedEdge);
}
TEST_CASE("extremes: grazing rays leave a square") {
  CheckPoints(Decades(-6, 0), LeaveGrazing);
}
TEST_CASE("extremes: squares 1e-6 of their side apart are distinguished") {
  CheckPoints(Decades(-6, 0), Gap);
}
TEST_CASE("extremes: of 100 000 coincident squares the first is hit, and left") {
  CheckPoints(Decades(0, 5), Coincident);
}
TEST_CASE("extremes: squares of sides 1e-6 to 1e6 in one mesh are hit") {
  CheckPoints(AllSizes);
}
TEST_CASE("extremes: NaN and infinite rays hit nothing and change no other") {
  CheckPoints(Garbage);
}

}  // namespace lanelight::stress

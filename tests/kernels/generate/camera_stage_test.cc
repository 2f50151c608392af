// Camera rays against the scalar reference (tests/reference/camera.h), ray by ray: film
// position, projection, lens, pixel filter, and the state that a path begins with.
#include "tests/reference/camera.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "kernels/stages.h"
#include "src/scene/compile/camera.h"
#include "tests/support/each_target.h"
#include "tests/support/wave_fixture.h"

namespace lanelight {
namespace {

constexpr int kWidth = 53, kHeight = 31;
constexpr std::uint32_t kPaths = kWidth * kHeight;

struct View {
  const char* name;
  CameraKind kind;
  double lens_radius;
  bool screen;  // a window that is not symmetric
  SphericalMapping mapping = SphericalMapping::kEqualArea;
};
constexpr View kViews[] = {
    {"pinhole", CameraKind::kPerspective, 0, false},
    {"shifted pinhole", CameraKind::kPerspective, 0, true},
    {"lens", CameraKind::kPerspective, 0.3, false},
    {"orthographic", CameraKind::kOrthographic, 0, false},
    {"orthographic lens", CameraKind::kOrthographic, 0.3, false},
    {"spherical", CameraKind::kSpherical, 0, false},
    {"longitudes", CameraKind::kSpherical, 0, false, SphericalMapping::kEquirectangular}};

StageOn StageOf(CameraKind kind) {
  if (kind == CameraKind::kOrthographic) return OrthographicCameraStage;
  if (kind == CameraKind::kSpherical) return SphericalCameraStage;
  return PerspectiveCameraStage;
}

Camera Describe(const View& view) {
  Camera camera;
  camera.kind = view.kind;
  camera.mapping = view.mapping;
  camera.fov = 47;
  camera.lens_radius = view.lens_radius;
  camera.focal_distance = 6;
  camera.world_from_camera =
      Transform::LookAt({3, -2, 5}, {0.5, 1, -1}, {0.1, 1, 0.2}).Inverse();
  const double window[4] = {-0.7, 1.9, -0.4, 0.8};
  if (view.screen) std::copy(window, window + 4, camera.screen_window);
  return camera;
}

FeatureSet FeaturesOf(const View& view, const CompiledFilter& filter) {
  FeatureSet f;
  if (view.lens_radius > 0) f.Add(Feature::kLens);
  if (!filter.is_box) f.Add(Feature::kFiltered);
  return f;
}

// One path for every pixel of an image, through the camera stage.
struct Shot {
  Film film;
  Camera camera;
  WorldFrame frame{{1.5, -2, 0.25}, 4};  // world to scene, as a compiled scene has it
  CompiledScene scene;
  WaveFixture fixture;

  Shot(const View& view, const Filter& filter)
      : camera(Describe(view)), fixture(scene, kPaths) {
    film.width = kWidth, film.height = kHeight;
    scene.view.camera = CompileCamera(camera, film, frame);
    scene.filter = CompileFilter(filter);
    fixture.run.width = kWidth, fixture.run.height = kHeight;
    std::mt19937 engine(23);
    const auto unit = [&] { return static_cast<float>(engine() >> 8) * 0x1p-24f; };
    PathColumns& p = fixture.wave.path;
    for (std::uint32_t i = 0; i < kPaths; ++i) {
      p.pixel[i] = i;
      p.u_film_0[i] = unit(), p.u_film_1[i] = unit();
      p.u_lens_0[i] = unit(), p.u_lens_1[i] = unit();
    }
    fixture.QueueAll(QueueId::kCamera, kPaths);
    fixture.Run(StageOf(view.kind), FeaturesOf(view, scene.filter));
  }
  // Back in the file's units.
  Vec3d Origin(std::uint32_t i) const {
    const PathColumns& p = fixture.wave.path;
    return Vec3d{p.o_x[i], p.o_y[i], p.o_z[i]} / frame.scale + frame.center;
  }
  Vec3d Direction(std::uint32_t i) const {
    const PathColumns& p = fixture.wave.path;
    return {p.d_x[i], p.d_y[i], p.d_z[i]};
  }
  // The same ray in camera space: z = 1 in front of a perspective camera.
  Vec3d LocalOrigin(std::uint32_t i) const {
    return camera.world_from_camera.Inverse().Point(Origin(i));
  }
  Vec3d LocalDirection(std::uint32_t i) const {
    return camera.world_from_camera.Inverse().Vector(Direction(i));
  }
};

Filter BoxFilter(double x_radius, double y_radius) {
  Filter filter;
  filter.kind = FilterKind::kBox;
  filter.x_radius = x_radius, filter.y_radius = y_radius;
  return filter;
}

// Film position of the box filter, in pixels.
struct Position {
  double x, y;
};
Position OnFilm(const Shot& shot, std::uint32_t i, const Filter& box) {
  const PathColumns& p = shot.fixture.wave.path;
  return {i % kWidth + 0.5 + (2.0 * p.u_film_0[i] - 1) * box.x_radius,
          i / kWidth + 0.5 + (2.0 * p.u_film_1[i] - 1) * box.y_radius};
}

}  // namespace

TEST_CASE("camera rays without a lens are the reference's", "[generate]") {
  const Filter box = BoxFilter(0.5, 1.25);
  const EachTarget target;
  for (const View& view : kViews) {
    if (view.lens_radius > 0) continue;
    CAPTURE(view.name);
    const Shot shot(view, box);
    reference::Random unused(1);
    double origin = 0, direction = 0;
    for (std::uint32_t i = 0; i < kPaths; ++i) {
      const Position at = OnFilm(shot, i, box);
      const reference::Ray ray =
          reference::CameraRay(shot.camera, shot.film, at.x, at.y, unused);
      origin = std::max(origin, Length(shot.Origin(i) - ray.o));
      direction = std::max(direction, Length(shot.Direction(i) - ray.d));
    }
    CHECK(origin < 2e-6);
    CHECK(direction < 1e-6);
  }
}

TEST_CASE("rays through a lens start uniformly on it and intersect in focus",
          "[generate]") {
  const Filter box = BoxFilter(0.5, 0.5);
  const View& view = kViews[2];
  View pinhole = view;
  pinhole.lens_radius = 0;
  const EachTarget target;
  const Shot shot(view, box);
  const Camera sharp = Describe(pinhole);
  reference::Random unused(1);
  double off_focus = 0, off_lens = 0;
  double x = 0, y = 0, xx = 0, yy = 0, xy = 0;
  for (std::uint32_t i = 0; i < kPaths; ++i) {
    const Position at = OnFilm(shot, i, box);
    const reference::Ray ray = reference::CameraRay(sharp, shot.film, at.x, at.y, unused);
    const Vec3d local = sharp.world_from_camera.Inverse().Vector(ray.d);
    const Vec3d focus = local * (6 / local.z);
    const Vec3d o = shot.LocalOrigin(i), d = shot.LocalDirection(i);
    off_focus = std::max(off_focus, Length(o + d * ((6 - o.z) / d.z) - focus));
    off_lens = std::max(off_lens, std::hypot(o.x, o.y) - view.lens_radius);
    CHECK(std::abs(o.z) < 1e-5);
    const double lx = o.x / view.lens_radius, ly = o.y / view.lens_radius;
    x += lx, y += ly, xx += lx * lx, yy += ly * ly, xy += lx * ly;
  }
  CHECK(off_focus < 2e-5);
  CHECK(off_lens < 1e-5);
  // Moments of the uniform unit disk: E[x^2] = 1/4, E[x^4] = 1/8, E[x^2 y^2] = 1/24.
  // Five standard errors.
  const double n = kPaths;
  CHECK(std::abs(x / n) < 5 * std::sqrt(0.25 / n));
  CHECK(std::abs(y / n) < 5 * std::sqrt(0.25 / n));
  CHECK(std::abs(xx / n - 0.25) < 5 * std::sqrt(1 / 16. / n));
  CHECK(std::abs(yy / n - 0.25) < 5 * std::sqrt(1 / 16. / n));
  CHECK(std::abs(xy / n) < 5 * std::sqrt(1 / 24. / n));
}

TEST_CASE("film positions follow the filter, with its sign as weight", "[generate]") {
  const EachTarget target;
  for (FilterKind kind : {FilterKind::kTriangle, FilterKind::kGaussian,
                          FilterKind::kMitchell, FilterKind::kLanczos}) {
    CAPTURE(static_cast<int>(kind));
    Filter filter = BoxFilter(2, 1.5);
    filter.kind = kind;
    const View& view = kViews[3];  // of an orthographic camera: linear in the position
    const Shot shot(view, filter);
    const PathColumns& p = shot.fixture.wave.path;
    // Estimates of the integrals of (f / integral of f) times 1, x^2, y^2.
    double estimate[3] = {}, squares[3] = {}, exact[3] = {1, 0, 0};
    const double per_pixel = 2.0 / kHeight;  // the shorter side spans two units
    for (std::uint32_t i = 0; i < kPaths; ++i) {
      const Vec3d o = shot.LocalOrigin(i);
      const double dx = o.x / per_pixel + kWidth / 2. - (i % kWidth + 0.5);
      const double dy = kHeight / 2. - o.y / per_pixel - (i / kWidth + 0.5);
      REQUIRE(std::abs(dx) <= filter.x_radius + 1e-4);
      REQUIRE(std::abs(dy) <= filter.y_radius + 1e-4);
      const double values[3] = {1, dx * dx, dy * dy};
      for (int k = 0; k < 3; ++k) {
        const double v = values[k] * p.weight[i];
        estimate[k] += v / kPaths, squares[k] += v * v / kPaths;
      }
    }
    for (int axis = 1; axis <= 2; ++axis) {
      const double radius = axis == 1 ? filter.x_radius : filter.y_radius;
      double sum = 0, norm = 0;
      for (int i = 0; i < 4000; ++i) {
        const double t = radius * (2 * (i + 0.5) / 4000 - 1);
        const double f = EvaluateFilter(filter, radius, t);
        norm += f, sum += f * t * t;
      }
      exact[axis] = sum / norm;
    }
    for (int k = 0; k < 3; ++k) {
      const double variance = squares[k] - estimate[k] * estimate[k];
      INFO("integral " << k);
      // Five standard errors, and the width of the filter's tables.
      CHECK(std::abs(estimate[k] - exact[k]) <=
            5 * std::sqrt(std::max(variance, 0.0) / kPaths) + 2e-3);
    }
  }
}

TEST_CASE("a path starts with zero radiance and its full throughput", "[generate]") {
  const EachTarget target;
  Shot shot(kViews[0], BoxFilter(0.5, 0.5));
  const PathColumns& p = shot.fixture.wave.path;
  for (std::uint32_t i = 0; i < kPaths; ++i) {
    for (const float* one : {p.beta_r, p.beta_g, p.beta_b, p.eta_scale}) {
      REQUIRE(one[i] == 1);
    }
    for (const float* zero :
         {p.l_r, p.l_g, p.l_b, p.bsdf_pdf, p.aov_albedo_r, p.aov_albedo_g, p.aov_albedo_b,
          p.aov_n_x, p.aov_n_y, p.aov_n_z, p.aov_depth, p.gb_hit, p.gb_p_x, p.gb_dz_1}) {
      REQUIRE(zero[i] == 0);
    }
    for (const std::uint32_t* none : {p.first_bsdf, p.first_light, p.choices}) {
      REQUIRE(none[i] == 0);
    }
    REQUIRE(p.t[i] == std::numeric_limits<float>::infinity());
    REQUIRE(p.prim[i] == kNoPrimitive);
  }
  const Queue& active = shot.fixture.wave.queue(QueueId::kActive);
  REQUIRE(active.size == kPaths);
  for (std::uint32_t i = 0; i < kPaths; ++i) REQUIRE(active.items[i] == i);
}

}  // namespace lanelight

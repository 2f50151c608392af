// Realistic cameras, ray by ray and as a whole: against a tracer of spheres about their
// centres (tests/reference/lenses.h), against the thin lens, and the bounds of the exit
// pupil against rays tried at random.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <random>

#include "kernels/stages.h"
#include "src/base/core/error.h"
#include "src/base/core/pi.h"
#include "src/base/image/image.h"
#include "src/scene/compile/camera.h"
#include "tests/agreement/agreement.h"
#include "tests/reference/lenses.h"
#include "tests/support/each_target.h"
#include "tests/support/wave_fixture.h"

namespace lanelight::test {
namespace {

constexpr int kWidth = 60, kHeight = 40;
constexpr std::uint32_t kPaths = kWidth * kHeight;

// The doublet of scenes/lenses.
Camera Doublet(double stop, double focus) {
  Camera camera;
  camera.kind = CameraKind::kRealistic;
  camera.lens = {55, 7, 1.517, 28, -48, 3, 1.62, 28, -180, 4, 1, 27, 0, 72, 0, 24};
  camera.aperture_diameter = stop;
  camera.focal_distance = focus;
  camera.film_diagonal = 43;
  return camera;
}

struct Shot {
  Camera camera;
  Film film;
  CompiledScene scene;
  WaveFixture fixture;

  explicit Shot(const Camera& c) : camera(c), fixture(scene, kPaths) {
    film.width = kWidth, film.height = kHeight;
    scene.view.camera = CompileCamera(camera, film, WorldFrame{{0, 0, 0}, 4});
    Filter box;
    box.x_radius = box.y_radius = 0.5;
    scene.filter = CompileFilter(box);
    fixture.run.width = kWidth, fixture.run.height = kHeight;
    Draw(29);
  }
  void Draw(unsigned seed) {
    std::mt19937 engine(seed);
    const auto unit = [&] { return static_cast<float>(engine() >> 8) * 0x1p-24f; };
    PathColumns& p = fixture.wave.path;
    for (std::uint32_t i = 0; i < kPaths; ++i) {
      p.pixel[i] = i;
      p.u_film_0[i] = unit(), p.u_film_1[i] = unit();
      p.u_lens_0[i] = unit(), p.u_lens_1[i] = unit();
    }
    fixture.QueueAll(QueueId::kActive, 0);
    fixture.QueueAll(QueueId::kDone, 0);
    fixture.QueueAll(QueueId::kCamera, kPaths);
    fixture.Run(RealisticCameraStage, {});
  }
  // Millimetres from the middle of the film.
  Vec3d OnFilm(std::uint32_t i) const {
    const PathColumns& p = fixture.wave.path;
    const double pixel = camera.film_diagonal / std::hypot(kWidth, kHeight);
    return {pixel * (kWidth / 2.0 - (i % kWidth + double(p.u_film_0[i]))),
            pixel * (i / kWidth + double(p.u_film_1[i]) - kHeight / 2.0), 0};
  }
  const LensSystem& lenses() const { return scene.view.camera.lenses; }
  LensSystem::Pupil PupilAt(Vec3d film_point) const {
    const double r = std::hypot(film_point.x, film_point.y);
    const auto ring = static_cast<std::size_t>(r * lenses().rings_per_mm);
    return lenses().pupils[std::min(ring, lenses().pupils.size() - 1)];
  }
  Vec3d Origin(std::uint32_t i) const {
    const PathColumns& p = fixture.wave.path;
    return Vec3d{p.o_x[i], p.o_y[i], p.o_z[i]} * 250;  // scene units to millimetres
  }
};

// A film point turned so that it lies on +x, and back.
Vec3d Turned(Vec3d v, Vec3d film, double sign) {
  const double r = std::hypot(film.x, film.y), c = film.x / r, s = sign * film.y / r;
  return {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
}

void CheckRays(const Camera& camera, double max_stopped) {
  const Shot shot(camera);
  const reference::Lenses twin(camera);
  const PathColumns& p = shot.fixture.wave.path;
  CHECK(twin.rear() == Approx(shot.lenses().rear).epsilon(2e-5));
  std::uint32_t stopped = 0, differ = 0;
  for (std::uint32_t i = 0; i < kPaths; ++i) {
    const Vec3d film = shot.OnFilm(i);
    const LensSystem::Pupil pupil = shot.PupilAt(film);
    const Vec3d on_x = {pupil.x0 + (double(pupil.x1) - pupil.x0) * p.u_lens_0[i],
                        pupil.y0 + (double(pupil.y1) - pupil.y0) * p.u_lens_1[i],
                        twin.rear()};
    const Vec3d rear = Turned(on_x, film, 1);
    const auto ray = twin.Trace(film, rear);
    stopped += !ray;
    differ += ray.has_value() != (p.weight[i] > 0);  // within rounding of an edge
    if (!ray || !(p.weight[i] > 0)) continue;
    const Vec3d d = {p.d_x[i], p.d_y[i], p.d_z[i]};
    CHECK(Length(d - ray->d) < 2e-5);
    CHECK(Length(shot.Origin(i) - ray->o) < 2e-3);
    const double cosine = rear.z / Length(rear - film);
    const double area = (double(pupil.x1) - pupil.x0) * (double(pupil.y1) - pupil.y0);
    CHECK(p.weight[i] ==
          Approx(std::pow(cosine, 4) * area / (rear.z * rear.z)).epsilon(1e-4));
  }
  CHECK(differ < kPaths / 400);
  CHECK(stopped < max_stopped * kPaths);
  const Wave& wave = shot.fixture.wave;
  CHECK(const_cast<Wave&>(wave).queue(QueueId::kActive).size +
            const_cast<Wave&>(wave).queue(QueueId::kDone).size ==
        kPaths);
}

}  // namespace

TEST_CASE("rays through lenses equal those of the reference", "[generate]") {
  const EachTarget target;
  CheckRays(Doublet(24, 2), 0.45);
  CheckRays(Doublet(6, 0.7), 0.35);
}

// A white picture of 4x4 pixels.
struct WhitePicture {
  WhitePicture() {
    Image image = MakeImage(4, 4, {"Y"});
    std::fill(image.pixels.begin(), image.pixels.end(), 1.0f);
    WritePfm(path, image);
  }
  ~WhitePicture() { std::filesystem::remove(path); }
  std::string path = std::filesystem::temp_directory_path() /
                     fmt::format("lanelight_aperture_{}.pfm", getpid());
};

// Mean exposure of a film of 1 mm by radiance 1.
double Exposure(const std::string& aperture) {
  Camera camera = Doublet(16, 2);
  camera.film_diagonal = 1;
  camera.aperture = aperture;
  double sum = 0;
  constexpr unsigned kShots = 8;
  Shot shot(camera);
  for (unsigned seed = 0; seed < kShots; ++seed) {
    shot.Draw(seed);
    for (std::uint32_t i = 0; i < kPaths; ++i) {
      sum += shot.fixture.wave.path.weight[i] / (kPaths * kShots);
    }
  }
  return sum;
}

// Requires that the camera's pupils hold all rays that pass a round stop.
void CheckPupils(const Camera& camera, double stop) {
  const Shot shot(camera);
  const reference::Lenses twin(Doublet(stop, 2));
  std::mt19937_64 engine(31);
  std::uniform_real_distribution<double> unit(0, 1);
  int passed = 0;
  for (int i = 0; i < 400000; ++i) {
    const double r = unit(engine) * camera.film_diagonal / 2;
    const double side = 3 * twin.rear_radius();
    const Vec3d rear = {side * (unit(engine) - 0.5), side * (unit(engine) - 0.5),
                        twin.rear()};
    if (!twin.Trace({r, 0, 0}, rear)) continue;
    ++passed;
    const LensSystem::Pupil pupil = shot.PupilAt({r, 0, 0});
    CHECK((rear.x >= pupil.x0 && rear.x <= pupil.x1));
    CHECK((rear.y >= pupil.y0 && rear.y <= pupil.y1));
  }
  CHECK(passed > 1000);
}

TEST_CASE("the exit pupil's bounds hold all rays that come through", "[generate]") {
  CheckPupils(Doublet(24, 2), 24);
  CheckPupils(Doublet(6, 2), 6);
  // A square aperture, and the round stop that its corners touch.
  const WhitePicture white;
  Camera square = Doublet(12, 2);
  square.aperture = white.path;
  CheckPupils(square, 12 * std::sqrt(2));
}

TEST_CASE("lenses form the image of a thin lens", "[generate]") {
  // Small stop: little of spherical aberration is left.
  const double focus = 1.2;
  const Camera camera = Doublet(3, focus);
  const Shot shot(camera);
  const PathColumns& p = shot.fixture.wave.path;
  // The magnification: film height to height of the plane in focus, near the axis.
  double worst = 0, magnification = 0, count = 0;
  for (std::uint32_t i = 0; i < kPaths; ++i) {
    const Vec3d film = shot.OnFilm(i);
    const double r = std::hypot(film.x, film.y);
    if (!(p.weight[i] > 0) || r > 6 || r < 3) continue;
    const Vec3d o = shot.Origin(i), d = {p.d_x[i], p.d_y[i], p.d_z[i]};
    const Vec3d q = o + d * ((focus * 1000 - o.z) / d.z);
    magnification += -Dot(Vec3d{q.x, q.y, 0}, film) / (r * r);
    ++count;
  }
  magnification /= count;
  for (std::uint32_t i = 0; i < kPaths; ++i) {
    const Vec3d film = shot.OnFilm(i);
    if (!(p.weight[i] > 0) || std::hypot(film.x, film.y) > 6) continue;
    const Vec3d o = shot.Origin(i), d = {p.d_x[i], p.d_y[i], p.d_z[i]};
    const Vec3d q = o + d * ((focus * 1000 - o.z) / d.z);
    worst = std::max(
        worst, std::hypot(q.x + magnification * film.x, q.y + magnification * film.y));
  }
  // 1 / s + 1 / s' = 1 / f with s / s' the magnification m, and s + s' nearly the whole
  // way: f = (s + s') m / (1 + m)^2, within the distance of the principal planes.
  const double f = focus * 1000 * magnification / std::pow(1 + magnification, 2);
  // That of thin surfaces in contact: the sum of (n' - n) / r.
  const double power = 0.517 / 55 - 0.103 / 48 + 0.62 / 180;
  CHECK(f == Approx(1 / power).epsilon(0.03));
  // A point of the film sees a spot of the plane in focus, of this size in millimetres.
  CHECK(worst < 0.5);
}

TEST_CASE("a uniform light exposes the film by the solid angle of the aperture",
          "[generate]") {
  // On the axis the irradiance from radiance 1 is pi sin^2, of the half angle under which
  // the film sees the rear opening: here nothing but a stop.
  Camera camera = Doublet(10, 5);
  camera.lens = {500, 1, 1.0, 40, 0, 50, 0, 30};
  camera.film_diagonal = 1e-3;
  CHECK_THROWS_AS(CompileCamera(camera, Film{}, WorldFrame{}), InputError);  // no lens
  camera = Doublet(10, 5);
  camera.film_diagonal = 0.01;
  const Shot shot(camera);
  const reference::Lenses twin(camera);
  double sum = 0;
  for (std::uint32_t i = 0; i < kPaths; ++i) sum += shot.fixture.wave.path.weight[i];
  const double sine2 = 25 / (25 + twin.rear() * twin.rear());
  // Five standard errors of a share of pi / 4 or so that passes.
  CHECK(sum / kPaths == Approx(kPi * sine2).epsilon(5 * std::sqrt(0.3 / kPaths)));
}

TEST_CASE("images through lenses agree with the reference", "[generate]") {
  SceneBuilder b(8, 8);
  b.Depth(2);
  b.scene().camera = Doublet(20, 0.8);
  b.scene().camera.world_from_camera =
      Transform::LookAt({0, -0.8, 0.1}, {0, 0, 0.05}, {0, 0, 1}).Inverse();
  b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddDiffuse({0.6, 0.5, 0.4}));
  b.AddSphere({0, 0, 0.06}, 0.06, 0);
  b.AddSphere({0.15, 0.3, 0.3}, 0.06, 0, b.AddEmission({30, 20, 10}));
  b.AddEnvironment({0.3, 0.4, 0.5});
  const auto image = RenderWavefront(b.Build(), 8192);
  const auto compare = [&](const SceneDescription& scene) {
    return stat::CompareMeans(
        image,
        Estimate(
            RenderReference(scene, Options(ReferenceEstimator::kLightSampling, 4096))),
        {4, 1e-6, kFloatTolerance, 1e-7});
  };
  const auto result = compare(b.Build());
  INFO(result.ToString());
  CHECK(result.same);
  CHECK(result.detectable_bias < 0.1);
  SceneDescription wider = b.Build();
  wider.camera.aperture_diameter *= 1.1;
  CHECK_FALSE(compare(wider).same);
}

TEST_CASE("aperture images are as bright as a circle", "[generate]") {
  const WhitePicture white;
  const double circle = Exposure("");
  for (const std::string& shape :
       {std::string("gaussian"), std::string("square"), std::string("pentagon"),
        std::string("star"), white.path}) {
    INFO("aperture " << shape);
    CHECK(Exposure(shape) == Approx(circle).epsilon(0.043));  // five standard errors
  }
}

}  // namespace lanelight::test

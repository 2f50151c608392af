// control=analytic and control=ambient where paths carry wavelengths: the expected value
// is that of the wavelengths of each path.
#include <catch2/catch.hpp>

#include "src/core/pi.h"
#include "tests/control/control_scenes.h"
#include "tests/control/quadrature.h"

namespace lanelight::test {
namespace {

constexpr Rgb kWarm = {3, 1.2, 0.4};

SceneDescription CarryingWavelengths(SceneDescription scene) {
  scene.integrator.transport = Transport::kSpectral;
  return scene;
}

// What is left to vary is the colour of the triples, evenly in Sobol' points.
void CheckExact(const SceneDescription& scene, const std::string& strategy, Rgb exact) {
  const Rendered render =
      RenderWith(CarryingWavelengths(scene), strategy + ",c=1,points=sobol", 512);
  INFO(strategy);
  for (const Rgb& mean : Estimate(render).mean) {
    for (int c = 0; c < 3; ++c) CHECK(mean[c] == Approx(exact[c]).epsilon(1e-4));
  }
}

}  // namespace

TEST_CASE("spectral control: an open lamp or sky of a colour leaves no noise",
          "[control][spectral]") {
  SceneBuilder lamp = PointReceiver(Lambert(Grey(0.5)));
  const Vec3d center = {0.5, 0.7, 1};
  lamp.AddSphere(center, 0.3, lamp.AddDiffuse(Grey(0)), lamp.AddEmission(kWarm));
  const double irradiance = quadrature::Sphere(center, 0.3, {0, 0, 1});
  CheckExact(lamp.Build(), "directions=light,control=analytic",
             kWarm * (0.5 * irradiance / kPi));
  SceneBuilder sky = PointReceiver(Lambert(Grey(0.5)));
  sky.AddEnvironment(kWarm);
  for (const char* directions : {"uniform", "light", "mis"}) {
    CheckExact(sky.Build(), std::string("control=ambient,directions=") + directions,
               kWarm * 0.5);
  }
}

TEST_CASE("spectral control: what is hidden keeps its mean", "[control][spectral]") {
  const SceneDescription plate = CarryingWavelengths(Plate(Lambert({0.8, 0.5, 0.2}), 8));
  const SceneDescription room = CarryingWavelengths(SmallRoom(8, 2, 0.8));
  for (const auto& [scene, control] :
       {std::pair(plate, "ambient"), std::pair(plate, "analytic"),
        std::pair(room, "analytic")}) {
    const Rendered plain = RenderWith(scene, "roulette=none", 1024, 5);
    for (const char* c : {"1", "optimal"}) {
      const std::string strategy = std::string("control=") + control + ",c=" + c;
      const stat::ImageTestResult result =
          Compare(RenderWith(scene, strategy, 512), plain);
      INFO(strategy << ": " << result.ToString());
      CHECK(result.same);
    }
  }
}

TEST_CASE("spectral control: the coefficient is fitted to what the film sees",
          "[control][spectral]") {
  // But for the colour of each path f is h.
  SceneBuilder b = PointReceiver(Lambert(Grey(0.5)));
  b.AddEnvironment(kWarm);
  const Rendered fitted = RenderWith(CarryingWavelengths(b.Build()),
                                     "directions=uniform,control=ambient", 4096);
  REQUIRE(fitted.result.control.has_value());
  CHECK(fitted.result.control->coefficient == Approx(1).epsilon(0.01));
}

}  // namespace lanelight::test

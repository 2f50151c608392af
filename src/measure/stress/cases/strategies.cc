// Renders stiff scenes with every choice of every axis of a strategy. Checks the
// mean, and measures the cost of a precise answer.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/measure/stress/cases/cases.h"
#include "src/measure/stress/cases/points.h"
#include "src/measure/stress/cases/scene_text.h"
#include "src/measure/stress/cases/strategy_measure.h"
#include "src/measure/stress/closed_forms.h"

namespace lanelight::stress {
namespace {

bool Is(const std::string& strategy, const char* choice) { return strategy == choice; }

// A plane under a sphere light of irradiance 0.8 pi.
std::vector<Point> ByLightRadius(double radius, const Effort& effort) {
  StrategyScene scene;
  scene.text = ViewOfPlane() + Plane(Diffuse(0.5)) +
               SphereLight({0.6, 0, 0.8}, radius, 1 / (radius * radius));
  scene.expected = 0.4;
  scene.quality = {64, 16384, 3};
  scene.chance = [radius](const std::string& strategy) {
    return FindsLightsByChance(strategy) ? 0.4 * radius * radius : 1.0;
  };
  return MeasureAll(scene, effort);
}

std::vector<Point> ByAlbedo(double missing, const Effort& effort) {
  const double albedo = double(float(1 - missing));
  const int depth = static_cast<int>(std::ceil(4 / missing));
  StrategyScene scene;
  scene.text = Room(missing, 1 - missing);
  scene.expected = ClosedRoom(double(float(missing)), albedo, depth);
  const double length = 1 / missing;
  scene.quality = {length > 500 ? std::uint64_t{16} : 64, length > 5000 ? 256u : 4096u,
                   depth, 4};
  scene.omission_reason = [&](const std::string& strategy) {
    const bool long_training = HasTraining(strategy) && length > effort(50.0, 2000.0);
    if (long_training)
      return std::string("its trial run alone takes 65536 paths of this length");
    // Squared weights of an event: 4/3 in the mean for uniform directions, 1 / (1 - q).
    const bool grows =
        Is(strategy, "directions=uniform") || Is(strategy, "roulette=constant");
    if (grows && albedo * albedo * 4 / 3 >= 1) {
      return std::string(
          "its variance grows with every event: 4/3 albedo^2 is not below 1");
    }
    return std::string();
  };
  return MeasureAll(scene, effort);
}

std::vector<Point> ByRoughness(double alpha, const Effort& effort) {
  constexpr double kCosine = 0.7;
  StrategyScene scene;
  scene.text = ViewOfPlane(kCosine) + Sky(1) + Plane(Metal(0.9, alpha, alpha));
  const auto fresnel = [](double c) { return FresnelConductor(c, 1, 6); };
  const bool smooth = alpha < 1e-3;
  scene.expected = smooth ? fresnel(kCosine)
                          : IntegrateGgx(alpha, alpha, kCosine, 0, fresnel).reflected;
  scene.quality = {64, 16384, 3};
  scene.chance = [=](const std::string& strategy) {
    const bool blind =
        Is(strategy, "directions=uniform") || Is(strategy, "directions=light");
    return blind && !smooth ? std::min(1.0, alpha * alpha) : 1.0;
  };
  auto points = MeasureAll(scene, effort);
  for (Point& point : points) {
    if (!point.not_measured.empty()) continue;
    // Facets that send light below the surface: about alpha^2 of them.
    if (!smooth && alpha < 0.5)
      point = AllowForRareSamples(point, alpha * alpha, point.expected);
    point.tolerance += 1e-4 * point.expected;  // of the integral
  }
  return points;
}

// A sphere light that is `ratio` times as bright as the sky behind it.
std::vector<Point> ByRatio(double ratio, const Effort& effort) {
  constexpr double kRadius = 0.3, kCovered = kRadius * kRadius * 0.8;
  StrategyScene scene;
  scene.text = ViewOfPlane() + Plane(Diffuse(0.5)) + Sky(1) +
               SphereLight({0.6, 0, 0.8}, kRadius, ratio);
  scene.expected = 0.5 * (1 - kCovered + ratio * kCovered);
  scene.quality = {64, 16384, 3};
  return MeasureAll(scene, effort);
}

std::vector<Point> ByLights(double count, const Effort& effort) {
  const LightRing ring = RingOfLights(static_cast<int>(count));
  StrategyScene scene;
  scene.text = ring.text;
  scene.expected = ring.expected;
  scene.quality = {64, 16384, 3};
  return MeasureAll(scene, effort);
}

// A sky behind sheets that let through less and less of it.
std::vector<Point> ByTransmittance(double transmitted, const Effort& effort) {
  StrategyScene scene;
  scene.text = Sheets(transmitted);
  scene.expected = transmitted;
  scene.quality = {64, 4096, 200};
  scene.chance = [=](const std::string& strategy) {
    // Roulette by the path's own throughput keeps what is left of it.
    const bool none = Is(strategy, "roulette=none") || HasTraining(strategy);
    if (none) return 1.0;
    return std::min(1.0, transmitted * 1e3);  // from the second sheet on
  };
  return MeasureAll(scene, effort);
}

}  // namespace

void AddStrategyCases(std::vector<Case>& cases) {
  const CaseAdder add{cases, "strategies", Truth::kClosedForm};
  add({"strategies-light-radius", "a sphere light of radius 1e-8 to 0.5, every strategy",
       "the radiance of the plane below equals the closed form",
       LogAxis("radius", "", {1e-8, 0.5}, {1e-8, 1e-5, 1e-3, 0.03, 0.5},
               {1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.1, 0.5}),
       ByLightRadius});
  add({"strategies-albedo", "a closed room of albedo 0.5 to 1 - 1e-5, every strategy",
       "the radiance in the room is 1",
       LogAxis("1 - albedo", "", {1e-5, 0.5}, {1e-3, 0.01, 0.1, 0.5},
               {1e-5, 1e-4, 1e-3, 0.01, 0.1, 0.5}),
       ByAlbedo});
  add({"strategies-roughness", "metal of alpha 1e-8 to 1 under a sky, every strategy",
       "the albedo of single scattering",
       LogAxis("GGX alpha", "", {0, 1}, {1e-8, 1e-3, 0.01, 0.1, 1}, Decades(-8, 0)),
       ByRoughness});
  add({"strategies-radiance-ratio",
       "a light 1 to 1e12 times as bright as the sky, every strategy",
       "the radiance of the plane equals the sum of both",
       LogAxis("ratio", "", {1, 1e12}, Decades(0, 12, 4), Decades(0, 12)), ByRatio});
  add({"strategies-lights", "1 to 1e4 point lights over six decades, every strategy",
       "the radiance of the plane equals the sum over the lights",
       LogAxis("lights", "", {1, 1e6}, {1, 100, 1e4}, {1, 10, 100, 1e3, 1e4, 1e5, 1e6}),
       ByLights});
  add({"strategies-transmittance",
       "a sky behind sheets of transmittance 1 to 1e-12, every strategy",
       "the product of the transmittances",
       LogAxis("transmitted", "", {1e-30, 1}, {1e-12, 1e-6, 1e-3, 1}, Decades(-30, 0, 3)),
       ByTransmittance});
}

}  // namespace lanelight::stress

// What half spaces of a scattering medium reflect, against walks at random.
#include "src/scene/compile/media.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/reference/media.h"
#include "tests/reference/optics.h"

namespace lanelight::test {
namespace {

constexpr int kWalks = 20000;

// One walk from just below the surface, downwards; what it brings out again.
double Walk(double albedo, double g, double eta, reference::Random& random) {
  double depth = 0;
  Vec3d d = {0, 0, -1};
  for (double weight = 1;;) {
    depth -= d.z * -std::log(random.Uniform());
    if (depth < 0) {
      if (random.Uniform() >= reference::FresnelDielectric(d.z, 1 / eta)) return weight;
      depth = 0, d.z = -d.z;
      continue;
    }
    weight *= albedo;
    if (weight < 0.1) {
      if (random.Uniform() < 0.5) return 0;
      weight *= 2;
    }
    d = reference::SamplePhaseFunction(g, d, random);
  }
}

}  // namespace

TEST_CASE("slab reflectances agree with random walks", "[compile][subsurface]") {
  struct Slab {
    double albedo, g, eta;
  };
  reference::Random random(7);
  for (const Slab s : {Slab{0.5, 0, 1.33}, Slab{0.95, 0, 1.33}, Slab{0.9, 0.7, 1.5},
                       Slab{0.8, -0.5, 1}, Slab{0.9, 0, 0.8}}) {
    double sum = 0, squares = 0;
    for (int i = 0; i < kWalks; ++i) {
      const double out = Walk(s.albedo, s.g, s.eta, random);
      sum += out, squares += out * out;
    }
    const double mean = sum / kWalks;
    const double error = std::sqrt((squares / kWalks - mean * mean) / kWalks);
    INFO("albedo " << s.albedo << ", g " << s.g << ", eta " << s.eta);
    // False alarms: 5e-7 each. Another index by 0.1 would be off by ten errors or more.
    const double found = SlabReflectance(s.albedo, s.g, s.eta);
    CHECK(std::abs(found - mean) < 5 * error + 1e-3);
    CHECK(error < 0.01 * std::max(mean, 0.3));
  }
}

TEST_CASE("albedos of slabs are inverted from their reflectance",
          "[compile][subsurface]") {
  for (const double g : {0.0, 0.8}) {
    for (const double eta : {1.0, 1.33, 1.8}) {
      const SlabAlbedos albedos(g, eta);
      CHECK(albedos.Of(1) == 1);
      CHECK(albedos.Of(0) == 0);
      double before = -1;
      for (int i = 1; i < 100; ++i) {
        const double r = i / 100.0, albedo = albedos.Of(r);
        INFO("g " << g << ", eta " << eta << ", reflectance " << r);
        CHECK(albedo > before);
        CHECK(SlabReflectance(albedo, g, eta) == Approx(r).margin(1e-3));
        before = albedo;
      }
    }
  }
}

// Chandrasekhar's H function for isotropic scattering without a boundary: light along the
// normal, R = 1 - H(1) sqrt(1 - albedo) (Chandrasekhar 1960, "Radiative Transfer",
// section 34).
TEST_CASE("slabs without a boundary have a closed form", "[compile][subsurface]") {
  for (const double albedo : {0.2, 0.6, 0.9, 0.99}) {
    constexpr int kPoints = 400;
    std::vector<double> h(kPoints, 1.0);  // at the middles of kPoints parts of [0, 1]
    const auto step = [&](double mu) {
      double sum = 0;
      for (int i = 0; i < kPoints; ++i) {
        const double nu = (i + 0.5) / kPoints;
        sum += nu * h[static_cast<std::size_t>(i)] / (mu + nu) / kPoints;
      }
      return 1 / (std::sqrt(1 - albedo) + 0.5 * albedo * sum);
    };
    for (int k = 0; k < 100; ++k) {
      std::vector<double> next;
      for (int i = 0; i < kPoints; ++i) next.push_back(step((i + 0.5) / kPoints));
      h = next;
    }
    INFO("albedo " << albedo);
    CHECK(SlabReflectance(albedo, 0, 1) ==
          Approx(1 - step(1) * std::sqrt(1 - albedo)).margin(2e-4));
  }
}

}  // namespace lanelight::test

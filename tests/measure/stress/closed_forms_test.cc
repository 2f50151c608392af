// The closed forms of the stress suite against those of the reference, which were written
// apart, and against what is known at their ends.
#include "src/measure/stress/closed_forms.h"

#include <array>
#include <catch2/catch.hpp>
#include <numbers>

#include "tests/reference/closed_forms.h"
#include "tests/reference/optics.h"

namespace lanelight::stress {

TEST_CASE("stress: Fresnel terms equal those of the reference", "[stress]") {
  for (double eta : {0.3, 0.75, 1.0 + 1e-6, 1.5, 10.0}) {
    for (double c : {1e-6, 0.01, 0.5, 0.9}) {
      CAPTURE(eta, c);
      CHECK(FresnelDielectric(c, eta) ==
            Approx(closed_form::Fresnel(c, eta)).epsilon(1e-6).margin(1e-20));
      CHECK(FresnelConductor(c, eta, 2) ==
            Approx(reference::FresnelConductor(c, eta, 2)).epsilon(1e-12));
      // A metal without extinction is a dielectric.
      CHECK(FresnelConductor(c, eta, 0) ==
            Approx(FresnelDielectric(c, eta)).epsilon(1e-8).margin(1e-18));
    }
  }
}

TEST_CASE("stress: coats equal those of the reference", "[stress]") {
  for (double cosine : {0.2, 1.0}) {
    CHECK(CoatFurnace({0.6, 1.5, 0, 5}, cosine) ==
          Approx(closed_form::CoatedFurnace(0.6, 1.5, cosine, 5)).epsilon(1e-5));
  }
  // All of the light that enters a thick coat is lost.
  CHECK(CoatFurnace({1, 1.5, 100}, 0.5) == Approx(FresnelDielectric(0.5, 1.5)));
}

TEST_CASE("stress: the GGX integral has the known limits", "[stress]") {
  const auto white = [](double) { return 1.0; };
  const auto glass = [](double c) { return FresnelDielectric(c, 1.5); };
  for (double cosine : {0.1, 0.7, 1.0}) {
    CAPTURE(cosine);
    const GgxAlbedo smooth = IntegrateGgx(1e-5, 1e-5, cosine, 1.5, glass);
    CHECK(smooth.reflected == Approx(glass(cosine)).epsilon(1e-4));
    CHECK(smooth.reflected + smooth.transmitted == Approx(1).epsilon(1e-4));
    // Single scattering loses light, the more the rougher.
    CHECK(IntegrateGgx(0.5, 0.5, cosine, 0, white).reflected < 1);
    CHECK(IntegrateGgx(1, 1, cosine, 0, white).reflected <
          IntegrateGgx(0.5, 0.5, cosine, 0, white).reflected);
  }
  // alpha = 1 seen from above: the weight of a facet of cosine c^2 = t is 1 / (1 +
  // Lambda), with cos i = 2 t - 1 = 1 / (1 + 2 Lambda), so that 1 / (1 + Lambda) = 2 (2 t
  // - 1) / (2 t); facets of alpha 1 have uniform t: int_1/2^1 (2 - 1 / t) dt.
  CHECK(IntegrateGgx(1, 1, 1, 0, white).reflected ==
        Approx(1 - std::numbers::ln2).epsilon(1e-4));
}

TEST_CASE("stress: rooms and polygons equal those of the reference", "[stress]") {
  CHECK(ClosedRoom(2, 0.9, 30) == Approx(closed_form::ClosedRoom(2, 0.9, 30)));
  CHECK(ClosedRoom(2, 1, 30) == 62);
  const std::array<Vec3d, 3> corners = {Vec3d{1, 0, 2}, Vec3d{0, 2, 1}, Vec3d{-1, -1, 3}};
  CHECK(PolygonIrradiance(corners) ==
        Approx(closed_form::PolygonIrradiance(1, corners, {}, {0, 0, 1})));
  // From the middle of its face, one side of a cube fills a sixth of the sphere.
  CHECK(SquareSolidAngle(1, 1) == Approx(4 * std::numbers::pi / 6));
}

}  // namespace lanelight::stress

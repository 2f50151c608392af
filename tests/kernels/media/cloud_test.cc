// The density of clouds on every target against the scalar twin.
#include "kernels/simd/each_target-inl.h"

#include "kernels/media/voxels-inl.h"

LANELIGHT_BEGIN_KERNELS

// At a multiple of 16 points of the box; planes of x, y, z.
void CloudDensityAt(const CloudShape& cloud, const float* xyz, float* value,
                    std::size_t count) {
  const DF df;
  for (std::size_t i = 0; i < count; i += hn::Lanes(df)) {
    const V3 p = {hn::LoadU(df, xyz + i), hn::LoadU(df, xyz + count + i),
                  hn::LoadU(df, xyz + 2 * count + i)};
    hn::StoreU(CloudDensity(cloud, p), df, value + i);
  }
}

LANELIGHT_END_KERNELS

#if HWY_ONCE

#include <catch2/catch.hpp>
#include <random>
#include <vector>

#include "src/scene/compile/media.h"
#include "tests/kernels/media/varying_scenes.h"
#include "tests/reference/media.h"
#include "tests/support/test_target.h"

namespace lanelight {

HWY_EXPORT(CloudDensityAt);

namespace test {

// The noise is right within 1e-5, its slopes therefore within 2e-3, and the point that is
// looked up within 1e-4; times the slope of five octaves, of 3, and of the height, of 10.
TEST_CASE("media: the density of clouds", "[media]") {
  constexpr std::size_t kPoints = 2048;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> fraction(0, 1);
  std::vector<float> xyz(3 * kPoints), found(kPoints);
  for (float& v : xyz) v = fraction(random);
  Medium still = CloudLump();
  still.wispiness = 0;
  for (const Medium& medium : {CloudLump(), still}) {
    const CloudShape cloud = CompileMediumGrid(medium, {}).cloud;
    for (const std::string& target : AvailableTargets()) {
      ForceTarget(target);
      LANELIGHT_ON(TestTarget(), CloudDensityAt)(cloud, xyz.data(), found.data(),
                                                 kPoints);
      double worst = 0, mean = 0;
      for (std::size_t i = 0; i < kPoints; ++i) {
        const Vec3d size = medium.box_max - medium.box_min;
        const Vec3d at = {xyz[i] * size.x, xyz[kPoints + i] * size.y,
                          xyz[2 * kPoints + i] * size.z};
        const Vec3d p = medium.world_from_medium.Point(medium.box_min + at);
        const double density =
            reference::MediumAt(medium, p).sigma_s.x / medium.sigma_s.x;
        worst = std::max(worst, std::abs(density - found[i]));
        mean += density / kPoints;
      }
      INFO(target << ", worst " << worst);
      CHECK(worst < 3e-3);
      CHECK(mean > 0.05);
    }
    ForceTarget("");
  }
}

}  // namespace test
}  // namespace lanelight

#endif  // HWY_ONCE

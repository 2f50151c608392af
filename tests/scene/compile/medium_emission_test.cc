// Bounds of media that vary, and the colours of black bodies, as the kernels look them
// up.
#include <catch2/catch.hpp>
#include <cmath>

#include "src/base/image/spectrum.h"
#include "src/base/image/upsampling.h"
#include "src/scene/compile/media.h"
#include "tests/kernels/media/varying_scenes.h"
#include "tests/reference/media.h"

namespace lanelight::test {
namespace {

// The bound of the cell around a point of the box.
double MajorantAt(const MediumGrid& grid, Vec3d fraction) {
  std::size_t index = 0;
  for (int a = 2; a >= 0; --a) {
    const int cell = std::min(static_cast<int>(fraction[a] * kMajorantCells), 15);
    index = index * kMajorantCells + static_cast<std::size_t>(cell);
  }
  return grid.majorants[index];
}

// Nowhere below the density; the mean of bound and of density over the box.
std::pair<double, double> CheckMajorants(const Medium& medium) {
  const MediumGrid grid = CompileMediumGrid(medium, WorldFrame());
  const Vec3d size = medium.box_max - medium.box_min;
  double bounds = 0, densities = 0;
  constexpr int kSide = 40;
  for (int i = 0; i < kSide * kSide * kSide; ++i) {
    const Vec3d fraction = {(i % kSide + 0.5) / kSide, (i / kSide % kSide + 0.5) / kSide,
                            (i / kSide / kSide + 0.5) / kSide};
    const Vec3d p = medium.box_min +
                    Vec3d{fraction.x * size.x, fraction.y * size.y, fraction.z * size.z};
    const auto at = reference::MediumAt(medium, medium.world_from_medium.Point(p));
    const double density = at.sigma_s.x / medium.sigma_s.x;
    bounds += MajorantAt(grid, fraction), densities += density;
    if (density > MajorantAt(grid, fraction))
      FAIL("the density " << density << " is above its bound");
  }
  return {bounds / (kSide * kSide * kSide), densities / (kSide * kSide * kSide)};
}

// Colours at random voxels, most of them saturated.
Medium RandomColors() {
  Medium medium;
  medium.kind = MediumKind::kRgbGrid;
  medium.grid_size[0] = 5, medium.grid_size[1] = 4, medium.grid_size[2] = 3;
  reference::Random random(7);
  for (int i = 0; i < 6 * 60; ++i) {
    const double v = random.Uniform();
    medium.grid.push_back(v < 0.3 ? 0 : static_cast<float>(v * v * 4));
  }
  return medium;
}

// Points of the box, and a bin, where extinction is above the bound of their cell.
int CountAbove(const MediumGrid& spectra, const MediumGrid& bounds) {
  Medium shape = RandomColors();
  int above = 0;
  reference::Random random(3);
  for (int i = 0; i < 20000; ++i) {
    const Vec3d fraction = {random.Uniform(), random.Uniform(), random.Uniform()};
    const auto bin = static_cast<std::size_t>(random.Uniform() * kWavelengthBins);
    const double t = SigmoidPlace(CarriedWavelengths().centre[bin]);
    for (std::size_t v = 0; v < 120; ++v) {
      const float* s = spectra.values.data() + 4 * v;
      const double p = (s[0] * t + s[1]) * t + s[2];
      const double value = s[3] * (0.5 + 0.5 * p / std::sqrt(1 + p * p));
      // Both parts of the extinction, in the place of scattering's red.
      shape.grid[v / 2 * 6 + (v % 2 == 0 ? 0 : 3)] = static_cast<float>(value);
    }
    const auto at = reference::MediumAt(shape, fraction);
    above += at.sigma_a.x + at.sigma_s.x > MajorantAt(bounds, fraction);
  }
  return above;
}

}  // namespace

TEST_CASE("bounds of colours are valid at each wavelength",
          "[compile][media][spectral]") {
  const Medium medium = RandomColors();
  const MediumGrid spectral =
      CompileMediumGrid(medium, WorldFrame(), Transport::kSpectral);
  REQUIRE(spectral.values.size() == 8 * 60);
  CHECK(CountAbove(spectral, spectral) == 0);
  // Power: those of red, green and blue do not.
  CHECK(CountAbove(spectral, CompileMediumGrid(medium, WorldFrame())) > 10);
}

TEST_CASE("spectra of voxels have their specified colours",
          "[compile][media][spectral]") {
  reference::Random random(5);
  double mean = 0;
  for (int i = 0; i < 500; ++i) {
    const Rgb color = {random.Uniform() * 3, random.Uniform() * 3, random.Uniform() * 3};
    const VoxelSpectrum s = SpectrumOfVoxel(color);
    const SigmoidSpectrum shape = {{s.c[0], s.c[1], s.c[2]}};
    double maximum = 0;
    const std::vector<float> values =
        BinValues([&](double nm) { return s.scale * shape(nm); });
    for (const float v : values) maximum = std::max(maximum, double{v});
    CHECK(maximum <= LargestOf(s));
    CHECK(LargestOf(s) <= maximum * 1.01 + 1e-6);
    mean += Length(ColorOfBins(values) - color) / Length(color) / 500;
  }
  CHECK(mean < 3e-3);
  const VoxelSpectrum grey = SpectrumOfVoxel({0.3, 0.3, 0.3});
  CHECK(LargestOf(grey) == double{0.6f} / 2);
  CHECK(LargestOf(SpectrumOfVoxel({})) == 0);
}

TEST_CASE("bounds of clouds and NanoVDB grids are valid", "[compile][media]") {
  const TemporaryFolder folder;
  CheckMajorants(SparseLump(folder));
  CheckMajorants(CloudLump());
  Medium thin = CloudLump();
  thin.density = 0.05;
  thin.box_max.y = 3;                       // above 1, where what counts is below 0
  CHECK(CheckMajorants(thin).first < 0.4);  // tighter than 1, which pbrt takes
}

TEST_CASE("bounds of a NanoVDB grid in a box far larger", "[compile][media]") {
  const TemporaryFolder folder;
  Medium medium = SparseLump(folder);
  const float largest = medium.sparse_density->largest();
  for (const double far : {1e12, 1e40, 1e300}) {
    medium.box_max = {far, far, far};
    const MediumGrid grid = CompileMediumGrid(medium, WorldFrame());
    INFO(far);
    CHECK(grid.majorants[0] >= largest);
    for (const float v : grid.majorants) {
      if (!(v >= 0 && v <= largest * 1.001f)) FAIL("the bound " << v);
    }
  }
}

TEST_CASE("colours of black bodies", "[compile][media]") {
  // A spectrum with its maximum where the eye has its own is nearly 1 for it.
  const double seen = Luminance(RgbOfBlackbody(2.897771955e6 / 560));
  CHECK(seen < kPhotometricIntegral);
  CHECK(seen > 0.97 * kPhotometricIntegral);
  for (const double kelvin : {1500.0, 3000.0, 6500.0, 20000.0}) {
    const Rgb color = RgbOfBlackbody(kelvin), same = RgbFromBlackbody(kelvin);
    CHECK(color.x / Luminance(color) == Approx(same.x).epsilon(1e-6));
    CHECK(color.z / Luminance(color) == Approx(same.z).epsilon(1e-6));
  }
  CHECK(Luminance(RgbOfBlackbody(500)) < 1e-5);
}

TEST_CASE("the table of black bodies", "[compile][media]") {
  Medium medium;
  medium.kind = MediumKind::kUniformGrid;
  medium.temperature = {20000};
  medium.emission = {1, 1, 1};
  const BlackbodyTable table = CompileMediumEmission(medium, Transport::kRgb).blackbody;
  for (double kelvin = 1000; kelvin < 20000; kelvin *= 1.0117) {
    const double at = std::log(kelvin / kMinKelvin) * table.entries_per_log;
    const auto i = static_cast<std::size_t>(at);
    const Rgb expected = RgbOfBlackbody(kelvin);
    const double maximum = std::max({expected.x, expected.y, expected.z});
    for (int c = 0; c < 3; ++c) {
      const double low = table.colors[3 * i + c], high = table.colors[3 * i + 3 + c];
      const double found = low + (at - static_cast<double>(i)) * (high - low);
      CHECK(std::abs(found - expected[c]) < 1e-3 * maximum);
    }
  }
}

}  // namespace lanelight::test

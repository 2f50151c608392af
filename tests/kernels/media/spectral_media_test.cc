// Media that vary, at wavelengths: black bodies, coloured emission, grids of colours.
// Constants against integrals over wavelengths that know of no bins, others against the
// scalar tracer.
#include <catch2/catch.hpp>
#include <cmath>

#include "src/base/image/spectrum.h"
#include "tests/agreement/spectral_reference.h"
#include "tests/kernels/media/varying_scenes.h"

namespace lanelight::test {
namespace {

constexpr Rgb kSlabSigma = {0.3, 1, 2.5}, kGlow = {0.4, 1.2, 0.2};

Spectrum LeftOfSlab() {
  const Spectrum sigma = UpsampledColor(kSlabSigma);
  return [=](double nm) { return std::exp(-0.8 * sigma(nm)); };
}

// What the slab emits, of light in units of D65.
Rgb SlabOfLight(const Spectrum& emission) {
  const Spectrum left = LeftOfSlab();
  return FilmRgb([&](double nm) { return emission(nm) * (1 - left(nm)); });
}

// Over its maximum, in units of D65 and the scale of RgbOfBlackbody.
Spectrum GlowOf(double kelvin) {
  const Spectrum body = BlackbodySpectrum(kelvin), d65 = DaylightD65();
  const double maximum = body(2.897771955e6 / kelvin);
  const double unit =
      kPhotometricIntegral / Luminance(FilmRgb([&](double nm) { return 1 / d65(nm); }));
  return [=](double nm) { return unit * body(nm) / maximum / d65(nm); };
}

stat::ImageTestResult AgainstKnown(const SceneDescription& scene, Rgb expected) {
  const auto known = stat::ExpectedImage(4, 4, [&](int, int) { return expected; });
  return stat::CompareMeans(RenderWavefront(scene, 1 << 14), known,
                            {4, 1e-6, 3e-3, 3e-3 * Luminance(expected)});
}

void CheckSpectralSlab(const SceneDescription& scene, Rgb expected) {
  const auto result = AgainstKnown(Spectral(scene), expected);
  INFO(result.ToString());
  CHECK(result.same);
  CHECK(result.detectable_bias < 0.05);
  // Power: what RGB makes of it is not that near.
  CHECK_FALSE(AgainstKnown(scene, expected).same);
}

Medium HeatedGrid(Rgb sigma_a, float kelvin) {
  Medium grid = ConstantGrid(sigma_a, {});
  grid.temperature.assign(64, kelvin / 300 + 1);
  grid.temperature_offset = 1, grid.temperature_scale = 300;
  grid.emission = {0.1, 0.1, 0.1};
  grid.emission_grid.assign(64, 2.0f);
  return grid;
}

Medium ColorGrid(Rgb sigma_a, Rgb sigma_s, Rgb emission = {}) {
  Medium medium = ConstantGrid({}, {});
  medium.kind = MediumKind::kRgbGrid;
  medium.grid.clear();
  for (int v = 0; v < 64; ++v) {
    for (const Rgb& color : {sigma_a, sigma_s}) {
      for (int c = 0; c < 3; ++c) medium.grid.push_back(static_cast<float>(color[c]));
    }
    for (int c = 0; c < 3; ++c) {
      medium.emission_grid.push_back(static_cast<float>(emission[c]));
    }
  }
  if (emission != Rgb{}) medium.emission = {0.5, 0.5, 0.5};
  return medium;
}

// Colours of every kind, by voxel, that scatter and glow.
Medium ColorLump() {
  Medium lump = MakeMedium({}, {}, 0.3);
  lump.kind = MediumKind::kRgbGrid;
  lump.grid_size[0] = 2, lump.grid_size[1] = 3, lump.grid_size[2] = 2;
  const float levels[] = {0.05f, 2, 0.3f, 1, 0, 3, 0.6f};
  const float tint[] = {0.2f, 1, 2, 2, 1, 0.3f};
  for (int i = 0; i < 72; ++i) lump.grid.push_back(tint[i % 6] * levels[i * 5 % 7]);
  for (int i = 0; i < 36; ++i) lump.emission_grid.push_back(levels[i * 3 % 7]);
  lump.emission = {0.3, 0.3, 0.3};
  lump.box_min = {-1, -1, 0};
  lump.box_max = {1, 1, 2};
  return lump;
}

SceneDescription InGrey(SceneDescription scene) {
  for (Material& m : scene.materials) m.reflectance.constant = Grey(0.6);
  for (AreaLight& light : scene.area_lights) light.radiance = Grey(5);
  return scene;
}

}  // namespace

TEST_CASE("spectral media: a slab of black bodies", "[media][spectral][closed-form]") {
  for (const double kelvin : {1200.0, 3000.0, 9000.0}) {
    INFO(kelvin << " K");
    CheckSpectralSlab(
        Slab(HeatedGrid(kSlabSigma, float(kelvin))),
        SlabOfLight([glow = GlowOf(kelvin)](double nm) { return 0.2 * glow(nm); }));
  }
  const TemporaryFolder folder;
  Medium sparse = ConstantSparse(folder.File("a.nvdb"), kSlabSigma, {}, 2500);
  sparse.emission = {0.1, 0.1, 0.1};
  CheckSpectralSlab(Slab(sparse), SlabOfLight([glow = GlowOf(2500)](double nm) {
                      return 0.1 * glow(nm);
                    }));
  // Power: the unit of light matters, and so does that three wavelengths differ.
  const Spectrum d65 = DaylightD65(), glow = GlowOf(3000);
  const Rgb right = SlabOfLight(glow);
  const Rgb no_unit = SlabOfLight([&](double nm) { return glow(nm) * d65(nm) / 100; });
  const Rgb one = SlabOfLight([&](double) { return glow(550); });
  CHECK(Length(right - no_unit) > 0.05 * Length(right));
  CHECK(Length(right - one) > 0.05 * Length(right));
}

TEST_CASE("spectral media: cold black bodies are dark", "[media][spectral]") {
  for (const float kelvin : {101.0f, 160.0f, 250.0f, 350.0f, 500.0f}) {
    INFO(kelvin << " K");
    const auto image = RenderWavefront(Spectral(Slab(HeatedGrid(Grey(1), kelvin))), 256);
    for (const Rgb& mean : image.mean) CHECK(Length(mean) < 1e-9);
  }
}

TEST_CASE("spectral media: black bodies in grey are those of RGB", "[media][spectral]") {
  for (const float kelvin : {1500.0f, 3000.0f, 6500.0f}) {
    const SceneDescription scene = Slab(HeatedGrid(Grey(1), kelvin));
    const auto rgb = RenderWavefront(scene, 4096);
    const auto spectral = RenderWavefront(Spectral(scene), 4096, "points=sobol");
    Rgb means[2];
    for (std::size_t i = 0; i < rgb.mean.size(); ++i) {
      means[0] += rgb.mean[i], means[1] += spectral.mean[i];
    }
    INFO(kelvin << " K: " << means[0].x << " " << means[1].x);
    // A fit to the observer there, its table here.
    CHECK(Length(means[0] - means[1]) < 0.04 * Length(means[0]));
  }
}

TEST_CASE("spectral media: coloured emission of a slab",
          "[media][spectral][closed-form]") {
  Medium grid = ConstantGrid(kSlabSigma, {});
  grid.emission = kGlow;
  CheckSpectralSlab(Slab(grid), SlabOfLight(UpsampledColor(kGlow)));
  // As a spectrum, whose luminance is the scale.
  const Spectrum lamp = BlackbodySpectrum(2856), d65 = DaylightD65();
  const Spectrum in_d65 = [&](double nm) { return lamp(nm) / d65(nm); };
  const double scale = 0.7 / Luminance(FilmRgb(in_d65));
  const Rgb expected = SlabOfLight([&](double nm) { return scale * in_d65(nm); });
  grid.emission = RgbFromBlackbody(2856) * 0.7;
  grid.emission_spectrum = Own(lamp);
  CheckSpectralSlab(Slab(grid), expected);
  Medium plain = MakeMedium(kSlabSigma, {}, 0, grid.emission);
  plain.emission_spectrum = Own(lamp);
  CheckSpectralSlab(Slab(plain), expected);
}

TEST_CASE("spectral media: a grid of one colour is homogeneous",
          "[media][spectral][closed-form]") {
  CheckSpectralSlab(Slab(ColorGrid(kSlabSigma, {}), Grey(1)), FilmRgb(LeftOfSlab()));
  CheckSpectralSlab(
      Slab(ColorGrid(kSlabSigma, {}, kGlow)),
      SlabOfLight([glow = UpsampledColor(kGlow)](double nm) { return glow(nm) / 2; }));
  const SceneDescription grid = BallOf(ColorGrid({0.2, 0.6, 1.5}, {2, 0.5, 0.8}));
  const SceneDescription same = BallOf(MakeMedium({0.2, 0.6, 1.5}, {2, 0.5, 0.8}));
  stat::CheckSame(
      stat::CompareMeans(RenderWavefront(Spectral(grid), 2048),
                         RenderWavefront(Spectral(same), 2048), {4, 1e-6, 5e-3, 1e-5}),
      0.1);
}

TEST_CASE("spectral media: grey grids are those of RGB", "[media][spectral]") {
  Medium lump = ColorLump();
  for (std::vector<float>* values : {&lump.grid, &lump.emission_grid}) {
    for (std::size_t v = 0; v < values->size(); ++v) {
      (*values)[v] = (*values)[v / 3 * 3];
    }
  }
  const SceneDescription scene = InGrey(BallOf(lump));
  const auto rgb = RenderWavefront(scene, 64);
  CHECK(LargestDifference(rgb, RenderWavefront(Spectral(scene), 64)) < 1e-4);
}

TEST_CASE("spectral media: grids of colours agree with the scalar tracer",
          "[media][spectral][agreement]") {
  const SceneDescription scene = BallOf(ColorLump());
  const auto reference = SpectralReference(scene, 64);
  stat::CheckSame(stat::CompareMeans(RenderWavefront(Spectral(scene), 4096), reference,
                                     {4, 1e-6, 5e-3, 1e-5}),
                  0.1);
  // Power: scattering of red in the place of blue.
  Medium swapped = ColorLump();
  for (std::size_t v = 3; v < swapped.grid.size(); v += 6) {
    std::swap(swapped.grid[v], swapped.grid[v + 2]);
  }
  CHECK_FALSE(stat::CompareMeans(RenderWavefront(Spectral(BallOf(swapped)), 4096),
                                 reference, {4, 1e-6, 5e-3, 1e-5})
                  .same);
}

}  // namespace lanelight::test

// Bins of wavelengths, and spectra made up for colours.
#include "src/base/image/wavelengths.h"

#include <catch2/catch.hpp>
#include <random>

#include "src/base/image/spectrum.h"
#include "src/base/image/upsampling.h"

namespace lanelight {
namespace {

// Variance over triples of what the film gets of a spectrum, relative to the square of
// its mean, all channels together.
double NoiseOf(const std::vector<float>& values) {
  const WavelengthBins& bins = CarriedWavelengths();
  Rgb sum, squares;
  for (int i = 0; i < kTriples; ++i) {
    Rgb one;
    for (int b = i; b < kWavelengthBins; b += kTriples) {
      one += bins.film[b] * double(values[static_cast<std::size_t>(b)]);
    }
    sum += one;
    squares += one * one;
  }
  const Rgb mean = sum / kTriples;
  const Rgb variance = squares / kTriples - mean * mean;
  return (variance.x + variance.y + variance.z) / Dot(mean, mean);
}

double Largest(Rgb c) { return std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)}); }

// Colour of a reflectance under D65, by a sum of its own.
Rgb UnderWhite(const Spectrum& reflectance) {
  Rgb sum;
  for (double nm = 380.125; nm < 780; nm += 0.25) {
    sum += WhiteFraction(nm) * (reflectance(nm) * 0.25);
  }
  return sum;
}

const std::vector<float> kOnes(kWavelengthBins, 1.0f);

}  // namespace

TEST_CASE("wavelengths: bins fill the range, and every triple is white", "[spectrum]") {
  const WavelengthBins& bins = CarriedWavelengths();
  CHECK(bins.edge.front() == kFirstCarriedNm);
  CHECK(bins.edge.back() == kLastCarriedNm);
  for (int b = 0; b < kWavelengthBins; ++b) {
    CHECK(bins.edge[b] < bins.edge[b + 1]);
    CHECK((bins.centre[b] > bins.edge[b] && bins.centre[b] < bins.edge[b + 1]));
  }
  for (int i = 0; i < kTriples; ++i) {
    const Rgb white =
        bins.film[i] + bins.film[kTriples + i] + bins.film[2 * kTriples + i];
    CHECK(Largest(white - Rgb{1, 1, 1}) < 1e-9);
  }
}

TEST_CASE("wavelengths: colours add little noise, and none to white", "[spectrum]") {
  CHECK(NoiseOf(kOnes) < 1e-15);
  CHECK(NoiseOf(BinValues(UpsampledReflectance({0.7, 0.5, 0.4}))) < 0.005);
  CHECK(NoiseOf(BinValues(UpsampledReflectance({0.63, 0.065, 0.05}))) < 0.2);
}

TEST_CASE("wavelengths: spectra in bins have the colour of the whole", "[spectrum]") {
  for (const char* name : {"metal-Cu-k", "metal-Au-eta", "glass-BK7"}) {
    const Spectrum spectrum = *SpectrumOfName(name);
    const Rgb whole = UnderWhite(spectrum);
    INFO(name);
    CHECK(Largest(ColorOfBins(BinMeans(spectrum)) - whole) < 1e-3 * Largest(whole));
  }
  const Spectrum d65 = DaylightD65();
  for (double kelvin : {2000.0, 2856.0, 6500.0, 12000.0}) {
    const Spectrum light = BlackbodySpectrum(kelvin);
    const Rgb bins =
        ColorOfBins(BinMeans([&](double nm) { return light(nm) / d65(nm); }));
    const Rgb whole = UnderWhite([&](double nm) { return light(nm) / d65(nm); });
    INFO(kelvin << " K");
    CHECK(Largest(bins - whole) < 1e-3 * Largest(whole));
    // The observer's table and the fit to it that RGB has.
    const Rgb by_fit = RgbFromBlackbody(kelvin);
    CHECK(Largest(bins / Luminance(bins) - by_fit) < 0.03 * Largest(by_fit));
  }
}

TEST_CASE("wavelengths: bins receive light of a single spectral line", "[spectrum]") {
  // Two nanometres wide: wider than the bins there, narrower than twice them.
  const auto line = [](double nm) { return std::abs(nm - 546.1) < 1 ? 1.0 : 0.0; };
  const std::vector<float> values = BinMeans(line);
  const Rgb found = ColorOfBins(values);
  Rgb exact;
  constexpr int kSteps = 2000;
  for (int i = 0; i < kSteps; ++i) {
    exact += WhiteFraction(545.1 + 2.0 * (i + 0.5) / kSteps) * (2.0 / kSteps);
  }
  CHECK(Largest(found - exact) < 0.02 * Largest(exact));
}

TEST_CASE("upsampling: colours round-trip, greys are constant", "[spectrum]") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit;
  double mean = 0, worst = 0;
  constexpr int kColors = 300;
  for (int i = 0; i < kColors; ++i) {
    const Rgb rgb = {unit(random), unit(random), unit(random)};
    const double miss = Largest(ColorOfBins(BinValues(UpsampledReflectance(rgb))) - rgb);
    mean += miss / kColors;
    worst = std::max(worst, miss);
  }
  CHECK(mean < 1e-5);
  CHECK(worst < 1e-3);
  for (int corner = 0; corner < 8; ++corner) {
    const Rgb rgb = {double(corner & 1), double(corner >> 1 & 1), double(corner >> 2)};
    const std::vector<float> values = BinValues(UpsampledReflectance(rgb));
    CHECK(Largest(ColorOfBins(values) - rgb) < 1e-3);
    for (float v : values) CHECK((v >= 0 && v <= 1));
  }
  const Spectrum grey = UpsampledReflectance({0.3, 0.3, 0.3});
  CHECK(grey(400) == 0.3);
  CHECK(grey(700) == 0.3);
}

TEST_CASE("upsampling: unbounded colours", "[spectrum]") {
  const Rgb light = {20, 8, 3};
  CHECK(Largest(ColorOfBins(BinValues(UpsampledColor(light))) - light) < 1e-3);
  CHECK(UpsampledColor({})(550) == 0);
  CHECK(UpsampledColor({4, 4, 4})(550) == 4);
}

TEST_CASE("glasses: indices and Abbe numbers of the catalogue", "[spectrum]") {
  // Schott; V = (n_d - 1) / (n_F - n_C).
  const std::map<std::string, double> abbe = {
      {"glass-BAF10", 47.11}, {"glass-BK7", 64.17}, {"glass-F10", 28.41},
      {"glass-F11", 25.76},   {"glass-F5", 32.21},  {"glass-FK51A", 84.47},
      {"glass-LASF9", 32.17}};
  for (const auto& [name, v] : abbe) {
    INFO(name);
    double eta = 0;
    REQUIRE(NamedGlassEta(name, &eta));
    const Spectrum index = *SpectrumOfName(name);
    CHECK(index(587.5618) == Approx(eta).margin(3e-5));
    const double spread = index(486.1327) - index(656.2725);
    CHECK((index(587.5618) - 1) / spread == Approx(v).margin(0.02));
  }
}

}  // namespace lanelight

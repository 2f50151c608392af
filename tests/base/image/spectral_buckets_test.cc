// Buckets of wavelengths: names, units, and what bins of wavelengths add to them.
#include "src/base/image/spectral_buckets.h"

#include <catch2/catch.hpp>
#include <random>

#include "src/base/image/wavelengths.h"
#include "src/render/films/accumulator.h"

namespace lanelight {
namespace {

// Mean over the carried wavelengths of a bucket of light that is constant in bins, in
// units of D65: by small steps.
double SteppedMean(const std::vector<double>& radiance, double low, double high) {
  constexpr int kSteps = 20000;
  const WavelengthBins& bins = CarriedWavelengths();
  const Spectrum white = WhiteRadiance();
  double sum = 0;
  int count = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double nm = low + (high - low) * (i + 0.5) / kSteps;
    if (nm < kFirstCarriedNm || nm > kLastCarriedNm) continue;
    const auto above = std::upper_bound(bins.edge.begin(), bins.edge.end(), nm);
    sum += white(nm) * radiance[static_cast<std::size_t>(above - bins.edge.begin() - 1)];
    ++count;
  }
  return count == 0 ? 0 : sum / count;
}

}  // namespace

TEST_CASE("buckets: names of channels are those of pbrt-v4", "[spectrum][buckets]") {
  const SpectralBuckets defaults = {16};
  CHECK(ChannelName(defaults, 0) == "S0.374,688nm");
  CHECK(ChannelName(defaults, 6) == "S0.550,938nm");
  CHECK(ChannelName({2, 400, 700}, 1) == "S0.625,000nm");
  CHECK(defaults.Edge(0) == 360);
  CHECK(defaults.Edge(16) == 830);
}

TEST_CASE("buckets: white light is D65 of luminance 1", "[spectrum][buckets]") {
  // The observer's integral is 106.857 nm (pbrt-v4's CIE_Y_integral); 105.67 nm times
  // what D65 has at 560 nm is what it sees of D65.
  const Spectrum white = WhiteRadiance();
  CHECK(white(560) == Approx(106.857 / 105.67).epsilon(3e-4));
  CHECK(white(460) / white(560) == Approx(1.178).epsilon(1e-3));
}

TEST_CASE("buckets: the mean over triples is that over a bucket's wavelengths",
          "[spectrum][buckets]") {
  std::mt19937 engine(11);
  std::uniform_real_distribution<double> uniform(0, 2);
  std::vector<double> radiance(kWavelengthBins);
  for (double& r : radiance) r = uniform(engine);
  for (const SpectralBuckets& buckets :
       {SpectralBuckets{16}, SpectralBuckets{1}, SpectralBuckets{7, 391.3, 702.9},
        SpectralBuckets{100, 500, 520}, SpectralBuckets{3, 790, 830}}) {
    const BucketFractions fractions(buckets);
    std::vector<double> sums(static_cast<std::size_t>(buckets.count));
    for (int t = 0; t < kTriples; ++t) {
      for (int b = t; b < kWavelengthBins; b += kTriples) {
        fractions.Add(static_cast<std::uint32_t>(b),
                      radiance[static_cast<std::size_t>(b)], sums.data());
      }
    }
    for (int k = 0; k < buckets.count; ++k) {
      INFO(buckets.count << " from " << buckets.first << ", bucket " << k);
      const double mean = SteppedMean(radiance, buckets.Edge(k), buckets.Edge(k + 1));
      CHECK(sums[static_cast<std::size_t>(k)] / kTriples ==
            Approx(mean).epsilon(2e-3).margin(1e-12));
    }
  }
}

TEST_CASE("buckets: films store them per pixel, only where requested",
          "[image][buckets]") {
  FilmAccumulator film(0, 0, 2, 1, {}, Auxiliary::kNone);
  const auto without = film.Columns().size();
  CHECK(film.buckets() == nullptr);
  film.UseBuckets({4, 400, 600});
  REQUIRE(film.buckets() != nullptr);
  CHECK(film.Columns().size() == without + 1);
  CHECK(film.Columns().back().RowBytes() == 4 * sizeof(double));
  // One sample of triple 5: its short wavelength is of bin 5, and so on.
  const float color[] = {0}, at_long[] = {2}, middle[] = {3}, at_short[] = {5},
              triple[] = {5};
  const float* const planes[] = {color, color, color, at_long, middle, at_short, triple};
  film.AddSamples(1, 0, planes, 1);
  const BucketFractions fractions({4, 400, 600});
  std::vector<double> sums(4);
  fractions.Add(5, 5, sums.data());
  fractions.Add(kTriples + 5, 3, sums.data());
  fractions.Add(2 * kTriples + 5, 2, sums.data());
  for (int k = 0; k < 4; ++k) {
    CHECK(film.Bucket(1, 0, k) == sums[static_cast<std::size_t>(k)]);
    CHECK(film.Bucket(0, 0, k) == 0);
  }
}

}  // namespace lanelight

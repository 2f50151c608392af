// control=regression: its functions, and how samples come into its films.
#include <catch2/catch.hpp>

#include "tests/kernels/control/regression_samples.h"

namespace lanelight {

using namespace regression_samples;

TEST_CASE("regression: the functions are orthonormal with mean 0", "[control]") {
  constexpr int kSteps = 200, kFunctions = RegressionFilm::kFunctions - 2;
  double means[kFunctions] = {}, products[kFunctions][kFunctions] = {};
  for (int a = 0; a < kSteps; ++a) {
    for (int b = 0; b < kSteps; ++b) {
      const float u = (float(a) + 0.5f) / kSteps, v = (float(b) + 0.5f) / kSteps;
      const float numbers[] = {u, v, u, v, u, v, 0};
      float codes[RegressionFilm::kPlanes], phi[RegressionFilm::kFunctions];
      Encode(numbers, codes);
      RegressionFilm::Functions(codes, phi);
      for (int i = 0; i < kFunctions; ++i) {
        means[i] += double(phi[i]) / (kSteps * kSteps);
        for (int j = 0; j < kFunctions; ++j) {
          products[i][j] += double(phi[i] * phi[j]) / (kSteps * kSteps);
        }
      }
    }
  }
  // The same numbers drive position, direction (2 to 3, 6 to 8) and light (4, 5, 9) here.
  constexpr int kKind[kFunctions] = {0, 1, 0, 1, 0, 1, 2, 3, 4, 4};
  for (int i = 0; i < kFunctions; ++i) {
    CHECK(std::abs(means[i]) < 1e-4);
    for (int j = 0; j < kFunctions; ++j) {
      CHECK(products[i][j] == Approx(kKind[i] == kKind[j] ? 1 : 0).margin(1e-3));
    }
  }
}

TEST_CASE(
    "regression: functions of choices have mean 0 and exist only where there is a choice",
    "[control]") {
  float phi[RegressionFilm::kFunctions];
  for (float p : {0.001f, 0.04f, 0.3f, 0.5f, 0.97f}) {
    constexpr int kSteps = 1 << 16;
    double mean = 0, square = 0;
    for (int i = 0; i < kSteps; ++i) {
      const float u = float(i) / kSteps;
      const float codes[] = {0, 0, 0, std::bit_cast<float>(ChoiceCode(u, p) << 16)};
      RegressionFilm::Functions(codes, phi);
      for (int j = 0; j < 11; ++j) REQUIRE(phi[j] == 0);
      mean += double(phi[11]) / kSteps;
      square += double(phi[11]) * double(phi[11]) / kSteps;
    }
    CHECK(std::abs(mean) < 1e-6);
    CHECK(square == Approx(9 * double(p) * (1 - double(p))).epsilon(0.05));
  }
}

TEST_CASE("regression: coefficients never depend on their own half of the samples",
          "[control]") {
  constexpr std::uint32_t kChanged = 30;
  for (const SampleGroups& groups : kAllGroups) {
    Samples a(4, 60, groups, 4), b = a;
    for (int c = 0; c < 3; ++c) b.At(c, 5, kChanged) += 100;
    const std::vector<std::uint64_t> counts(16, 60);
    const ControlledColors colors = {counts, {}};
    RegressionFilm of_a({0, 0, 4, 4}, groups, 1), of_b({0, 0, 4, 4}, groups, 1);
    a.AddTo(of_a), b.AddTo(of_b);
    of_a.Fit(colors), of_b.Fit(colors);
    const std::uint32_t num_replicates = groups.replicates ? kReplicates : 2;
    int differ = 0;
    for (std::size_t p = 0; p < 16; ++p) {
      ReplicateSums sums_a, sums_b;
      of_a.CorrectReplicates(p, sums_a), of_b.CorrectReplicates(p, sums_b);
      for (std::uint32_t t = 0; t < num_replicates; ++t) {
        const bool same = sums_a.of[t][0] == sums_b.of[t][0];
        CHECK(sums_a.of[t][0] != 0);
        if (t % 2 == kChanged / groups.unit % num_replicates % 2) CHECK(same);
        differ += !same;
      }
    }
    CHECK(differ > 8);
  }
}

TEST_CASE("regression: bit-identical for any order of samples", "[control]") {
  for (const SampleGroups& groups : kAllGroups) {
    Samples s(4, 150, groups, 6);
    RegressionFilm whole({0, 0, 4, 4}, groups, 1), parts({0, 0, 4, 4}, groups, 1);
    s.AddTo(whole), s.AddTo(parts, 7);
    const std::vector<MutableStateColumn> a = whole.Columns(), b = parts.Columns();
    for (std::size_t i = 0; i < a.size(); ++i) {
      CHECK(std::memcmp(a[i].data, b[i].data, a[i].Bytes()) == 0);
    }
  }
}

TEST_CASE("regression: a crop of whole blocks equals that part of the image",
          "[control]") {
  constexpr int kSide = 12, kFrom = RegressionFilm::kBlock;
  const SampleGroups groups = {1, false};
  Samples s(kSide, 16, groups, 8);
  const FilmAccumulator film = FilmOf(s, kSide, groups);
  const auto crop = [&](int from) {
    FilmAccumulator part(from, from, kSide - from, kSide - from, groups,
                         Auxiliary::kNone);
    part.UseRegression(1);
    for (int y = from; y < kSide; ++y) {
      for (int x = from; x < kSide; ++x) {
        const float* planes[kPlanes];
        for (int k = 0; k < kPlanes; ++k) planes[k] = &s.At(k, y * kSide + x, 0);
        part.AddSamples(x, y, planes, s.count());
      }
    }
    part.FitControl();
    return part;
  };
  const FilmAccumulator whole = crop(kFrom), cut = crop(kFrom + 1);
  for (int y = kFrom; y < kSide; ++y) {
    for (int x = kFrom; x < kSide; ++x) REQUIRE(whole.Mean(x, y) == film.Mean(x, y));
  }
  CHECK(cut.Mean(kFrom + 1, kFrom + 1) != film.Mean(kFrom + 1, kFrom + 1));
}

TEST_CASE("regression: at most a million samples are fitted", "[control]") {
  constexpr std::uint32_t kAtOnce = 4096;
  const SampleGroups groups = {1, false};
  RegressionFilm film({0, 0, 1, 1}, groups, 1);
  const auto products = [&] {
    const StateColumn column = film.Columns().back();
    std::vector<char> bytes(column.RowBytes());
    std::memcpy(bytes.data(), column.data, bytes.size());
    return bytes;
  };
  std::vector<char> last;
  const std::uint64_t calls = RegressionFilm::kMaxFittedSamples / kAtOnce;
  for (std::uint64_t call = 0; call < calls + 64; ++call) {
    if (call == calls) last = products();
    Samples s(1, kAtOnce, groups, static_cast<unsigned>(call));
    const float* planes[kPlanes];
    for (int k = 0; k < kPlanes; ++k) planes[k] = &s.At(k, 0, 0);
    film.Add(0, {call * kAtOnce, kAtOnce, planes, planes + kFirst});
  }
  CHECK(last == products());
  const std::vector<std::uint64_t> counts = {(calls + 64) * kAtOnce};
  film.Fit({counts, {}});
  const double n = double(counts[0]);
  CHECK(film.ResidualSquares(0, counts[0]).x / n == Approx(kLeft).epsilon(0.05));
}

}  // namespace lanelight

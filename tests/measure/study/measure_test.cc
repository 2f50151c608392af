// Errors of images against references, rows of measurements, sums over repetitions.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <nlohmann/json.hpp>

#include "src/render/estimate/estimate.h"
#include "tests/measure/study/simulated.h"

namespace lanelight {
namespace {

using reference::Random;

Reference Exact(const std::vector<Rgb>& mean, int width, int height) {
  Reference r;
  r.width = width;
  r.height = height;
  r.mean = mean;
  return r;
}

}  // namespace

TEST_CASE("errors of a small image agree with a calculation by hand", "[study]") {
  const Reference r = Exact({{1, 1, 1}, {0, 2, 0}}, 2, 1);
  Measurement m;
  MeasureErrors({{2, 1, 1}, {0, 2, 0.3}}, r, m);
  CHECK(m.mse == Approx((1 + 0.09) / 6));
  CHECK(m.rmse == Approx(std::sqrt(1.09 / 6)));
  CHECK(m.relmse == Approx((1 / 1.01 + 0.09 / 0.01) / 6));
  CHECK(m.raw_relmse == m.relmse);
  CHECK(m.mape == Approx((1 / 1.01 + 0.3 / 0.01) / 6));
  // The worst pixel of two is the second; without it the first remains.
  CHECK(m.worst_share == Approx(9 / (9 + 1 / 1.01)));
  CHECK(m.worst_x == 1);
  CHECK(m.worst_y == 0);
  CHECK(m.relmse_trimmed == Approx(1 / 1.01 / 3));
  // One square: means 0.5, 1.5, 0.5, differences 0.5, 0, 0.15.
  for (double filtered : {m.relmse_2, m.relmse_4, m.relmse_8}) {
    CHECK(filtered == Approx((0.25 + 0.0225) / 0.26 / 3));
  }
  CHECK(m.mean_r == Approx(1));
  CHECK(m.mean_b == Approx(0.65));
}

TEST_CASE("the error of a noisy reference is subtracted", "[study]") {
  Random random(5);
  double corrected = 0, raw = 0, rmse2 = 0;
  constexpr int kRuns = 200;
  for (int run = 0; run < kRuns; ++run) {
    const Reference r = NoisyReference(16, 12, 0.05, random);
    const Cells cells = Simulate(r, 1, 0.1, random);
    corrected += cells.repetitions[0].relmse / kRuns;
    raw += cells.repetitions[0].raw_relmse / kRuns;
    rmse2 += cells.repetitions[0].mse / kRuns;
  }
  // Relative to the noisy reference; 0.01 in the denominator and Jensen's inequality
  // change it by a few percent.
  CHECK(corrected == Approx(0.01).epsilon(0.06));
  CHECK(raw > 0.0118);  // what comes of forgetting it
  const std::vector<Rgb> truth = Truth(192);
  double square = 0;
  for (const Rgb& c : truth) square += Dot(c, c) / 3 / 192;
  CHECK(rmse2 == Approx(0.01 * square).epsilon(0.03));
}

TEST_CASE("measurements round-trip through JSON", "[study]") {
  Measurement m;
  m.seed = 0xffffffffffffffffu;
  m.relmse = 0.1 + 0.2;
  m.cpu_seconds = 1e-300;
  const nlohmann::json json = nlohmann::json::parse(nlohmann::json(m).dump());
  CHECK(json.at("mape").is_null());
  const auto back = json.get<Measurement>();
  CHECK(back.seed == m.seed);
  CHECK(back.relmse == m.relmse);
  CHECK(back.cpu_seconds == m.cpu_seconds);
  CHECK(std::isnan(back.mape));
  CHECK_FALSE(back.HasSelf());
  const std::string header = CsvHeader(), row = CsvRow(m);
  CHECK(std::count(header.begin(), header.end(), ',') ==
        std::count(row.begin(), row.end(), ','));
  CHECK(row.find("nan") == std::string::npos);
}

TEST_CASE("sums over repetitions give mean and variance", "[study]") {
  Random random(7);
  Moments moments(3);
  std::vector<double> greens, greys;
  for (int r = 0; r < 5; ++r) {
    std::vector<Rgb> image(3, Rgb{0.1, 0.1, 0.1});
    image[1] = {random.Uniform(), random.Uniform(), random.Uniform()};
    moments.Add(image);
    greens.push_back(image[1].y);
    greys.push_back((image[1].x + image[1].y + image[1].z) / 3);
  }
  const auto variance = [](const std::vector<double>& v) {
    double mean = 0, sum = 0;
    for (double x : v) mean += x / double(v.size());
    for (double x : v) sum += (x - mean) * (x - mean);
    return sum / double(v.size() - 1);
  };
  CHECK(moments.count() == 5);
  CHECK(moments.Variance(1).y == Approx(variance(greens)));
  CHECK(moments.GreyVariance(1) == Approx(variance(greys)));
  CHECK(moments.Variance(0) == Rgb{});  // equal values: exactly none
  Moments back(3);
  const StateColumn sums = moments.Column();
  std::memcpy(back.Restore(5).data, sums.data, sums.Bytes());
  CHECK(back.Mean(1) == moments.Mean(1));
  CHECK(back.GreyVariance(1) == moments.GreyVariance(1));
}

}  // namespace lanelight

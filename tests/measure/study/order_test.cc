// The order of a strategy is that of its own metric: dark pixels, which the relative
// error counts most, may converge at another rate than bright ones.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "src/measure/study/study.h"
#include "tests/base/image/temporary_folder.h"
#include "tests/measure/study/simulated.h"

namespace lanelight {
namespace {

using reference::Random;

constexpr int kOrderWidth = 24, kOrderHeight = 16;

// Bright pixels have noise that falls as 1 / sqrt(n), dark ones more, as 1 / n^dark.
std::vector<Rgb> Render(const std::vector<Rgb>& truth, double n, double dark,
                        Random& random) {
  std::vector<Rgb> image;
  for (const Rgb& c : truth) {
    const double deviation = c.x < 1 ? 3 * std::pow(n, -dark) : 0.3 / std::sqrt(n);
    image.push_back(c + c * (deviation * Normal(random)));
  }
  return image;
}

std::vector<Rgb> TwoLevels() {
  std::vector<Rgb> truth;
  for (int i = 0; i < kOrderWidth * kOrderHeight; ++i) {
    truth.push_back(i % 2 == 0 ? Rgb{0.2, 0.2, 0.2} : Rgb{20, 20, 20});
  }
  return truth;
}

// A scene whose renders never happened, its cells on the disk as a study leaves them.
SceneRuns Simulated(const TemporaryFolder& folder, double dark) {
  Random random(11);
  SceneRuns runs;
  runs.name = "simulated";
  runs.folder = folder.File("simulated");
  runs.window = {0, 0, kOrderWidth, kOrderHeight};
  runs.full_width = runs.reference.width = kOrderWidth;
  runs.full_height = runs.reference.height = kOrderHeight;
  runs.reference.mean = TwoLevels();
  runs.reference.variance.assign(runs.reference.mean.size(), Rgb{});
  runs.strategies.push_back({{"simulated", {}}, RunStatus::kOk, "", {4, 16, 64, 256}});
  const StrategyRuns& strategy = runs.strategies.front();
  const CellStore store(runs.folder + "/cells", runs.window);
  for (std::uint64_t spp : strategy.counts) {
    Cells cells;
    cells.moments = Moments(runs.window.pixels());
    for (int r = 0; r < 8; ++r) {
      const std::vector<Rgb> image =
          Render(runs.reference.mean, double(spp), dark, random);
      Measurement m;
      m.cpu_seconds = m.wall_seconds = double(spp);
      MeasureErrors(image, runs.reference, m);
      cells.moments.Add(image);
      cells.repetitions.push_back(m);
      if (r == 0) cells.first = image;
    }
    store.Save(strategy.Text(), spp, cells);
  }
  return runs;
}

}  // namespace

TEST_CASE("the order of the RMSE is fitted to the RMSE", "[study]") {
  const TemporaryFolder folder;
  StudyOptions options;
  options.repetitions = 8;
  options.out = folder.File("");
  std::vector<ReportImage> images;
  const SceneRuns runs = Simulated(folder, 0.9);
  const SceneAnalysis analysis = AnalyseScene(runs, options, images);
  const StrategyAnalysis& s = analysis.strategies.front();
  REQUIRE(s.order);
  REQUIRE(s.order_relmse);
  // Bright pixels decide the RMSE. The slope through 4 counts of 8 repetitions of 384
  // pixels has a standard deviation of 0.006: these are more than six of them.
  CHECK(std::abs(s.order->value + 0.5) < 0.04);
  CHECK(s.order->low < s.order->value);
  CHECK(s.order->high > s.order->value);
  // Dark pixels decide the relative error, less and less.
  CHECK(s.order_relmse->value < -0.75);
  const nlohmann::json json = StudyJson({{runs, analysis}}, options, 1);
  const nlohmann::json& strategy = json["scenes"][0]["strategies"][0];
  CHECK(strategy["order"]["value"] == s.order->value);
  CHECK(strategy["order_relmse"]["value"] == s.order_relmse->value);
  CHECK_THAT(analysis.verdict,
             Catch::Contains(fmt::format("to the power {:.3g}", s.order->value)));
}

}  // namespace lanelight

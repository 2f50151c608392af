// A pass of several ranks has the samples of a process alone, each rank having rendered
// its share, and all of them stop where a signal has come to one.
#include <atomic>
#include <catch2/catch.hpp>
#include <cstring>
#include <mutex>
#include <vector>

#include "src/render/train/rank_passes.h"
#include "src/scene/prepare/tables.h"
#include "tests/render/ranks/thread_group.h"
#include "tests/render/run/lamp_scene.h"
#include "tests/render/run/render_fixture.h"

namespace lanelight {
namespace {

// A pass with records besides samples.
struct PassFixture {
  PreparedScene scene =
      PrepareScene(ParseSceneText(LampScene(40, 40, 4), "test.pbrt", "."), {});
  StrategyTables tables;
  TrainingWork work = MakeTrainingWork(scene, 40'000);

  TrainingSamples Run(RankPasses* ranks) const {
    TrainingPass pass = {scene, {}, &tables, 3, nullptr, ranks};
    pass.options.training = FeatureSet{Feature::kRecordsPaths};
    return RunTrainingPass(pass, work);
  }
};

// Bit by bit: some of what is recorded are numbers of cells in the place of floats.
bool SameSamples(const TrainingSamples& a, const TrainingSamples& b) {
  return a.colors == b.colors && a.recorded.size() == b.recorded.size() &&
         std::memcmp(a.recorded.data(), b.recorded.data(), 4 * a.recorded.size()) == 0 &&
         a.rays_closest == b.rays_closest && a.rays_shadow == b.rays_shadow;
}

}  // namespace

TEST_CASE("a training pass on several ranks has the samples of one process", "[ranks]") {
  const PassFixture fixture;
  const TrainingSamples alone = fixture.Run(nullptr);
  CHECK_FALSE(alone.recorded.empty());
  for (const int ranks : {2, 3, 30}) {  // more than there are tasks, too
    std::mutex mutex;
    int same = 0;
    OnRanks(ranks, [&](RankGroup& group) {
      RankPasses passes(group, nullptr);
      const TrainingSamples together = fixture.Run(&passes);
      const std::lock_guard lock(mutex);
      same += SameSamples(together, alone) && !*passes.stop();
    });
    CHECK(same == ranks);
  }
}

TEST_CASE("each task of a pass is rendered by one rank", "[ranks]") {
  std::vector<int> rendered(7);
  for (int rank = 0; rank < 3; ++rank) {
    RankExchange exchange(3);
    ThreadRank group(exchange, rank);
    const RankPasses passes(group, nullptr);
    for (std::size_t task = 0; task < rendered.size(); ++task) {
      rendered[task] += passes.Renders(task);
    }
  }
  CHECK(rendered == std::vector<int>(7, 1));
}

TEST_CASE("all ranks stop a training pass together", "[ranks]") {
  const PassFixture fixture;
  const std::atomic<bool> signal{true};
  std::mutex mutex;
  int stopped = 0;
  OnRanks(3, [&](RankGroup& group) {
    RankPasses passes(group, group.rank() == 1 ? &signal : nullptr);
    fixture.Run(&passes);
    const std::lock_guard lock(mutex);
    stopped += *passes.stop();
  });
  CHECK(stopped == 3);
}

}  // namespace lanelight

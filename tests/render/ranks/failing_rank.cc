// A render with several ranks of which one fails: `failing_rank SCENE STATE`. Rank 1
// throws in the first stage after some calls of it.
#include <atomic>
#include <cstdio>
#include <exception>

#include "src/base/core/check.h"
#include "src/base/core/parallel.h"
#include "src/render/job/render.h"
#include "src/render/mpi/join_ranks.h"

namespace lanelight {
namespace {

constexpr int kGoodCalls = 200;
StageFn good_stage = nullptr;
std::atomic<int> calls{0};

void FailingStage(Wave& wave) {
  LL_CHECK(++calls < kGoodCalls && "planted failure");
  good_stage(wave);
}

void Render(const char* scene, const char* state, RankGroup& group) {
  const ThreadLimit threads(1);
  RenderSettings settings;
  settings.resolution = {72, 56};
  settings.spp = 1000;
  Job job = PrepareJob(scene, settings);
  if (group.rank() == 1) {
    good_stage = job.plan.paths().stages[0].kernel;
    job.plan.phases[0].stages[0].kernel = FailingStage;
  }
  if (!group.is_leader()) return ServeRender(job, group, nullptr);
  RenderTargets targets;
  targets.checkpoint.path = state;
  RenderHooks hooks;
  hooks.group = &group;
  RenderToFiles(job, scene, targets, hooks);
}

}  // namespace
}  // namespace lanelight

int main(int argc, char** argv) {
  using namespace lanelight;
  const auto group = JoinRanks(&argc, &argv);
  if (argc != 3) return group->Leave(2);
  try {
    Render(argv[1], argv[2], *group);
  } catch (const std::exception& error) {
    if (group->is_leader()) std::fprintf(stderr, "%s\n", error.what());
    return group->Fail(1, error.what());
  }
  return group->Leave(0);
}

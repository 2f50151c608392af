#include "tests/render/run/resume_fixture.h"

#include <random>

#include "src/render/estimate/estimate.h"
#include "tests/render/run/lamp_scene.h"

namespace lanelight::resume {
Rendered Render(const Request& request) {
  const ThreadLimit limit(request.threads);
  PreparedScene scene =
      PrepareScene(ParseSceneText(LampScene(kWidth, kHeight, 4), "test.pbrt", "."), {});
  Strategy strategy = scene.strategy;
  ApplyStrategy(request.strategy, {}, strategy);
  scene = WithStrategy(scene, strategy);
  PlanOptions plan_options;
  plan_options.max_depth = 4;
  plan_options.wavefront = request.wavefront;
  const Plan plan = MakePlan(scene, plan_options);
  Rendered out{
      FilmAccumulator(0, 0, kWidth, kHeight, GroupsOf(strategy), Auxiliary::kNone),
      {},
      plan};
  RunOptions options;
  options.spp = request.spp;
  options.seed = request.seed;
  options.checkpointer = request.checkpointer;
  options.stop = request.stop;
  if (request.target > 0) {
    options.samples_needed = [&](const FilmAccumulator& film, std::uint64_t done) {
      return SamplesNeeded({request.target, 0}, EstimateError(film), done);
    };
  }
  options.group = request.group;
  if (options.group != nullptr && !options.group->is_leader()) {
    ServeRun(scene, plan, options, out.film);
  } else {
    out.result = Run(scene, plan, options, out.film);
  }
  return out;
}

bool Same(const RunResult& a, const RunResult& b) {
  return a.samples == b.samples && a.rays_closest == b.rays_closest &&
         a.rays_shadow == b.rays_shadow && a.health.Total() == b.health.Total() &&
         a.training.samples == b.training.samples && a.training.rays == b.training.rays &&
         a.training.note == b.training.note && a.roulette == b.roulette &&
         a.num_checks == b.num_checks;
}

Rendered RenderInParts(const Request& request, const std::vector<Request>& ends,
                       Rest& rest, int& pauses, unsigned seed) {
  std::mt19937 random(seed);
  for (int run = 0;; ++run) {
    const bool last = run >= 12;
    Request part = last || ends.empty() ? request : ends[random() % ends.size()];
    // The last one is looked at while it goes on, the others end there.
    InterruptingCheckpointer interrupter(rest, 1 + static_cast<int>(random() % 8), !last);
    part.threads = 1 + static_cast<int>(random() % 3);
    part.wavefront = random() % 2 == 0 ? 0 : 300;
    part.checkpointer = &interrupter;
    part.stop = &interrupter.stop();
    Rendered out = Render(part);
    pauses += out.result.stop_reason == StopReason::kInterrupted;
    if (last) return out;
  }
}

}  // namespace lanelight::resume

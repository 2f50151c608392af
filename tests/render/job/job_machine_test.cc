// A job renders with the threads and the SIMD target of its settings, whatever others do.
#include <catch2/catch.hpp>

#include "src/render/job/job.h"
#include "src/render/job/setting.h"
#include "src/scene/parse/parse.h"

namespace lanelight {
namespace {

Job JobOn(int threads, const std::string& target) {
  RenderSettings settings;
  settings.threads = threads;
  settings.target = target;
  settings.spp = 64;
  const std::string scene =
      "Film \"rgb\" \"integer xresolution\" 64 \"integer yresolution\" 64\n"
      "Camera \"perspective\"\nWorldBegin\nLightSource \"infinite\"\n"
      "Translate 0 0 4\nShape \"sphere\"\n";
  return PrepareJob(ParseSceneText(scene, "test.pbrt", "."), settings);
}

}  // namespace

TEST_CASE("a job renders on as many threads as its settings say", "[job]") {
  const Job one = JobOn(1, ""), two = JobOn(2, "");
  CHECK(SettingsInForce(one).threads == 1);
  CHECK(SettingsInForce(two).threads == 2);
  // Each thread that has rendered has its own part of the trace.
  CHECK(RunJob(one).result.trace.threads.size() == 1);
  CHECK(RunJob(two).result.trace.threads.size() <= 2);
}

TEST_CASE("a job has the kernels of the target of its settings", "[job]") {
  for (const std::string& name : AvailableTargets()) {
    const Job job = JobOn(0, name);
    CHECK(job.plan.options.target.name() == name);
    CHECK(SettingsInForce(job).target == name);
    for (const PlannedStage& planned : job.plan.paths().stages) {
      CHECK(planned.kernel == planned.stage.resolve(job.plan.features));
    }
  }
}

}  // namespace lanelight

#include "src/render/wave/run_state.h"

namespace lanelight {

void RunCounts::Add(const RunCounts& more) {
  samples += more.samples;
  rays_closest += more.rays_closest;
  rays_shadow += more.rays_shadow;
  health.nan += more.health.nan;
  health.infinite += more.health.infinite;
  health.negative += more.health.negative;
  seconds += more.seconds;
  cpu_seconds += more.cpu_seconds;
}

}  // namespace lanelight
